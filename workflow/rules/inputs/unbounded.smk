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
