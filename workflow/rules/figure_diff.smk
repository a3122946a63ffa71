# What a run made against the accepted baseline in tests/baseline.
# The comparison is a job that always succeeds, since Snakemake deletes what a failed job wrote;
# the rule `figure_diff` then tells the faults and fails.

import glob

BASELINE = f"{workflow.basedir}/tests/baseline"
ACCEPTABLE = [path for path in rules.all.input if path.endswith((".nc", ".png"))]


def accepted_files(wildcards):
    """Return the files of the baseline beside these results, its record and its tolerances."""
    folders = sorted({path.split("/")[1] for path in ACCEPTABLE})
    patterns = ["accepted.json", "tolerances.yaml", *(f"{folder}/*" for folder in folders)]
    return sorted(path for name in patterns for path in glob.glob(f"{BASELINE}/{name}"))


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
        accepted=accepted_files,
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
