# The baseline: the files of a full run, their settings, and the files to accept.
BASELINE = os.path.abspath(OPTIONS.baseline or f"{PROJECT}/tests/baseline")
PAGE, VERDICT = "results/figure_diff/index.html", "results/figure_diff/verdict.json"


def files_of_full_run():
    """Return all files of a full run, without logs and copies of committed files."""
    parts = expand("results/claims/{part}.json", part=CLAIM_MODULES)
    copies = {path.replace("<results>", "results") for path in QUOTED_COPIES}
    return sorted({*rules.all.input, *parts} - copies)


def without_limits(settings):
    """Return the configuration without the section `limits`, which changes no number."""
    return json.loads(settings.model_dump_json(exclude={"limits"}))


def baseline_unless_no_hooks(wildcards):
    """Return the folder of the baseline, or stop, because a hook reports the differences."""
    if workflow.execution_settings.no_hooks:
        stop("figure_diff reports differences in a hook: run it without --no-hooks")
    return BASELINE


def files_to_accept(wildcards):
    """Return the files to accept, or stop before any job, with the reason."""
    from replication.figure_diff import acceptance  # imported here: only accepting needs it

    try:
        names = [path.removeprefix("results/") for path in files_of_full_run()]
        names = acceptance.choose(OPTIONS.accept, names) if OPTIONS.accept else names
        if not OPTIONS.baseline:
            accepted = load(options.read_configuration(PROJECT, (), ()))
            acceptance.check(
                without_limits(SETTINGS),
                without_limits(accepted),
                "the configuration of config/*.yaml",
                acceptance.WAY_OUT,
            )
        return [f"results/{name}" for name in names]
    except acceptance.AcceptanceError as error:
        stop(error)


def report_comparison():
    """Print one line for each file that differs from the baseline; exit with 1 if any of them fails."""
    from latticode.datasets.json_files import load_json  # imported here: few runs compare

    verdict = load_json(VERDICT)
    page = seen_from_outside(PAGE)
    print(*verdict["lines"], sep="\n", end=f"; see {page}\n", file=sys.stderr)
    if verdict["faults"]:
        sys.exit(1)
