"""The names that stand as words in a function and in all that it calls, or in a text."""

import ast
import re
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

from helpers import ROOT

HOMES = ROOT / "scripts", ROOT / "packages/latticode"
GAP = "{}"
LEAST = 3
"""So many letters of a name that is put together must be written, or it could be any name."""


class Words:
    """Names, and patterns of names that are put together, such as f"{name}_low"."""

    def __init__(self, names: Iterable[str] = (), patterns: Iterable[str] = ()):
        self.names, self.patterns = frozenset(names), frozenset(patterns)

    def __contains__(self, name: str) -> bool:
        return name in self.names or any(re.fullmatch(one, name) for one in self.patterns)

    @classmethod
    def union(cls, parts: Iterable["Words"]) -> "Words":
        """Return the words of several readers."""
        parts = list(parts)
        return cls(
            {name for one in parts for name in one.names},
            {pattern for one in parts for pattern in one.patterns},
        )


@cache
def words_of_text(text: str) -> Words:
    """Return what stands between quotes in a text, in which {...} is put in."""
    quoted = set(re.findall(r'"([\w./{}]+)"', text))
    gaps = [re.sub(r"\{.*?\}", GAP, one) for one in quoted if "{" in one]
    patterns = {pattern for one in gaps for pattern in _pattern(one)}
    names = {word for one in quoted for word in (one, *one.split("."))}
    return Words(names | set(re.findall(r"(\w+)=", text)), patterns)


@cache
def words_of_function(module: str, *names: str) -> Words:
    """Return the words of functions of a module and of all that they name, in any module."""
    seen: set[tuple[Path, str]] = set()
    waiting = [(_file_of(module), name) for name in names]
    nodes = []
    while waiting:
        if (place := waiting.pop()) in seen:
            continue
        seen.add(place)
        for node in _defined(place[0]).get(place[1], ()):
            nodes.append(node)
            waiting += _named(node, place[0])
    return Words.union(map(_words_in, nodes))


@cache
def _file_of(module: str) -> Path:
    home = HOMES[module.partition(".")[0] == "latticode"]
    path = home / module.replace(".", "/")
    return path / "__init__.py" if path.is_dir() else path.with_suffix(".py")


@cache
def _defined(file: Path) -> dict[str, list[ast.AST]]:
    """Return what the names of a module stand for at its top level; imports stay as they are."""
    found: dict[str, list[ast.AST]] = {}
    for node in ast.parse(file.read_text()).body if file.exists() else ():
        for name in _names_made(node):
            found.setdefault(name, []).append(node)
    return found


def _names_made(node: ast.AST) -> Iterator[str]:
    if isinstance(node, ast.FunctionDef | ast.ClassDef):
        yield node.name
    elif isinstance(node, ast.ImportFrom | ast.Import):
        yield from (one.asname or one.name for one in node.names)
    else:
        names = (one for one in ast.walk(node) if isinstance(one, ast.Name))
        yield from (one.id for one in names if isinstance(one.ctx, ast.Store))


def _named(node: ast.AST, file: Path) -> list[tuple[Path, str]]:
    """Return where all that a part of a module names is defined."""
    if isinstance(node, ast.ImportFrom):
        named = (node.module or "").partition(".")[0]
        folder = file.parents[node.level - 1] if node.level else HOMES[named == "latticode"]
        module = folder.joinpath(*(node.module or "").split("."))
        target = module / "__init__.py" if module.is_dir() else module.with_suffix(".py")
        return [(target, one.name) for one in node.names]
    if isinstance(node, ast.Import):
        return []
    found = [(file, one.id) for one in ast.walk(node) if isinstance(one, ast.Name)]
    for one in ast.walk(node):  # a name in a module that was imported
        if isinstance(one, ast.Attribute) and isinstance(one.value, ast.Name):
            for imported in _defined(file).get(one.value.id, ()):
                if isinstance(imported, ast.ImportFrom):
                    (package, _), *_ = _named(imported, file)
                    found.append((package.parent / f"{one.value.id}.py", one.attr))
    return found


@cache
def _words_in(node: ast.AST) -> Words:
    names, patterns, skipped = set(), set(), set()
    for one in ast.walk(node):
        if isinstance(one, ast.Expr) and isinstance(one.value, ast.Constant):
            skipped.add(one.value)  # a docstring
        elif isinstance(one, ast.JoinedStr):
            text = "".join(
                part.value if isinstance(part, ast.Constant) else GAP for part in one.values
            )
            patterns.update(_pattern(text))
        elif isinstance(one, ast.Constant) and isinstance(one.value, str) and one not in skipped:
            names.update(one.value.split() if re.fullmatch(r"[\w ]+", one.value) else ())
        elif isinstance(one, ast.Attribute):
            names.add(one.attr)
        elif isinstance(one, ast.keyword) and one.arg:
            names.add(one.arg)
    return Words(names, patterns)


def _pattern(text: str) -> list[str]:
    """Return the pattern of a name with gaps, if it is a name and enough of it is written."""
    written = text.replace(GAP, "")
    enough = re.fullmatch(r"[\w./]*", written) and len(written) >= LEAST
    return [re.escape(text).replace(re.escape(GAP), r"[\w.]+")] if enough else []
