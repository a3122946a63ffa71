"""The equations (4) in the unknowns S = (A + B) / sqrt 2 and D = (A - B) / sqrt 2.

The drive acts on D alone. The chain that it excites has A = -B, and S is tiny. In the unknowns A
and B, S is smaller than rounding errors, which are 1e-16 of D. These errors grow as S does, so S
seems to fill the chain too early. As an unknown of its own, S has all of its digits.
"""

from dataclasses import asdict
from typing import Any

import numpy as np
from latticode.equations.model import Model, Value, abs2, conj, lap

from pendula.problem import PaperProblem

ROOT = np.sqrt(0.5)


def i_dt(p: Any, s: Value, d: Value) -> list[Value]:
    """Return i dS_n/dtau and i dD_n/dtau."""
    mean = 0.25 * (abs2(s) + abs2(d))
    both = 0.5 * Value((s * conj(d)).re)
    return [
        p.epsilon * lap(s) + p.omega * s + (mean * s + both * d),
        p.epsilon * lap(d) + (p.omega * d - 2.0 * p.gamma * conj(d)) + (mean * d + both * s),
    ]


EQUATIONS = Model(
    fields=("S", "D"), parameters=dict.fromkeys(("epsilon", "gamma", "omega"), 1.0), i_dt=i_dt
)


def halves(rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the first half of the rows, and the second half."""
    return rows[: len(rows) // 2], rows[len(rows) // 2 :]


def turned(values: np.ndarray) -> np.ndarray:
    """Return (S, D) from (A, B), or (A, B) from (S, D), in the two halves of the rows.

    `values` are complex (component, ...), or rows of real and imaginary parts (row, ...).
    """
    first, second = halves(values)
    return ROOT * np.concatenate([first + second, first - second])


def in_sums(problem: PaperProblem) -> PaperProblem:
    """Return a problem of (4) in the unknowns S and D."""
    parameters = asdict(problem.constants)
    return problem.changed(model=EQUATIONS, parameters=parameters, initial=turned(problem.initial))
