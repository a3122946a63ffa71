"""The dataset of a localised state of a user's own case."""

import numpy as np
import xarray as xr
from latticode.datasets.checks import table, variable
from latticode.localised.breathers import NoStateError, exponents, find_state

from pendula.problem import Problem

TITLE = "A localised state of a model of one's own"
LOCALISED = 0.01
"""Largest value at the sites farthest from the centre, relative to that at the centre."""


def check_breather(problem: Problem) -> xr.Dataset:
    """Return a localised state with its exponents, or as an attribute why there is none.

    The multipliers are those over a period, or over a unit of tau where the state is steady.
    """
    try:
        with np.errstate(all="ignore"):  # Newton's method may run away, and is then stopped
            state = find_state(problem)
    except NoStateError as error:
        return xr.Dataset(attrs={"breather_refusal": str(error)})
    parts = state.parts(problem)
    moduli = np.sqrt(np.sum(parts**2, axis=1))
    sizes = moduli.max(axis=0)
    away = np.abs(np.arange(sizes.size) - sizes.argmax())
    end = sizes[away >= away.max() - 1].max() / sizes.max()
    waves, found = exponents(problem, state._replace(x=0.0 * state.x)), exponents(problem, state)
    period = 2.0 * np.pi / abs(state.frequency) if state.frequency else 1.0
    growth, multipliers = found.real.max(), np.exp(period * found)
    frequencies = "its distance from the frequencies of linear waves"
    edge = "its largest value far from the centre, over that at the centre"
    modes, sites = ("part", "mode"), np.arange(sizes.size) - problem.half_width
    numbers = {
        "_frequency": (state.frequency, (), "frequency lambda of a localised state"),
        "_gap": (np.abs(waves).min(), (), frequencies),
        "_end": (end, (), edge),
        "_growth": (growth, (), "largest rate of growth of its perturbations, per unit of tau"),
        "_exponents": (_parts(found), modes, "exponents of its perturbations, per unit of tau"),
        "_multipliers": (_parts(multipliers), modes, "Floquet multipliers of its perturbations"),
        "": (moduli, ("component", "site"), "moduli of a localised state"),
    }
    described = {f"breather{name}": variable(*given, digits=6) for name, given in numbers.items()}
    axes = {"part": ["re", "im"], "component": list(problem.model.fields), "site": sites}
    return xr.Dataset.from_dict(table(TITLE, axes, **described))


def _parts(values: np.ndarray) -> np.ndarray:
    return np.stack([values.real, values.imag])
