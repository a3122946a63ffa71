# What the rules on chaos are given: cases and sweeps as plain values of a Problem, and the choices
# of config/chaos.yaml.


def followed(cases, tolerance, **changes):
    solver = {"name": "dop853", "rtol": tolerance, "atol": tolerance}
    plain = {"solver": solver, "snapshot_every": 0, **changes}
    return {case: {**SETTINGS.problem(case), **plain} for case in cases}


def longest(cases):
    return max(SETTINGS.cases[case].end_time for case in cases)


def in_any(sweeps, key):
    """Return what the sweeps have under `key`, each once: all are run over all of it."""
    return sorted({value for name in sweeps for value in getattr(SETTINGS.sweeps[name], key)})


def swept(sweeps, tolerance):
    cases = {name: SETTINGS.sweeps[name].case for name in sweeps}
    end_time = max(end for _, end in in_any(sweeps, "windows"))
    problems = followed(cases.values(), tolerance, end_time=end_time)
    return {name: problems[case] for name, case in cases.items()}


def lyapunov_params(given):
    short = given.spectrum
    return {
        "problems": followed(PAPER_CASES, given.tolerance),
        "end_time": given.lengths * longest(PAPER_CASES),
        "tolerances": given.diverging_tolerances,
        "short_problems": followed(short.cases, given.tolerance, half_width=short.half_width),
        "short_end_time": short.lengths * longest(short.cases),
    }


def symmetry_params(given):
    end_time = longest(PAPER_CASES)
    return {
        "problems": followed(PAPER_CASES, given.tolerance, end_time=end_time),
        "size": given.size,
        "members": given.members,
        "seed": given.seed,
    }


def ensemble_params(given):
    end_time = longest(given.cases)
    return {
        "problems": followed(given.cases, given.tolerance, end_time=end_time),
        "members": given.members,
        "swept_problems": swept(given.sweeps, given.tolerance),
        "half_widths": in_any(given.sweeps, "half_widths")[:: given.every],
        "windows": in_any(given.sweeps, "windows"),
        "swept_members": given.swept_members,
        "size": given.size,
        "seed": given.seed,
    }
