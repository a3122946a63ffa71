"""Captions of figures and contents of datasets, from the attributes of a run's files."""

import re
import struct
from pathlib import Path
from typing import Any, NamedTuple

import netCDF4
import numpy as np
from latticode.datasets.netcdf import readable

from replication.words import number

WORDS = 300
"""Longer attributes, such as a model's text, are cut off on the page."""
SIZE_OF_PNG = slice(16, 24)
"""The bytes of a PNG with its width and height."""
SHARED = {"Conventions", "version", "history"}
"""Attributes that are the same in every dataset of a run."""


class DescribedFigure(NamedTuple):
    """A figure; `stem` is the path of its files relative to the page, without their endings."""

    stem: str
    caption: str
    width: int
    height: int

    @property
    def label(self) -> str:
        """The name of a figure of the paper, such as Fig 5, and nothing for others."""
        match = re.fullmatch(r"figures/fig(\d)", self.stem)
        return f"Fig {match[1]}" if match else ""

    @property
    def headline(self) -> str:
        """How the caption begins."""
        return re.split(r"[.:] ", self.caption)[0].rstrip(".")


class DescribedVariable(NamedTuple):
    """The description of a variable of a dataset."""

    name: str
    meaning: str
    units: str
    dimensions: str


class DescribedDataset(NamedTuple):
    """The description of a dataset; `link` is its path relative to the page."""

    link: str
    title: str
    attributes: dict[str, str]
    variables: list[DescribedVariable]


def figure(path: Path, page: Path) -> DescribedFigure:
    """Return the figure with the dataset at `path`, for a page in the folder `page`."""
    with readable(path), netCDF4.Dataset(path) as data:
        caption = data.caption
    with path.with_suffix(".png").open("rb") as picture:
        size = struct.unpack(">II", picture.read(SIZE_OF_PNG.stop)[SIZE_OF_PNG])
    stem = path.relative_to(page).with_suffix("").as_posix()
    return DescribedFigure(stem, caption, *size)


def dataset(path: Path, page: Path) -> DescribedDataset:
    """Return the description of the dataset at `path`, for a page in the folder `page`."""
    with readable(path), netCDF4.Dataset(path) as data:
        raw_attributes = {name: value for name, value in vars(data).items() if name not in SHARED}
        variables = [_variable(variable) for variable in data.variables.values()]
    attributes = {name: _in_words(value) for name, value in raw_attributes.items()}
    title = attributes.pop("title", "")
    return DescribedDataset(path.relative_to(page).as_posix(), title, attributes, variables)


def _variable(variable: netCDF4.Variable) -> DescribedVariable:
    attributes = vars(variable)
    dimensions = " × ".join(
        f"{k} {n}" for k, n in zip(variable.dimensions, variable.shape, strict=True)
    )
    units = attributes.get("units", "1")
    return DescribedVariable(
        variable.name, attributes.get("long_name", ""), "" if units == "1" else units, dimensions
    )


def _in_words(value: Any) -> str:
    if np.ndim(value):
        return _shortened(", ".join(map(_in_words, value)))
    if isinstance(value, str):
        return _shortened(value)
    return str(value) if isinstance(value, int | np.integer) else number(value, 5)


def _shortened(text: str) -> str:
    return text if len(text) <= WORDS else f"{text[:WORDS]} ..."
