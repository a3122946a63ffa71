# What a run made against the accepted baseline in tests/baseline.
# The comparison is a job that always succeeds, since Snakemake deletes what a failed job wrote;
# the rule `figure_diff` then tells the faults and fails.

BASELINE = os.path.abspath(OPTIONS["baseline"] or f"{workflow.basedir}/tests/baseline")


def everything():
    """Return each file that a full run makes or needs and whose content is settled by its inputs.

    The report is left out, which holds the times of the run, and so are logs and records of code.
    """
    made = {
        *rules.all.input,
        *(f"results/{name}.nc" for name in makers()),
        *rules.hard_cases.output,
        *references(*PAPER_CASES, "fig4_small.double"),
    }
    return sorted(path for path in made if path.endswith((".nc", ".json", ".md", ".png", ".pdf")))


def below_results(paths):
    return [path.removeprefix("results/") for path in paths]


def accepted_files():
    """Return the files of the baseline that are there: a change of one asks for a new comparison."""
    names = ["accepted.json", "hashes.json", "tolerances.yaml", "spreads.nc"]
    names += below_results(everything())
    return [path for name in names if os.path.exists(path := f"{BASELINE}/{name}")]


def plain(settings):
    return json.loads(settings.model_dump_json())


def committed_settings():
    """Return what config/*.yaml say, without what the command line added."""
    committed = {}
    for name in ("config", *STUDIES):
        with open(f"{workflow.basedir}/config/{name}.yaml", encoding="utf-8") as file:
            committed.update(yaml.load(file, yaml.CSafeLoader))
    return load(committed)


def chosen_names():
    """Return the names of the files to accept, or stop before any job with the reason."""
    from pendula.figure_diff import acceptance, baseline  # here, since only accepting needs them

    folder, words = Path(BASELINE), OPTIONS["accept"] or []
    words = words.split() if isinstance(words, str) else [str(word) for word in words]
    names = below_results(everything())
    known = sorted({*names, *baseline.recorded(folder)["files"]})
    try:
        acceptance.check(plain(SETTINGS), plain(committed_settings()), folder, bool(words))
        return acceptance.choose(words, known) if words else names
    except acceptance.AcceptanceError as error:
        raise WorkflowError(str(error)) from None


def acceptance_params(dry):
    return {
        "names": lambda wildcards: chosen_names(),
        "baseline": lambda wildcards: BASELINE,
        "configuration": plain(SETTINGS),
        "all_of_it": not OPTIONS["accept"],
        "dry": dry,
    }


def chosen_files(wildcards):
    chosen = set(chosen_names())
    return [path for path in everything() if path.removeprefix("results/") in chosen]


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
