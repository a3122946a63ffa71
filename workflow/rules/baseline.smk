# What the baseline holds: the files of a full run, the settings they are of, and what is accepted.
if not isinstance(OPTIONS["baseline"], str | None):
    stop(f"--config baseline={OPTIONS['baseline']}: give the path of a folder, as in baseline=./7")
ACCEPTED = str(OPTIONS["accept"] or "").split()
BASELINE = os.path.abspath(OPTIONS["baseline"] or f"{PROJECT}/tests/baseline")
PAGE, VERDICT = "results/figure_diff/index.html", "results/figure_diff/verdict.json"
if OPTIONS["bits"] not in (None, "any"):
    stop(
        f"--config bits={OPTIONS['bits']}: the only value is bits=any, which compares the numbers of "
        "files with other bits; without it they are faults"
    )


def everything():
    """Return each file that a full run makes, but for logs and copies of committed files."""
    parts = expand("results/claims/{part}.json", part=RESTS_ON)
    copies = {path.replace("<results>", "results") for path in QUOTED_COPIES}
    return sorted({*rules.all.input, *parts} - copies)


def plain(settings):
    """Return the configuration without the limits of a run, which change no number."""
    return json.loads(settings.model_dump_json(exclude={"limits"}))


def baseline_told_at_the_end(wildcards):
    if workflow.execution_settings.no_hooks:
        stop("figure_diff fails at the end of a run: call it without --no-hooks")
    return BASELINE


def accepted_files(wildcards):
    """Return the files to accept, or stop before any job with the reason."""
    from replication.figure_diff import acceptance  # here, since only accepting needs it

    try:
        names = [path.removeprefix("results/") for path in everything()]
        names = acceptance.choose(ACCEPTED, names) if ACCEPTED else names
        if not OPTIONS["baseline"]:
            committed, whose = load(gather(CONFIG_FILES, {})), "the configuration of config/*.yaml"
            acceptance.check(plain(SETTINGS), plain(committed), whose, acceptance.OWN)
        return [f"results/{name}" for name in names]
    except acceptance.AcceptanceError as error:
        stop(error)


def tell_faults():
    """Say in one line each what is not as in the baseline, and fail if any of it is a fault."""
    from latticode.datasets.json_files import load_json  # here, since few runs compare

    verdict = load_json(VERDICT)
    print(*verdict["lines"], sep="\n", end=f"; see {from_outside(PAGE)}\n", file=sys.stderr)
    if verdict["faults"]:
        sys.exit(1)
