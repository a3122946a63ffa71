# What a run made against the accepted baseline in tests/baseline.
# The comparison is a job that always succeeds, since Snakemake deletes what a failed job wrote. No
# job fails in its place either: Snakemake would print an error of its own after the faults, of a
# command that nobody called. So the end of the run tells the faults, and fails.


rule figure_diff:
    "Datasets and figures against the accepted ones; fails with one line for each that differs"
    input:
        verdict=verdict_told_at_the_end,
        html="results/figure_diff/index.html",
    log:
        "results/logs/figure_diff/faults.log",
    localrule: True
    conda:
        "../envs/pinned.yaml"
    message:
        "Telling what differs from the baseline"
    shell:
        "echo 'The end of the run tells what was found, and so does {input.html}.' > {log}"


rule compare_results:
    "The comparison behind figure_diff, with a page: results/figure_diff/index.html"
    input:
        code=code("figure_diff/compare_results.py"),
        results=everything(),
        accepted=accepted_files(),
    output:
        html="results/figure_diff/index.html",
        verdict="results/figure_diff/verdict.json",
    log:
        "results/logs/figure_diff/comparison.log",
    conda:
        "../envs/pinned.yaml"
    params:
        baseline=lambda wildcards: BASELINE,
        configuration=plain(SETTINGS),
        any_bits=ANY_BITS,
    message:
        "Comparing datasets, figures and words with the baseline"
    script:
        "../../scripts/figure_diff/compare_results.py"


rule accept_figures:
    'Takes this run as the baseline, or the files in --config accept="fig3 checks/worst"'
    input:
        code=code("figure_diff/accept_results.py"),
        results=chosen_files,
    log:
        "results/logs/figure_diff/acceptance.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **acceptance_params(dry=False),
    message:
        "Taking datasets, figures and words as the baseline"
    script:
        "../../scripts/figure_diff/accept_results.py"


rule preview_acceptance:
    "Shows what accept_figures would change, and changes nothing; it takes the same names"
    input:
        code=code("figure_diff/accept_results.py"),
        results=chosen_files,
    log:
        "results/logs/figure_diff/preview.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **acceptance_params(dry=True),
    message:
        "Showing what accepting would change"
    script:
        "../../scripts/figure_diff/accept_results.py"
