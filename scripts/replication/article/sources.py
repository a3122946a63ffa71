"""The source of a printed number, and the code that computed it."""

import ast
import hashlib
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from latticode.kernels.sources import ROOTS

PROJECT = Path(__file__).resolve().parents[3]
"""The folder of the project."""
BLOB_DIGITS = 12
"""Number of digits of git's id of a file's content."""


class Source(NamedTuple):
    """The source of a printed text: numbers of a dataset, a claim, or a figure."""

    dataset: str = ""
    variable: str = ""
    labels: tuple[tuple[str, Any], ...] = ()
    claim: str = ""
    figure: str = ""
    attribute: str = ""  # an attribute or coordinate with which the dataset was computed

    @property
    def card(self) -> str:
        """The id of the card: the anchor in the report, followed by `.variable` for a variable."""
        if self.figure:
            return f"figures/{self.figure}"
        if self.claim:
            return f"claim_{self.claim}"
        file = self.dataset if self.dataset.endswith(".json") else f"{self.dataset}.nc"
        return f"data_{file}.{self.variable}" if self.variable else f"data_{file}"


class Printed(NamedTuple):
    """A text of the article and its source."""

    text: str
    source: Source

    def __str__(self) -> str:
        return self.text


def printed(
    text: str, dataset: str, variable: str = "", labels: Mapping[str, Any] | None = None
) -> Printed:
    """Return a text whose source is a variable of a dataset at these labels."""
    return Printed(text, Source(dataset, variable, tuple((labels or {}).items())))


class Code(NamedTuple):
    """A function: dotted name, file (a path in the project), git's id of this file, and text."""

    name: str
    file: str = ""
    blob: str = ""
    text: str = ""

    @property
    def short_name(self) -> str:
        """The name without the module."""
        return self.name.rpartition(".")[2]


@cache
def code_of(function: str) -> Code:
    """Return the code of a function, or only its name if the function no longer exists."""
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
