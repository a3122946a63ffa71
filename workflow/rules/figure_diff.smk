# What a run made against the accepted baseline, which is tests/baseline unless --config baseline=FOLDER.
# Neither rule has an output, so that Snakemake runs them whenever they are asked for. The end of the run
# tells the faults: Snakemake would print an error of its own about a job that nobody called.


use rule job as figure_diff with:
    "Datasets, figures and words against the accepted ones; fails with one line for each that differs"
    input:
        results=everything(),
    output:
        [],
    pathvars:
        made="figure_diff/comparison",
    params:
        call=function("pendula.jobs.compare.compare_results"),
        made=lambda wildcards, input: os.path.commonpath(input.results),
        baseline=baseline_told_at_the_end,
        configuration=plain(SETTINGS),
        any_bits=OPTIONS["bits"] == "any",
        html=PAGE,
        verdict=VERDICT,
    message:
        "Comparing datasets, figures and words with the baseline"


use rule job as accept_figures with:
    'Takes this run as the baseline, or the files in --config accept="fig3 checks/chart"'
    input:
        results=accepted_files,
    output:
        [],
    pathvars:
        made="figure_diff/acceptance",
    params:
        call=function("replication.figure_diff.acceptance.accept_results"),
        made="results",
        words=ACCEPTED,
        baseline=BASELINE,
        configuration=plain(SETTINGS),
    message:
        "Taking datasets, figures and words as the baseline"
