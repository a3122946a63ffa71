"""The keys of a case for type checkers and `help`; `cases.CaseSection` validates their values."""

from collections.abc import Callable, Mapping, Sequence
from inspect import Parameter, Signature
from pathlib import Path
from typing import Any, Literal, Required, TypedDict

import numpy as np
import xarray as xr

from latticode.equations.model import Model

from .values import Section as Keys

Numbers = float | Sequence[float] | np.ndarray | Callable[[np.ndarray], Any]
"""One number, one number per site, or a function of the sites."""
Initial = (
    Mapping[int, Sequence[complex | str] | np.ndarray]
    | Sequence[complex]
    | np.ndarray
    | Callable[[np.ndarray], Any]
    | xr.Dataset
    | xr.DataArray
    | str
    | Path
)
"""Data by site, an array, a function of the sites, a run, or a file."""
Boundary = Literal["dirichlet", "free", "periodic", "antiperiodic"]


class RunKeys(TypedDict, total=False):
    """The keys of every case, except equations and initial data."""

    half_width: int
    boundary: Boundary
    start_time: float
    end_time: float
    output_step: float
    snapshot_step: float | None
    times: Sequence[float] | np.ndarray | None
    keep: Literal["norms", "moduli", "state"]
    solver: str | Mapping[str, Any]


class ChangedKeys(RunKeys, total=False):
    """The keys that change a case of a model."""

    model: Model | str | Path
    parameters: Mapping[str, Numbers]
    initial: Initial
    sites: int | None


class CaseKeys(RunKeys, total=False):
    """The keys of a case of a model."""

    model: Required[Model | str | Path]
    parameters: Mapping[str, Numbers]
    initial: Required[Initial]
    sites: int | None


def show_keys(case: type[Keys], first: Sequence[str]) -> None:
    """Set the signature that `help` shows: the keys of a case with defaults, `first` first."""
    case.model_rebuild()  # otherwise pydantic would set its own signature at the first use
    names = [*first, *(name for name in case.model_fields if name not in first)]
    fields = {name: case.model_fields[name] for name in names}
    keys = [
        Parameter(
            name,
            Parameter.KEYWORD_ONLY,
            default=Parameter.empty if field.is_required() else field.default,
        )
        for name, field in fields.items()
        if not field.exclude
    ]
    case.__signature__ = Signature(keys)
