# What the rules on chaos take in: cases and sweeps as arguments of pendula.simulation.simulate.simulate.


def followed(cases, tolerance, **changes):
    solver = {"name": "dop853", "rtol": tolerance, "atol": tolerance}
    plain = {"solver": solver, "snapshot_every": 0, **changes}
    return {case: {**SETTINGS.problem(case), **plain} for case in cases}


def longest(cases):
    return max(SETTINGS.cases[case].end_time for case in cases)


def in_any(key):
    """Return what the chaotic sweeps have under `key`, each once: all are run over all of it."""
    return sorted(
        {value for name in CHAOTIC_SWEEPS for value in getattr(SETTINGS.sweeps[name], key)}
    )


def swept(tolerance):
    cases = {name: SETTINGS.sweeps[name].case for name in CHAOTIC_SWEEPS}
    end_time = max(end for _, end in in_any("windows"))
    problems = followed(cases.values(), tolerance, end_time=end_time)
    return {name: problems[case] for name, case in cases.items()}
