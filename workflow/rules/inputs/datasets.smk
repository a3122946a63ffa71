# The datasets below results/, the rules that make them, and the cases that stand for the paper.
def checks(*names):
    return [f"results/checks/{name}.nc" for name in names]


def trajectories(solver=""):
    return [f"results/trajectories/{case}{solver}.nc" for case in PAPER_CASES]


def sweeps(solver=""):
    return [f"results/sweeps/{sweep}{solver}.nc" for sweep in PAPER_SWEEPS]


def below(names):
    return [f"results/{name}.nc" for name in names]


def makers():
    """Return the rule that makes each dataset below results/, by its name without the ending."""
    made_by = {f"check_{group}": checks(*names) for group, names in GROUPS.items()} | {
        "check_wrong": checks(*(f"wrong/{name}" for name in WRONG)),
        "check_observed": checks(*OBSERVED),
        "measure_lyapunov": checks("lyapunov"),
        "measure_symmetry": checks("symmetry"),
        "measure_ensembles": checks("ensembles", "ensembles_uneven"),
        "measure_members": checks("members"),
        "measure_lifetimes": checks("lifetimes"),
        "compare_ensembles": checks("ensemble_runs"),
        "measure_solvers": checks("solvers"),
        "measure_second_solver": checks("second_solver"),
        "measure_trust": checks("trust"),
        "trajectory": trajectories(),
        "trajectory_by_solvers": [
            path for solver in ALL_SOLVERS for path in trajectories(f".{solver}")
        ],
        "sweep": sweeps(),
        "sweep_by_second_solver": sweeps(".crank_nicolson"),
        "spread": [f"results/unbounded/{study}.nc" for study in SETTINGS.unbounded.names],
        "map_windows": [f"results/unbounded/{name}.nc" for name in map_names()],
        "thermal": ["results/unbounded/thermal.nc"],
        "measure_growth": ["results/unbounded/growth.nc", "results/unbounded/front.nc"],
        "steady_breathers": ["results/breathers/steady.nc"],
        "periodic_breathers": ["results/breathers/periodic.nc"],
        "growth_by_drive": ["results/breathers/growth.nc"],
        "measure_sensitivity": ["results/breathers/sensitivity.nc"],
        "map_fates": ["results/breathers/fates.nc"],
        "find_threshold": ["results/pendula/threshold.nc"],
        "measure_remainder": ["results/pendula/remainder.nc"],
        "measure_phases": ["results/pendula/phases.nc"],
        "measure_sea": ["results/pendula/sea.nc"],
        "measure_over_the_top": ["results/pendula/over_the_top.nc"],
        "film_pendula": ["results/pendula/film.nc"],
        "certify_curve": proved_curves(),
        "measure_lines": ["results/certified/lines.nc"],
        "certify_wrong_curve": ["results/certified/wrong/curve.nc"],
        "prove_breathers": ["results/certified/breathers.nc"],
        "enclose_constants": ["results/certified/constants.nc"],
    }
    return {name_of(path): rule for rule, paths in made_by.items() for path in paths}


def name_of(path):
    """Return the name that the claims have for a dataset."""
    return path.removeprefix("results/").removesuffix(".nc")


def differs_of(wildcards, input):
    """Return in words where the configuration of what a figure shows is not the paper's.

    Of the datasets of many cases it shows those of its trajectories and sweeps, if it has such.
    """
    known = makers()
    names = [name for name in map(name_of, input) if name in known]
    own = [name.split("/") for name in names]
    on = [rest for folder, rest in own if folder in ("trajectories", "sweeps")]
    return list(concerning(DIFFERS, names, on).values())


def other_cases(solver):
    """Return the cases by a solver that the configuration has changed: no longer the paper's."""
    return [case for case in PAPER_CASES if reason(DIFFERS, [f"trajectories/{case}.{solver}"])]


def points_are_the_papers():
    """Return whether no case of a figure has other constants than in the paper."""
    constants = ("epsilon", "gamma", "omega")
    return not any(f"cases.{case}.{key}" in DIFFERS for case in PAPER_CASES for key in constants)


def points_of_cases():
    """Return (Omega, gamma) of the figures' cases in units of epsilon, once each."""
    problems = [SETTINGS.problem(case) for case in PAPER_CASES]
    problems = [problem for problem in problems if problem["epsilon"]]
    return sorted({(p["omega"] / p["epsilon"], p["gamma"] / p["epsilon"]) for p in problems})


# Variables, by dataset, that rest on chaos although no chaotic case or sweep stands in the name of the
# file or along a dimension. Where their bits differ, they cannot be judged.
RESTS_ON_CHAOS = [
    # Maps and scans over data, some of which lead to chaos
    *("breathers/fates:*", "breathers/sensitivity:*", "figures/fates:*", "figures/sensitivity:*"),
    *("checks/lifetimes:*", "figures/lifetimes:*"),
    # Chains of other lengths, and without ends, at the detuning of a chaotic case
    *("checks/chain_growth:*power*", "figures/bounds:late_power", "figures/front:*"),
    *(f"unbounded/{name}:*" for name in ("amplitudes", "front", "omegas", "tolerances")),
    *("unbounded/front:modulus", "figures/front:modulus"),
    # The sea that fills a chain of pendula
    *("pendula/sea:*", "figures/pendula_over_the_top:wave_power"),
    "figures/pendula_over_the_top:sea_density",
    # The largest of all sweeps; and a count of errors of rounding that are larger than some bound
    *("checks/sweeps:swept_ratio", "checks/wrong/dispersion:contradictions"),
]
# Variables that are divided by the largest value of a whole run: in a chaotic case it is one of the tail.
DIVIDED_BY_THE_TAIL = ["checks/*:difference", "figures/*:largest_so_far"]
