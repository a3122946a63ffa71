# What the theory rules take in: the names of checks, trajectories and sweeps as paths.


def checks(*names):
    return [f"results/checks/{name}.nc" for name in names]


def trajectories(solver=""):
    return [f"results/trajectories/{case}{solver}.nc" for case in PAPER_CASES]


def sweeps(solver=""):
    return [f"results/sweeps/{sweep}{solver}.nc" for sweep in PAPER_SWEEPS]


def makers():
    """Return the rule that makes each dataset below results/, by its name without the ending."""
    made_by = {f"check_{group}": checks(*names) for group, names in GROUPS.items()} | {
        "check_observed": checks(*OBSERVED),
        "measure_ensembles": checks("ensembles"),
        "measure_solvers": checks("solvers"),
        "measure_trust": checks("trust"),
        "trajectory": trajectories() + trajectories(".crank_nicolson"),
        "sweep": sweeps() + sweeps(".crank_nicolson"),
        "spread": [f"results/unbounded/{study}.nc" for study in SETTINGS.unbounded.names],
        "map_windows": [f"results/unbounded/{name}.nc" for name in map_names()],
        "thermal": ["results/unbounded/thermal.nc"],
        "measure_growth": ["results/unbounded/growth.nc", "results/unbounded/front.nc"],
    }
    return {
        path.removeprefix("results/").removesuffix(".nc"): rule
        for rule, paths in made_by.items()
        for path in paths
    }


def points_of_paper():
    """Return (Omega, gamma) of the paper's cases in units of epsilon, once each."""
    problems = [SETTINGS.problem(case) for case in PAPER_CASES]
    problems = [problem for problem in problems if problem["epsilon"]]
    return sorted({(p["omega"] / p["epsilon"], p["gamma"] / p["epsilon"]) for p in problems})
