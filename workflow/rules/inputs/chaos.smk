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
    step = min(SETTINGS.cases[case].output_step for case in given.cases)
    times = {"end_time": longest(given.cases), "output_step": step}
    cases = followed(given.cases, given.tolerance, "taylor", **times)
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
