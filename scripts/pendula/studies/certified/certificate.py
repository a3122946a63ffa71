"""The proof of a short case as a file that others can check with scripts/check_certificate.py.

All numbers are integers: coefficients in units of 2^-BITS, rates of 2^-RATE_BITS, bounds of
2^-BOUND_BITS. The coefficients have so few digits that the bound is close to what rounding them
requires, and a change of a last digit breaks the proof.
"""

import json
from collections.abc import Mapping
from math import ceil
from typing import Any

import numpy as np

from pendula.datasets import complete_or_absent
from pendula.problem import Problem

from .norm import decimal, find_form, find_rates
from .polynomials import Curve, find_curve
from .regular import prove, sample

BITS = 34
RATE_BITS, BOUND_BITS = 20, 60
ORDER = 14
SLACK = 1e-6
"""By this part each bound exceeds the computed one, times the number of the step."""


def make_certificate(problem: Problem) -> dict[str, Any]:
    """Return the certificate of a problem with Dirichlet ends; raises NotDefiniteError."""
    exact = find_curve(problem, ORDER, left_out=2.0**-BITS)
    curve = Curve(exact.step, np.rint(exact.terms * 2.0**BITS) * 2.0**-BITS)
    bounds = prove(problem, curve).errors[:, -1].sum(axis=1)
    rates = find_rates(sample(curve), problem, find_form(problem.constants))
    per_step = (len(rates) - 1) // len(bounds)
    constants = problem.constants
    terms = np.moveaxis(curve.terms, 2, 3) * 2.0**BITS  # (order, step, component, part, site)
    steps = []
    for j, bound in enumerate(bounds):
        rows = terms[:, j].reshape(len(terms), 4, -1)  # Re A, Im A, Re B, Im B
        own = rates[per_step * j : per_step * (j + 1) + 1]
        steps.append(
            {
                "terms": [[[int(x) for x in row] for row in term] for term in rows],
                # one more, as states at the ends of steps are rounded
                "rates": [ceil(rate * 2.0**RATE_BITS) + 1 for rate in own],
                "bound": ceil(2.0**BOUND_BITS * bound * (1.0 + SLACK * (j + 1))),
            }
        )
    return {
        "what": "i A_n' = epsilon (A_{n+1} - 2 A_n + A_{n-1}) + Omega A_n + gamma (conj B_n - "
        "conj A_n) + |A_n|^2 A_n / 2, the same with A and B exchanged, A = B = 0 beyond the ends",
        **{name: str(decimal(getattr(constants, name))) for name in ("epsilon", "gamma", "omega")},
        "initial": [
            [str(decimal(x)) for x in part]
            for one in problem.amplitudes
            for part in (one.real, one.imag)
        ],
        "steps_per_tau": round(1.0 / curve.step),
        "end_time": str(decimal(len(bounds) * curve.step)),
        "bits": BITS,
        "rate_bits": RATE_BITS,
        "bound_bits": BOUND_BITS,
        "steps": steps,
    }


def write_certificate(certificate: str, problem: Mapping[str, Any]) -> None:
    """Write the certificate of a problem, plain values, as JSON with one step a line."""
    made = make_certificate(Problem.of(problem))
    steps = ",\n".join(json.dumps(step) for step in made.pop("steps"))
    about = json.dumps(made, indent=1).removesuffix("\n}")
    with complete_or_absent(certificate) as partial:
        partial.write_text(f'{about},\n "steps": [\n{steps}\n]}}\n', encoding="utf-8")
