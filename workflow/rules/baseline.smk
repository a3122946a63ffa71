# What the baseline holds: the files of a full run, the settings they are of, and what is accepted.
if not isinstance(OPTIONS["baseline"], str | None):
    stop(f"--config baseline={OPTIONS['baseline']}: give the path of a folder, as in baseline=./7")
BASELINE = os.path.abspath(OPTIONS["baseline"] or f"{workflow.basedir}/tests/baseline")


# --config bits=any judges files with other bits by what right runs may differ.
ANY_BITS = OPTIONS["bits"] == "any"
if OPTIONS["bits"] not in (None, "any"):
    stop(
        f"--config bits={OPTIONS['bits']}: the only value is bits=any, which judges files with other "
        "bits by what right runs may differ; without it they are faults"
    )


def everything():
    """Return each file that a full run makes or needs and whose content is settled by its inputs.

    The report is left out, which holds the times of the run, and so are logs, records of code, and
    the parts of the ledger, which claims.json joins.
    """
    made = {
        *rules.all.input,
        *(f"results/{name}.nc" for name in makers()),
        *rules.hard_cases.output,
        *references(*PAPER_CASES, "fig4_small.double"),
        *committed_proofs(),
        fine_maps_of_fates(),
    }
    return sorted(path for path in made if path.endswith((".nc", ".json", ".md", ".png", ".pdf")))


def below_results(paths):
    return [path.removeprefix("results/") for path in paths]


def accepted_files():
    """Return the files of the baseline that are there: a change of one asks for a new comparison."""
    names = ["accepted.json", "hashes.json", "tolerances.yaml", "spreads.nc"]
    names += below_results(everything())
    return [path for name in names if os.path.exists(path := f"{BASELINE}/{name}")]


def verdict_told_at_the_end(wildcards):
    if workflow.execution_settings.no_hooks:
        stop("figure_diff fails at the end of a run: call it without --no-hooks")
    return "results/figure_diff/verdict.json"


def tell_faults():
    """Say in one line each what is not as in the baseline, and fail if any of it is a fault."""
    from pendula.figure_diff.comparison_page import load  # here, since few runs compare

    verdict = load("results/figure_diff/verdict.json")
    print(*verdict.lines, sep="\n", end="; see results/figure_diff/index.html\n", file=sys.stderr)
    if verdict.failed:
        sys.exit(1)


def plain(settings):
    """Return the configuration without the limits of a run, which change no number."""
    return json.loads(settings.model_dump_json(exclude={"limits"}))


def committed_settings():
    """Return what config/*.yaml say, without what the command line added."""
    return load(gather(CONFIG_FILES, {}))


def chosen_names():
    """Return the names of the files to accept, or stop before any job with the reason."""
    from pendula.figure_diff import acceptance, baseline  # here, since only accepting needs them

    folder, words = Path(BASELINE), OPTIONS["accept"] or []
    words = words.split() if isinstance(words, str) else [str(word) for word in words]
    names = below_results(everything())
    known = sorted({*names, *baseline.recorded(folder)["files"], *baseline.ALLOWANCES})
    try:
        chosen = acceptance.choose(words, known) if words else known
        some = len(chosen) < len(known)
        acceptance.check(plain(SETTINGS), plain(committed_settings()), folder, some)
        return chosen
    except acceptance.AcceptanceError as error:
        stop(error)


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
