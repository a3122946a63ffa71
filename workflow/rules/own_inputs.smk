# What the report of one's own cases and sweeps takes in; names are free, so all lies in results/own.

OWN_CASE_FILES = ["png", "pdf", "nc", "checks.nc", "spacetime.png", "spacetime.pdf", "spacetime.nc"]
OWN_SWEEP_FILES = ["png", "pdf", "nc", "checks.nc"]


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
        raise WorkflowError(
            "the configuration has no case and no sweep of your own: give some by "
            "--configfile, as docs/own_cases.md shows"
        )
    return own_files()


def own_figure(folder, prefix="", part=""):
    kinds = {"png": "png", "pdf": "pdf", "data": "nc"}
    stem = f"results/own/{folder}{part}"
    return {f"{prefix}{key}": f"{stem}.{kind}" for key, kind in kinds.items()}
