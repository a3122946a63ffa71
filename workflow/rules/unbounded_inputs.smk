# What the rules of the chain without ends take in, for the study of the full run and for the long.
from pendula.studies.unbounded.studies import MAPS, REST, SPREADS, STUDIES, THERMAL, VARIED
from pendula.studies.unbounded.studies import spread_problems, unbounded_problem

UNBOUNDED_FIGURES = ["growth_law", "front", "window_map"]


def map_names():
    return [f"map_{sweep}" for sweep in PAPER_SWEEPS]


def unbounded_problems(study, size):
    """Return the problems of a study, from the paper's case that it starts from."""
    case = VARIED[study][0] if study in VARIED else study
    return spread_problems(SETTINGS.problem(case), study, size)


def map_params(size):
    def problem(wildcards):
        case = SETTINGS.problem(SETTINGS.sweeps[wildcards.sweep].case)
        return unbounded_problem(case, MAPS[size]["end_time"], MAPS[size]["output_step"])

    return {
        "name": "{sweep}",
        "problem": problem,
        "rest": REST["short"],
        "half_widths": MAPS[size]["half_widths"],
        "members": lambda wildcards: MAPS[size]["members"][wildcards.sweep],
    }


def long_figure(name):
    kinds = {"png": "png", "pdf": "pdf", "data": "figure.nc"}
    return {key: f"results/unbounded/long/{name}.{kind}" for key, kind in kinds.items()}
