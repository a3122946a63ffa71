"""Cases of one's own in words: their parameters, and numbers that link to their dataset."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from pendula.problem import read_initial
from pendula.report.numbers import MINUS, Quote, number
from pendula.report.words import SOLVERS

ENDS = {
    "dirichlet": "A = B = 0 beyond them",
    "free": "free",
    "periodic": "joined to a ring",
}
FEW = 8
"""Sites whose data find room in a table."""


def exact(value: Any) -> str:
    """Return a number as a configuration has it, to the digits that a reader needs."""
    if isinstance(value, complex):
        return str(value).strip("()") if value.imag else number(value.real, 8)
    return number(value, 8) if isinstance(value, int | float | np.number) else str(value)


def parameters(attributes: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Return what was solved and by which controls, a row each."""
    rows = [(sign, exact(attributes[key])) for key, sign in _SIGNS.items() if key in attributes]
    rows.append(("ends of the chain", ENDS[attributes["boundary"]]))
    rows += data(attributes)
    rows.append(("end time τ, output step", f"{exact(attributes['end_time'])}, "
                 f"{exact(attributes['output_step'])}"))  # fmt: skip
    rows.append(("solver", solver(attributes, "solver")))
    return rows


_SIGNS = {"omega": "Ω", "gamma": "γ", "epsilon": "ε", "half_width": "half-width M"}


def data(attributes: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Return the sites that are not at rest at the start, each with its amplitudes, if few."""
    sites = read_initial(attributes["initial"])
    if len(sites) > FEW:
        return [("A, B at the start", f"on {len(sites)} sites, as the dataset's attributes say")]
    return [
        (
            f"A, B at site {site}".replace("-", MINUS),
            ", ".join(map(exact, pair)),
        )
        for site, pair in sites.items()
    ]


def solver(attributes: Mapping[str, Any], key: str) -> str:
    """Return a solver and its controls, which the attributes carry as `key`, `key`_rtol and so on.

    For a second run the name itself stands under second_name.
    """
    name = str(attributes[key if key in attributes else f"{key}_name"])
    controls = {
        at.removeprefix(f"{key}_"): value
        for at, value in attributes.items()
        if at.startswith(f"{key}_") and at not in (f"{key}_name", f"{key}_refusal")
    }
    said = ", ".join(f"{at.replace('_', ' ')} {exact(value)}" for at, value in controls.items())
    return f"{SOLVERS.get(name, name)} ({said})" if said else SOLVERS.get(name, name)


def quotes(dataset, link: str) -> dict[str, Quote]:
    """Return every single number of a dataset, linked to it."""
    return {
        name: Quote(number(variable), link)
        for name, variable in dataset.data_vars.items()
        if variable.ndim == 0 and np.issubdtype(variable.dtype, np.number)
    }
