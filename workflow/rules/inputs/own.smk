# Cases and sweeps of one's own: their names are free, so all lies in results/own.
OWN_SWEEP_FILES = [*FIGURE_KINDS.values(), "checks.nc"]
OWN_CASE_FILES = [*OWN_SWEEP_FILES, *(f"spacetime.{kind}" for kind in FIGURE_KINDS.values())]


def own_files():
    """Return every figure and dataset of one's own cases and sweeps."""
    return [
        *expand("results/trajectories/{case}.nc", case=OWN_CASES),
        *expand("results/own/cases/{case}.{kind}", case=OWN_CASES, kind=OWN_CASE_FILES),
        *expand("results/sweeps/{sweep}.nc", sweep=OWN_SWEEPS),
        *expand("results/own/sweeps/{sweep}.{kind}", sweep=OWN_SWEEPS, kind=OWN_SWEEP_FILES),
    ]


def some_own_files(wildcards):
    if not own_files():
        stop(
            "the configuration has no case and no sweep of your own: give some by "
            "--configfile, as docs/own_cases.md shows"
        )
    return own_files()
