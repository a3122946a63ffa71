# What the report shows.
import json

# The code that makes the numbers; the report shows the hashes of their records.
NUMBERS_BY = [
    *("trajectories/simulate_case.py", "sweeps/sweep_case.py", "theory/run_checks.py"),
    *("theory/check_observed.py", "hard_cases/run_hard_cases.py"),
    *("chaos/measure_lyapunov.py", "chaos/measure_symmetry.py", "chaos/measure_ensembles.py"),
    *("chaos/measure_members.py", "chaos/measure_lifetimes.py"),
    *("chaos/compare_ensembles.py", "paper/measure_solvers.py", "paper/measure_trust.py"),
    "paper/measure_second_solver.py",
    *("unbounded/spread_case.py", "unbounded/map_windows.py", "unbounded/solve_thermal.py"),
    "unbounded/measure_growth.py",
    *("newton/find_threshold.py", "newton/measure_remainder.py"),
    *("newton/measure_phases.py", "newton/measure_sea.py"),
    *("newton/measure_over_the_top.py", "newton/film_pendula.py"),
    *("certified/certify_curve.py", "certified/measure_lines.py", "certified/prove_breathers.py"),
    "certified/enclose_constants.py",
]


def reported_datasets():
    made = [f"results/{name}.nc" for name in makers()]
    checks = expand("results/checks/{name}.nc", name=[*CHAOS_CHECKS, "hard_cases"])
    return list(dict.fromkeys([*made, *checks]))


def speed_measured():
    """Return whether this machine timed the solvers, the dataset, its table and its pictures.

    They are copied, not taken as inputs: else an edit would start the timing anew, which is no part
    of a full run.
    """
    here = [f"results/speed/work_precision.{kind}" for kind in ("nc", "md")]
    here += [f"results/figures/{name}.png" for name in SPEED_FIGURES]
    if all(was_made(path) for path in here):
        data, table, *pictures = (kept(path) for path in here)
        return True, data, table, pictures
    names = ("work_precision.nc", "work_precision.md", "speed_regular.png")
    data, table, picture = (committed(f"tests/baseline/speed/{name}") for name in names)
    return False, data, table, [picture]


def settings_in_words():
    """Return the configuration of the paper's cases and sweeps as text."""
    cases = {case: SETTINGS.problem(case) for case in PAPER_CASES}
    sweeps = {sweep: SETTINGS.sweeps[sweep] for sweep in PAPER_SWEEPS}
    swept = {
        name: {**sweep.model_dump(), "drawn": sweep.drawn.model_dump()}
        for name, sweep in sweeps.items()
    }
    studies = {name: getattr(SETTINGS, name).model_dump() for name in STUDIES}
    told = {"cases": cases, "sweeps": swept, **studies}
    return json.dumps(told, sort_keys=True, default=str)
