"""Captions of figures and contents of datasets, from the attributes of a run's files."""

import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import netCDF4
import numpy as np
from latticode.datasets.netcdf import readable
from PIL import Image

from replication.words import number

WORDS = 300
"""Maximum length of an attribute on the page; longer texts, such as a model's, are cut."""
SHARED = {"Conventions", "version", "history"}
"""Attributes that are the same in every dataset of a run."""


class MapLink(NamedTuple):
    """Symbols of a panel's axes, and an address for its points with the fields {x} and {y}."""

    x: str
    y: str
    address: str


class ClickablePanel(NamedTuple):
    """A panel whose points are links: left, top, width, height in % of the picture, and limits."""

    link: MapLink
    box: tuple[float, ...]
    x: tuple[float, float]
    y: tuple[float, float]


class DescribedFigure(NamedTuple):
    """A figure; `stem` is the path of its files relative to the page, without suffix."""

    stem: str
    caption: str
    width: int
    height: int
    maps: Sequence[ClickablePanel] = ()

    @property
    def label(self) -> str:
        """The name of a figure of the paper, such as Fig 5; empty for other figures."""
        match = re.fullmatch(r"figures/fig(\d)", self.stem)
        return f"Fig {match[1]}" if match else ""

    @property
    def headline(self) -> str:
        """The caption up to its first full stop or colon."""
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


def figure(path: Path, page: Path, links: Sequence[MapLink] = ()) -> DescribedFigure:
    """Return the description of the figure with the dataset `path`; `page` is the page's folder.

    `links` are for the points of its first panels.
    """
    with readable(path), netCDF4.Dataset(path) as data:
        caption = data.caption
    with Image.open(path.with_suffix(".png")) as picture:
        size, panels = picture.size, picture.info.get("Panels", "").split(";")
    maps = []
    if links:
        drawn = json.loads(path.with_suffix(".json").read_text(encoding="utf-8"))["panels"]
        maps = [_panel(*panel, size) for panel in zip(links, panels, drawn, strict=False)]
    stem = path.relative_to(page).with_suffix("").as_posix()
    return DescribedFigure(stem, caption, *size, maps)


def _panel(
    link: MapLink, edges: str, drawn: dict[str, Any], size: tuple[int, int]
) -> ClickablePanel:
    """Return a panel from its edges in pixels, and its description with the limits of its axes."""
    left, top, right, bottom = (
        100 * int(edge) / size[place % 2] for place, edge in enumerate(edges.split())
    )
    box = tuple(round(length, 3) for length in (left, top, right - left, bottom - top))
    return ClickablePanel(link, box, drawn["x"]["limits"], drawn["y"]["limits"])


def dataset(path: Path, page: Path) -> DescribedDataset:
    """Return the description of the dataset `path`; `page` is the page's folder."""
    with readable(path), netCDF4.Dataset(path) as data:
        raw_attributes = {name: value for name, value in vars(data).items() if name not in SHARED}
        variables = [_variable(variable) for variable in data.variables.values()]
    attributes = {name: _attribute_text(value) for name, value in raw_attributes.items()}
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


def _attribute_text(value: Any) -> str:
    if np.ndim(value):
        return _shortened(", ".join(map(_attribute_text, value)))
    if isinstance(value, str):
        return _shortened(value)
    return str(value) if isinstance(value, int | np.integer) else number(value, 5)


def _shortened(text: str) -> str:
    return text if len(text) <= WORDS else f"{text[:WORDS]} ..."
