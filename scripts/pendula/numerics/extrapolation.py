"""Solutions of few equations to all digits; the method shares nothing with the integrators."""

from collections.abc import Callable

import numpy as np

MIDPOINT_PARTS = (2, 4, 6, 8, 10, 12)
"""Parts into which a step is cut."""


def extrapolated(rate: Callable, start: np.ndarray, step: float) -> np.ndarray:
    """Return the solution of y' = rate(y) after one `step`, by Gragg's midpoint rule.

    Its error is a series in the squares of the parts of the step, so that MIDPOINT_PARTS parts are
    extrapolated to none at all, and the order is twelve. (E. Hairer, S. P. Norsett and G. Wanner,
    Solving Ordinary Differential Equations I, section II.9; the rule is used without smoothing.)
    """
    row = []
    for i, parts in enumerate(MIDPOINT_PARTS):
        h = step / parts
        old, new = start, start + h * rate(start)
        for _ in range(parts - 1):
            old, new = new, old + 2.0 * h * rate(new)
        finer = [new]
        for k, coarse in enumerate(row):
            ratio = parts / MIDPOINT_PARTS[i - 1 - k]
            finer.append(finer[k] + 1.0 / (ratio * ratio - 1.0) * (finer[k] - coarse))
        row = finer
    return row[-1]
