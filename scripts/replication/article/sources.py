"""Where a printed number comes from, and the code that made it."""

import ast
import hashlib
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from latticode.kernels.sources import ROOTS

PROJECT = Path(__file__).resolve().parents[3]
"""The folder that holds the code of the replication."""
BLOB_DIGITS = 12
"""By so many digits git finds the content of a file."""


class Source(NamedTuple):
    """What a text rests on: numbers of a dataset, a claim, or a figure."""

    dataset: str = ""
    variable: str = ""
    labels: tuple[tuple[str, Any], ...] = ()
    claim: str = ""
    figure: str = ""
    attribute: str = ""  # or a coordinate: what the dataset was computed with

    @property
    def card(self) -> str:
        """The id of the card on it, which begins as the anchor in the report does."""
        if self.figure:
            return f"figures/{self.figure}"
        if self.claim:
            return f"claim_{self.claim}"
        file = self.dataset if self.dataset.endswith(".json") else f"{self.dataset}.nc"
        return f"data_{file}.{self.variable}" if self.variable else f"data_{file}"


class Printed(NamedTuple):
    """A text of the article and where it comes from."""

    text: str
    source: Source

    def __str__(self) -> str:
        return self.text


def printed(
    text: str, dataset: str, variable: str = "", labels: Mapping[str, Any] | None = None
) -> Printed:
    """Return a text that is printed of a variable of a dataset at these labels."""
    return Printed(text, Source(dataset, variable, tuple((labels or {}).items())))


class Code(NamedTuple):
    """A function: its dotted name, its file below the project, git's id of this file, its text."""

    name: str
    file: str = ""
    blob: str = ""
    text: str = ""

    @property
    def short_name(self) -> str:
        """The name without that of its module."""
        return self.name.rpartition(".")[2]


@cache
def code_of(function: str) -> Code:
    """Return the code of a function; its name alone if it was renamed since the results."""
    module, _, name = function.rpartition(".")
    path = ROOTS[module.partition(".")[0]] / f"{module.replace('.', '/')}.py"
    definition = _definitions(path).get(name) if path.exists() else None
    if definition is None:
        return Code(function)
    content = path.read_bytes()
    first = min(line.lineno for line in (definition, *definition.decorator_list))
    lines = content.decode("utf-8").splitlines()[first - 1 : definition.end_lineno]
    header = f"blob {len(content)}\0".encode()
    blob = hashlib.sha1(header + content).hexdigest()[:BLOB_DIGITS]
    return Code(function, path.relative_to(PROJECT).as_posix(), blob, "\n".join(lines))


@cache
def _definitions(path: Path) -> dict[str, ast.FunctionDef]:
    """Return the functions of a module by name."""
    body = ast.parse(path.read_bytes()).body
    return {node.name: node for node in body if isinstance(node, ast.FunctionDef)}
