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
    changes = {"output_step": given.output_step, "end_time": longest(PAPER_CASES)}
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
