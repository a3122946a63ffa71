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


def fine_maps_of_fates():
    """Return the maps of `snakemake fates` as they are committed."""
    return committed("tests/baseline/quoted/breathers.nc", "quoted")


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
