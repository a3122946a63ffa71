"""The section of a case that a configuration asks for."""

from collections.abc import Mapping
from typing import Any

import xarray as xr
from latticode.datasets.motions import section_at
from latticode.equations.model import Model

from pendula.problem import PaperProblem


def find_section(
    problem: PaperProblem, when: Mapping[str, Any], direction: str, site: int, name: str
) -> xr.Dataset:
    """Return the section at which the density of a model, as plain values, crosses zero."""
    ((function, density),) = Model.of_plain(when).conserved.items()
    return section_at(problem, density, direction, site, name).assign_attrs(when=function)
