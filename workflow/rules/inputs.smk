# What the rules take in, study by study: paths, and plain values of the configuration. The functions
# stand apart from the rules, so that a file of rules reads as a list of them.
import json

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


# The theory, and the ledger of all claims.
def checks(*names):
    return [f"results/checks/{name}.nc" for name in names]


def trajectories(solver=""):
    return [f"results/trajectories/{case}{solver}.nc" for case in PAPER_CASES]


def sweeps(solver=""):
    return [f"results/sweeps/{sweep}{solver}.nc" for sweep in PAPER_SWEEPS]


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


# The chain without ends, for the study of the full run and for the long one.
def map_names():
    return [f"map_{sweep}" for sweep in PAPER_SWEEPS]


def run_params(size):
    given = SETTINGS.unbounded

    def problems(wildcards):
        case = SETTINGS.problem(given.case_of(wildcards.study))
        return given.problems(case, wildcards.study, size)

    return {
        "name": "{study}",
        "problems": problems,
        "rest": size.rest,
        "members": lambda wildcards: size.runs[wildcards.study].members,
        "perturbation": given.perturbation,
        "seed": given.seed,
    }


def map_params(size):
    maps = size.maps

    def problem(wildcards):
        case = SETTINGS.problem(SETTINGS.sweeps[wildcards.sweep].case)
        return SETTINGS.unbounded.map_problem(case, size)

    return {
        "name": "{sweep}",
        "problem": problem,
        "rest": maps.rest,
        "half_widths": maps.half_widths,
        "members": lambda wildcards: maps.members[wildcards.sweep],
        "perturbation": SETTINGS.unbounded.perturbation,
        "seed": SETTINGS.unbounded.seed,
    }


def long_figure(name):
    kinds = {**FIGURE_KINDS, "data": "figure.nc"}
    return {key: f"results/unbounded/long/{name}.{kind}" for key, kind in kinds.items()}


def growth_inputs(folder):
    """Return the runs that are measured, of the full run or of the long study in `folder`."""
    runs = {"omegas": "omegas", "bulk": "fig4_small", "large": "fig3_large"}
    return {
        "runs": expand(f"{folder}/{{case}}.nc", case=GROWTH_CASES),
        **{name: f"{folder}/{run}.nc" for name, run in runs.items()},
        "thermal": "results/unbounded/thermal.nc",
    }


# Chaos: cases and sweeps as plain values of a Problem, and the choices of config/chaos.yaml.
def followed(cases, tolerance, solver="dop853", **changes):
    solver = {"name": solver, "rtol": tolerance, "atol": tolerance}
    plain = {"solver": solver, "snapshot_every": 0, **changes}
    return {case: {**SETTINGS.problem(case), **plain} for case in cases}


def longest(cases):
    return max(SETTINGS.cases[case].end_time for case in cases)


def in_any(sweeps, key):
    """Return what the sweeps have under `key`, each once: all are run over all of it."""
    return sorted({value for name in sweeps for value in getattr(SETTINGS.sweeps[name], key)})


def swept(drawn, tolerance):
    """Return by sweep what its ensembles run, each to the end of the last window of any."""
    end_time = max(end for _, end in in_any(drawn, "windows"))
    cases = {name: SETTINGS.sweeps[name].case for name in drawn}
    problems = followed(cases.values(), tolerance, "taylor", end_time=end_time)
    return {name: {"problem": problems[cases[name]], **dict(one)} for name, one in drawn.items()}


def lyapunov_params(given):
    short = given.spectrum
    longest_short = longest(short.cases)
    return {
        "problems": followed(PAPER_CASES, given.tolerance),
        "end_time": given.lengths * longest(PAPER_CASES),
        "tolerances": given.diverging_tolerances,
        "short_problems": followed(short.cases, short.tolerance),
        "short_end_times": {m: times * longest_short for m, times in short.lengths.items()},
        "undriven_end": short.undriven_lengths * longest_short,
        "seed": given.seed,
    }


def symmetry_params(given):
    end_time = longest(PAPER_CASES)
    return {
        "problems": followed(PAPER_CASES, given.tolerance, end_time=end_time),
        "size": given.size,
        "members": given.members,
        "seed": given.seed,
        "step": given.output_step,
    }


def ensembles_of(*names):
    """Return the dataset of the ensembles if one of these cases or sweeps has one, else nothing."""
    made = {*ENSEMBLE_CASES, *ENSEMBLE_SWEEPS}
    return checks("ensembles") if made & set(names) else []


def ensemble_params(given):
    """Return what both kinds of ensembles run; the bands of cases are those of even ones."""
    end_time = longest(given.cases)
    cases = followed(given.cases, given.tolerance, "taylor", end_time=end_time)
    sweeps, uneven = (swept(one, given.tolerance) for one in (given.sweeps, given.uneven))
    return {
        "problems": lambda wildcards: {} if wildcards.kind else cases,
        "members": given.members,
        "swept": lambda wildcards: uneven if wildcards.kind else sweeps,
        "windows": in_any(given.sweeps, "windows"),
        "size": given.size,
        "seed": given.seed,
    }


def member_params(given):
    end_time = max(end for _, end in given.windows)
    changes = {"end_time": end_time, "snapshot_every": given.every}
    return {
        "problems": followed(PAPER_CASES, given.tolerance, "taylor", **changes),
        "windows": given.windows,
        "members": given.members,
        "size": given.size,
        "seed": given.seed,
    }


def lifetime_params(given):
    changes = {"end_time": given.end_time, "output_step": given.output_step}
    (problem,) = followed([given.case], given.tolerance, "taylor", **changes).values()
    plain = ("amplitudes", "ratio", "size", "members", "settled", "seed")
    return {
        "problem": problem,
        "compared": given.compared.amplitude,
        "choices": given.compared.choices,
        **{name: getattr(given, name) for name in plain},
    }


# Breathers.
BREATHERS = ["steady", "periodic", "growth", "sensitivity", "fates"]


def steady_params(given):
    steady = given.steady
    return {
        "epsilon": given.epsilon,
        "gamma": given.gamma,
        "omegas": steady.omegas,
        "half_width": steady.half_width,
        "searched": steady.stability.between,
        "distance": steady.stability.to,
    }


def periodic_params(given):
    plain = given.periodic.model_dump(exclude={"long"})
    return {"epsilon": given.epsilon, "gamma": given.gamma, **plain}


def perturbed_params(given):
    return {**periodic_params(given), **given.periodic.long.model_dump()}


def drive_params(given):
    plain = given.growth.model_dump()
    return {"epsilon": given.epsilon, **plain, "frequencies": given.growth.frequencies.values}


def sensitivity_params(given, size):
    (problem,) = followed([given.case], given.tolerance, "taylor", end_time=given.end_time).values()
    size = given if size == "full" else given.long
    return {
        "name": given.case,
        "problem": problem,
        "sizes": given.sizes,
        "members": size.members,
        "seed": given.seed,
        "amplitudes": size.scan.values,
    }


def cases_on_one_pair():
    """Return the paper's cases that have real data on one pair."""

    def on_one_pair(initial):
        (site, pair), *others = initial.items()
        return not (others or site or any(complex(one).imag for one in pair))

    return [case for case in PAPER_CASES if on_one_pair(SETTINGS.problem(case)["initial"])]


def long_breathers_figure(name):
    kinds = {**FIGURE_KINDS, "data": "figure.nc"}
    return {key: f"results/breathers/long/{name}.{kind}" for key, kind in kinds.items()}


def fate_params(breathers, size):
    given, plain = breathers.fates, ("half_width", "end_time")
    like = {"output_step": given.end_time, **{name: getattr(given, name) for name in plain}}
    cases = followed(cases_on_one_pair(), given.tolerance, "taylor", **like)
    (problem,) = followed(["fig4_small"], given.tolerance, "taylor", **like).values()
    problem = {**problem, "epsilon": breathers.epsilon, "gamma": breathers.gamma}
    size = given if size == "full" else given.long
    return {
        "problems": {omega: {**problem, "omega": omega} for omega in given.omegas},
        "amplitudes": given.amplitudes(size.points),
        "turned": given.amplitudes(size.phases.amplitudes),
        "phases": given.turns(size.phases.points),
        "ratio": given.phases.ratio,
        "checked": size.checked,
        "cases": cases,
    }


# The pendula.
PENDULA = ["threshold", "remainder", "phases", "sea", "over_the_top"]


def threshold_params(given):
    plain = given.model_dump(exclude={"growth", "curve"})
    return {
        **plain,
        "growth_omegas": given.growth.omegas,
        "gammas": given.growth.gammas.values,
        "curve_omegas": given.curve.values,
    }


def remainder_params(given, run_ends):
    like = {"end_time": given.end_step, "output_step": given.end_step}
    return {
        "problems": followed(given.ends, given.tolerance, "taylor", **like),
        "run_ends": run_ends,
        "end_step": given.end_step,
        "spacing": given.spacing,
    }


def long_remainder_figure():
    kinds = {**FIGURE_KINDS, "data": "figure.nc"}
    return {key: f"results/pendula/long/remainder.{kind}" for key, kind in kinds.items()}


def phases_params(given):
    changes = {"output_step": given.output_step}
    problems = followed(PAPER_CASES, given.tolerance, "taylor", **changes)
    plain = given.model_dump(include={"mus", "look_every", "ensemble"})
    return {"problems": problems, **plain}


def sea_params(given, size):
    changes = {"end_time": given.window[1], "output_step": given.output_step}
    (problem,) = followed([given.case], given.tolerance, "taylor", **changes).values()
    plain = given.model_dump(include={"window", "size", "seed"})
    return {"problem": problem, **plain, "mus": size.mus, "members": size.members}


def passage_params(given, size):
    changes = {"end_time": size.end_time}
    (problem,) = followed([given.case], given.tolerance, "taylor", **changes).values()
    plain = given.model_dump(include={"mus", "per_period", "size", "seed", "settled"})
    return {"problem": problem, **plain, "members": size.members}


def film_params(given):
    changes = {"model": "pendula", "mu": given.mu}
    problems = followed(given.cases, given.tolerance, "taylor", **changes)
    return {"problems": problems, **given.model_dump(include={"reach", "periods", "per_period"})}


def long_passages_figure():
    kinds = {**FIGURE_KINDS, "data": "figure.nc"}
    stem = "results/pendula/long/over_the_top"
    return {key: f"{stem}.{kind}" for key, kind in kinds.items()}


# Proofs.
def certified_problem(case):
    """Return a case as a problem whose solver is not asked; stop where no bound can be proved.

    A case of the paper that the configuration has changed has an infinite bound then, so that the
    rest of a full run goes on.
    """
    plain = SETTINGS.problem(case, snapshot_step=None)
    if case in OWN_CASES:
        if plain.get("model", "amplitudes") != "amplitudes":
            stop(f"cases.{case}.model: proofs are of curves of the amplitudes, equations (4)")
        try:
            find_form(Constants.of(plain))
        except NotDefiniteError as error:
            stop(f"cases.{case}.omega: {error}")
    return {**plain, "solver": {"name": "polynomials"}}


def short_problem(given):
    short = {"half_width": given.half_width, "end_time": given.end_time}
    return {**certified_problem(given.case), **short}


def proved_curves():
    return below(f"certified/{case}" for case in SETTINGS.certified.curves.cases)


def framed_curves():
    return below(f"certified/{case}" for case in SETTINGS.certified.frames)


def committed_proofs():
    """Return the proofs that are kept; that of a case new in the configuration is made first."""
    proofs = [f"tests/baseline/proofs/{case}.nc" for case in SETTINGS.certified.frames]
    return [committed(proof, "certified") for proof in proofs if is_committed(proof)]


def framed_problem(case):
    from pendula.problem import Problem  # this and the next for a long target alone
    from pendula.studies.certified.fixed_point import NotEvenError, half_chain

    given = SETTINGS.certified.frames[case]
    problem = {**certified_problem(case), "end_time": given.end_time}
    try:
        half_chain(Problem.of(problem), given.bits)
    except NotEvenError as error:
        stop(f"cases.{case}: {error}")
    return problem


def proof_by_frames(case):
    return SETTINGS.certified.frames[case].model_dump(exclude={"end_time"})


def constants_params():
    """Return the cases and the arguments of checks that lead to the constants."""
    given = {
        name: arguments
        for group in GROUPS
        for name, arguments in SETTINGS.theory.arguments(group).items()
        if name in ENCLOSED
    }
    return {
        "names": [f"checks/{name}" for name in ENCLOSED],
        "problems": {case: SETTINGS.problem(case, snapshot_step=None) for case in PAPER_CASES},
        "theory": given,
    }


def known_reference(case):
    return references(case) if case in PAPER_CASES else []


def wrong_curve_params(given):
    made_for = given.model_dump(include={"epsilon", "gamma", "omega"}, exclude_none=True)
    problem = {**certified_problem(given.case), "end_time": given.end_time}
    return {"name": given.case, "problem": problem, "made_for": made_for}


# The report.
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
    *("breathers/find_steady.py", "breathers/find_periodic.py"),
    *("breathers/measure_growth_by_drive.py", "breathers/measure_sensitivity.py"),
    "breathers/map_fates.py",
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


OTHER_STUDIES = ("theory", "chaos", "breathers", "pendula", "unbounded", "certified")
# The parts of the ledger, and the modules of claims in each, by the starts of their names
CLAIMS_OF = {
    "figures": ["paper/claims_norms", "paper/claims_sweeps"],
    "solvers": ["paper/claims_regular", "paper/claims_solvers"],
    **{study: [f"{study}/claims"] for study in OTHER_STUDIES},
}


CLAIMED_RUNS = ["fig2_large", "fig3_small", "fig3_large", "fig4_small"]
CLAIMED_RUNS += ["omegas", "amplitudes", "thermal"]  # of chains without ends


def claims_need():
    """Return by part of the ledger the rule that makes each of the datasets that it reads.

    Beside what the claims rest on these are the checks of the part, which its table shows.
    """
    second = trajectories(".crank_nicolson"), sweeps(".crank_nicolson")
    of_theory = (*(name for names in GROUPS.values() for name in names), "sweeps")
    needs = {
        "figures": [*trajectories(), *sweeps(), *checks("not_shown", "ensembles")],
        "solvers": [
            *(*trajectories(), *trajectories(".dop853"), *sweeps(), *second[0], *second[1]),
            *checks("cases", "lyapunov", "ensembles", "members", *SOLVER_CHECKS),
        ],
        "theory": [
            *(*trajectories(), *checks("lyapunov", *of_theory)),
            *checks(*(f"wrong/{name}" for name in WRONG)),
        ],
        "chaos": [
            *below(["sweeps/fig5_left", "sweeps/fig6_left", "breathers/sensitivity"]),
            *checks("trust", *CHAOS_CHECKS),
        ],
        "breathers": below(f"breathers/{name}" for name in BREATHERS),
        "pendula": [
            *below([*(f"pendula/{name}" for name in PENDULA), "unbounded/thermal"]),
            *checks("lyapunov"),
        ],
        "certified": [
            *(*proved_curves(), *below(["certified/wrong/curve"])),
            *below(["trajectories/fig2_small", "trajectories/fig3_small"]),
            *below(["certified/breathers", "certified/constants", "breathers/steady"]),
        ],
        "unbounded": [
            *below(["breathers/sensitivity", *(f"unbounded/{name}" for name in CLAIMED_RUNS)]),
            *below(f"unbounded/map_{sweep}" for sweep in ("fig5_left", "fig5_right", "fig6_left")),
        ],
    }
    made_by = makers()
    named = {part: map(name_of, paths) for part, paths in needs.items()}
    return {part: {name: made_by[name] for name in names} for part, names in named.items()}


def below(names):
    return [f"results/{name}.nc" for name in names]


CLAIMS_NEED = claims_need()
CLAIMS_CODE = {
    part: code("ledger/decide_claims.py", *modules, of=part) for part, modules in CLAIMS_OF.items()
}
