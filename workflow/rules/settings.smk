# What the rules give to their jobs: the code, and the configuration as plain values.
# Snakemake does not see a change in a module that a script imports. So what a job calls stands among
# its parameters with a hash of all code that it rests on.

from pendula.studies.chaos.settings import steps_beside

CALLED = {}


def digest(script):
    """Return a hash of a script below scripts/ with all that it imports."""
    return digest_of_code(SCRIPTS / script)


def function(*names, parts=()):
    """Return the names of functions, and a hash of their code: what a job calls.

    `parts` names modules that they find by the list of studies, such as "paper/claims".
    """
    files = [file for name in names for file in files_of_module(name.rpartition(".")[0])]
    found = [file for part in parts for file in files_with_prefix(part)]
    files += [path for file in found for path in (file.with_name("__init__.py"), file)]
    CALLED[(*names, *parts)] = files
    return [*names, digest_of_code(*files)]


def name_of(path):
    """Return the name that the claims have for a dataset."""
    return Path(*Path(path).with_suffix("").parts[1:]).as_posix()


def differs_of(wildcards, input):
    """Return sentences that say where a figure shows another configuration than the paper's.

    Of the datasets of many cases it shows those of its trajectories and sweeps, if it has such.
    """
    names = [name_of(path) for path in input if path.endswith(".nc")]
    names = [name for name in names if not name.startswith(("long/", "own/"))]
    own = [name.split("/", 1) for name in names]
    on = [rest for folder, rest in own if folder in ("trajectories", "sweeps")]
    return list(concerning(DIFFERS, names, on).values())


def code_of_jobs():
    """Return the names of all files of code that jobs rest on."""
    files = {module for entries in CALLED.values() for module in modules_of(*entries)}
    return sorted(file.relative_to(PROJECT).as_posix() for file in files)


# --- Settings as functions of the library take them ------------------------------------------------


def values_of(part, *names):
    """Return the settings of these names, or all but those of a longer study, as plain values."""
    plain = part.model_dump()
    chosen = names or [name for name in plain if name != "long"]
    found = {name: getattr(part, name) for name in chosen}
    return {k: one.values if isinstance(one, Steps) else plain[k] for k, one in found.items()}


def of_size(part, wildcards):
    """Return a part of the configuration, or its parts for a longer and a shorter study."""
    return part.long if wildcards.size else getattr(part, "short", part)


def sized(part, *names):
    """Return a function of the wildcards that gives the settings of these names."""
    return lambda wildcards: values_of(of_size(part, wildcards), *names)


run_of = SETTINGS.run_of


def without_solver(problem):
    return {key: value for key, value in problem.items() if key != "solver"}


def followed(cases, tolerance, solver="taylor", **changes):
    return {case: run_of(case, tolerance, solver, **changes) for case in cases}


def longest(cases):
    return max(SETTINGS.cases[case].end_time for case in cases)


def member_of(sweep):
    """Return what a member of the ensemble of a sweep runs, to the end of the drawn windows."""
    ensembles, drawn = SETTINGS.chaos.ensembles, SETTINGS.sweeps[sweep].drawn
    windows = [list(window) for window in (drawn.max, drawn.mean)]
    times = {"output_step": ensembles.output_step, "end_time": max(end for _, end in windows)}
    problem = run_of(SETTINGS.sweeps[sweep].case, ensembles.tolerance, **times)
    return {"problem": problem, "windows": windows}


def by_second_solver(sweep):
    """Return the problems of a sweep by the paper's second solver, with its step and a coarse one."""
    problem = SETTINGS.swept_problem(sweep, "crank_nicolson")
    problem |= {"end_time": member_of(sweep)["problem"]["end_time"], "snapshot_every": 0}
    steps = steps_beside(problem["solver"]["step"], problem["output_step"])
    return [{**problem, "solver": {**problem["solver"], "step": step}} for step in steps]


def drawn_windows(sweep):
    drawn = SETTINGS.sweeps[sweep].drawn
    return {"text_window": name_window(drawn.max), "caption_window": name_window(drawn.mean)}


def points_are_the_papers():
    """Return whether no case of a figure has other constants than in the paper."""
    constants = ("epsilon", "gamma", "omega")
    return not any(f"cases.{case}.{key}" in DIFFERS for case in PAPER_CASES for key in constants)


def points_of_cases():
    """Return (Omega, gamma) of the figures' cases in units of epsilon, once each."""
    problems = [SETTINGS.problem(case) for case in PAPER_CASES]
    problems = [problem for problem in problems if problem["epsilon"]]
    return sorted({(p["omega"] / p["epsilon"], p["gamma"] / p["epsilon"]) for p in problems})


def certified_problem(case):
    """Return a case as a problem whose solver is not asked; stop where it is not even."""
    from pendula.problem import Problem  # this and the next for a target of its own alone
    from pendula.studies.certified.fixed_point import NotEvenError, half_chain

    plain = SETTINGS.problem(case, snapshot_step=None)
    if plain.get("model", "amplitudes") != "amplitudes":
        stop(f"cases.{case}.model: proofs are of curves of the amplitudes, equations (4)")
    problem = {**plain, "solver": {"name": "polynomials"}}
    try:
        half_chain(Problem.of(problem), 1)
    except NotEvenError as error:
        stop(f"cases.{case}: {error}")
    return problem


def reference_problem(case):
    sweeps = [SETTINGS.sweeps[name] for name in PAPER_SWEEPS]
    drawn = [sweep.drawn for sweep in sweeps if sweep.case == case]
    ends = [end for windows in drawn for _, end in (windows.max, windows.mean)]
    return SETTINGS.problem(case, end_time=max([SETTINGS.cases[case].end_time, *ends]))


# --- What a job asks of a cluster -----------------------------------------------------------------

START_MB, START_MINUTES = 1000, 15  # of Python, imports and a compilation
SPARE = 5  # estimates are within a factor of three, and a node may be slower
LONG = Cost(3600 / SPARE, 0.0)  # with what is spare, an hour


def cost_of_study(wildcards):
    return LONG if wildcards.size else Cost(0.0, 0.0)


def asked(cost_of):
    """Return the resources of a job whose run is estimated to take cost_of(wildcards)."""

    def memory(wildcards, attempt):
        return attempt * (START_MB + math.ceil(2e-6 * cost_of(wildcards).memory))

    def minutes(wildcards, attempt):
        return attempt * (START_MINUTES + math.ceil(SPARE * cost_of(wildcards).seconds / 60))

    return {"mem_mb": memory, "runtime": minutes}
