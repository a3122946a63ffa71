# Comparison of a run with the baseline, which is tests/baseline unless --config baseline=FOLDER. Both rules have no
# output, so that they always run. A hook reports differences at the end of the run: if the job failed instead,
# Snakemake would add an error message about it.


use rule job as figure_diff with:
    "Compares datasets, figures and texts with the accepted ones; fails with one line for each difference"
    input:
        results=files_of_full_run(),
    output:
        [],
    pathvars:
        made="figure_diff/comparison",
    params:
        call=function("pendula.jobs.compare.compare_results"),
        made=lambda wildcards, input: os.path.commonpath(input.results),
        baseline=baseline_unless_no_hooks,
        configuration=without_limits(SETTINGS),
        any_bits=OPTIONS.any_bits,
        html=PAGE,
        verdict=VERDICT,
    message:
        "Comparing datasets, figures and texts with the baseline"


use rule job as accept_figures with:
    'Accepts this run as the baseline, or only the files in --config accept="fig3 checks/chart"'
    input:
        results=files_to_accept,
    output:
        [],
    pathvars:
        made="figure_diff/acceptance",
    params:
        call=function("replication.figure_diff.acceptance.accept_results"),
        made="results",
        words=OPTIONS.accept,
        baseline=BASELINE,
        configuration=without_limits(SETTINGS),
    message:
        "Accepting datasets, figures and texts as the baseline"
