# What a run made against the accepted baseline in tests/baseline.
# The comparison is a job that always succeeds, since Snakemake deletes what a failed job wrote;
# the rule `figure_diff` then tells the faults and fails.

BASELINE = f"{workflow.basedir}/tests/baseline"
ACCEPTABLE = [path for path in rules.all.input if path.endswith((".nc", ".png"))]
ACCEPTED = {
    *(f"{BASELINE}/{name}" for name in ("accepted.json", "tolerances.yaml")),
    *(f"{BASELINE}/{path.removeprefix('results/')}" for path in ACCEPTABLE),
}


rule figure_diff:
    "Datasets and figures against the accepted ones; fails with one line for each that differs"
    input:
        code=code("figure_diff/tell_faults.py"),
        verdict="results/figure_diff/verdict.json",
        html="results/figure_diff/index.html",
    log:
        "results/logs/figure_diff/faults.log",
    conda:
        "../envs/pinned.yaml"
    message:
        "Telling what differs from the baseline"
    script:
        "../../scripts/figure_diff/tell_faults.py"


rule compare_results:
    input:
        code=code("figure_diff/compare_results.py"),
        results=ACCEPTABLE,
        accepted=sorted(filter(os.path.exists, ACCEPTED)),
    output:
        html="results/figure_diff/index.html",
        verdict="results/figure_diff/verdict.json",
    log:
        "results/logs/figure_diff/comparison.log",
    conda:
        "../envs/pinned.yaml"
    params:
        baseline=lambda wildcards: BASELINE,
    message:
        "Comparing datasets and figures with the baseline"
    script:
        "../../scripts/figure_diff/compare_results.py"


rule accept_figures:
    "Takes the datasets and figures of this run as the baseline in tests/baseline"
    input:
        code=code("figure_diff/accept_results.py"),
        results=ACCEPTABLE,
    log:
        "results/logs/figure_diff/acceptance.log",
    conda:
        "../envs/pinned.yaml"
    params:
        baseline=lambda wildcards: BASELINE,
    message:
        "Taking the datasets and figures as the baseline"
    script:
        "../../scripts/figure_diff/accept_results.py"
