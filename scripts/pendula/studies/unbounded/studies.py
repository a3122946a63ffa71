"""What is run on the chain without ends, and how far: plain values, for the workflow.

A study is a case of the paper, or one of its parameters varied, on chains without ends. `quick`
only exercises the rules, `short` is part of the full run, `long` is `snakemake unbounded`.
"""

CASES = ("fig4_small", "fig3_large", "fig3_small", "fig2_large")
"""The cases of Figs 5 and 6 (right and left) without ends."""

VARIED = {
    "omegas": ("fig4_small", "omega"),
    "amplitudes": ("fig3_large", "amplitude"),  # A_0, with B_0 = A_0 / 5 as in the paper
    "tolerances": ("fig4_small", "tolerance"),
}
STUDIES = (*CASES, *VARIED)

TOLERANCE = 1e-8
"""Enough for the statistics of a chaotic sea (see the study `tolerances`)."""

REST = {"quick": 1e-20, "short": 1e-20, "long": 1e-150}
"""What counts as at rest ahead of the front, of the largest amplitude: see `window`."""

VALUES = {
    "omegas": [-1.5, -1.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 5.5],
    "amplitudes": [1.0, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 5.5, 6.0, 7.0, 8.0],
    "tolerances": [1e-6, 1e-8, 1e-10],
}

SWEEPS = {"fig5_left": 1, "fig5_right": 4, "fig6_left": 1, "fig6_right": 4}
"""Members of each sweep: one where the motion is regular."""

THERMAL = {"quick": [0.0], "short": VALUES["omegas"]}
"""Omegas at which the thermal state is sampled."""

# (end time, members) of each study
SPREADS = {
    "quick": dict.fromkeys(STUDIES, (20, 1)) | {"fig4_small": (40, 2)},
    "short": {
        "fig4_small": (400, 4),
        "fig3_large": (400, 4),
        "fig3_small": (200, 1),
        "fig2_large": (200, 1),
        "omegas": (200, 2),
        "amplitudes": (100, 2),
        "tolerances": (100, 3),
    },
    "long": {
        "fig4_small": (2000, 3),
        "fig3_large": (2000, 3),
        "fig3_small": (1000, 1),
        "fig2_large": (1000, 1),
        "omegas": (400, 2),
        "amplitudes": (400, 2),
        "tolerances": (200, 4),
    },
}
MAPS = {
    "quick": {
        "half_widths": [4, 8, 2000],
        "end_time": 20,
        "output_step": 0.1,
        "members": dict.fromkeys(SWEEPS, 1),
    },
    "short": {
        "half_widths": [5, 10, 20, 40, 80, 160, 320, 2000],
        "end_time": 150,
        "output_step": 0.1,
        "members": SWEEPS,
    },
    "long": {
        "half_widths": [5, 7, 10, 14, 20, 28, 40, 56, 80, 113, 160, 226, 320, 453, 640, 905, 2000],
        "end_time": 500,
        "output_step": 0.1,
        "members": SWEEPS,
    },
}


def spread_problems(case: dict, study: str, size: str, output_step: float = 0.25) -> list[dict]:
    """Return the problems of a study, one for each value of what it varies.

    `case` is the paper's case, all of them as plain values (see pendula.problem).
    """
    end_time = float(SPREADS[size][study][0])
    base = unbounded_problem(case, end_time, output_step)
    if study not in VARIED:
        return [base]
    varied = VARIED[study][1]
    return [{**base, **_change(varied, value)} for value in VALUES[study]]


def unbounded_problem(case: dict, end_time: float, output_step: float) -> dict:
    """Return a case of the paper on a chain without ends."""
    kept = {key: case[key] for key in ("epsilon", "gamma", "omega", "initial")}
    solver = _solver(TOLERANCE)
    return {
        **kept,
        "half_width": None,
        "boundary": "dirichlet",
        "end_time": float(end_time),
        "output_step": output_step,
        "solver": solver,
    }


def _change(varied: str, value: float) -> dict:
    if varied == "omega":
        return {"omega": value}
    if varied == "amplitude":
        return {"initial": {0: (value, value / 5.0)}}
    return {"solver": _solver(value)}


def _solver(tolerance: float) -> dict:
    return {"name": "dop853", "rtol": tolerance, "atol": tolerance}
