"""Labels of figures and datasets on the page of `snakemake --report`, read from the files.

Each result has only one label. The page would offer a second label as a switch, and go blank if
there are only two results.
"""

from collections.abc import Sequence
from pathlib import Path
from textwrap import shorten
from typing import Any

MOST_LETTERS = 64
"""Maximum length of a caption in a label."""


def folder_of(wildcards: Any, output: Sequence[str]) -> str:
    """Return the folder of a figure or dataset, under which the report lists it."""
    return Path(output[0]).parent.name


def label_figure(wildcards: Any, output: Sequence[str]) -> dict[str, str]:
    """Return the name of a figure with the beginning of its caption, which its dataset holds.

    The page's list is as wide as its longest label, and hides pictures beside it.
    """
    (shown,) = (path for path in output if path.endswith(".nc"))
    headline = shorten(
        _attributes_of(shown)["caption"].partition(". ")[0], MOST_LETTERS, placeholder=" …"
    )
    return {"figure": f"{Path(shown).stem}: {headline}"}


def label_dataset(wildcards: Any, output: Sequence[str], place: int = 0) -> dict[str, str]:
    """Return the name and title of the dataset that is output number `place` of a job."""
    path = output[place]
    return {"dataset": f"{Path(path).stem}: {_attributes_of(path)['title']}"}


def _attributes_of(path: str) -> dict[str, str]:
    from latticode.datasets.netcdf import read  # here: only a report needs xarray

    return read(path).attrs
