"""Which rooms of a package import from which."""

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from latticode.kernels import sources


class Rooms:
    """The modules of a package; a room is a folder of it, or a module beside them."""

    def __init__(self, package: Path, storeys: tuple[tuple[str, ...], ...]):
        """Take the rooms from the top down: an import must point down, or stay in its room."""
        self.package, self.storeys = package, storeys
        self.modules = sorted(path.relative_to(package) for path in package.rglob("*.py"))

    def storey_of(self, module: Path) -> int:
        room = module.parts[0].removesuffix(".py")
        return next(i for i, rooms in enumerate(self.storeys) if room in rooms)

    def imports(self) -> Iterator[tuple[Path, Path]]:
        """Yield each module with one that it imports."""
        for module in self.modules:
            for imported in imports_of(self.package, module):
                yield module, imported

    def between(self) -> list[tuple[Path, Path]]:
        """Return the imports from one room to another, without those of and from the package."""
        return [
            pair
            for pair in self.imports()
            if Path("__init__.py") not in pair and pair[0].parts[0] != pair[1].parts[0]
        ]

    def upwards(self) -> list[tuple[str, str]]:
        """Return the imports from a room that is above."""
        return [
            (str(module), str(imported))
            for module, imported in self.between()
            if self.storey_of(imported) < self.storey_of(module)
        ]

    def lines(self, modules) -> int:
        return sum(len((self.package / module).read_text().splitlines()) for module in modules)


@cache
def imports_of(package: Path, module: Path) -> list[Path]:
    """Return the modules of a package that one of them imports, and the packages around them."""
    files = sources._imports_of(package / module)
    return [file.relative_to(package) for file in files if file.is_relative_to(package)]


# --- Circles of imports ---------------------------------------------------------------------------


def modules_imported(package: Path, file: Path) -> set[str]:
    """Return the modules of a package that a file imports, by their dotted names inside it.

    Imports inside functions count. What a package's own `__init__` gives counts as this package.
    """
    inside = file.relative_to(package).parent.parts
    names = set()
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            home = (package.name, *inside)[: len(inside) + 2 - node.level] if node.level else ()
            base = ".".join([*home, *([node.module] if node.module else [])])
            names |= {base, *(f"{base}.{alias.name}" for alias in node.names)}
    prefix = f"{package.name}."
    inside_names = (name.removeprefix(prefix) for name in names if name.startswith(prefix))
    return {name for name in inside_names if _is_module(package, name)}


def _is_module(package: Path, name: str) -> bool:
    place = package.joinpath(*name.split("."))
    return place.with_suffix(".py").exists() or (place / "__init__.py").exists()


def graph_of(package: Path) -> dict[str, set[str]]:
    """Return the modules of a package, each with those that it imports, by dotted names.

    A package of a package stands for its `__init__`; that of the whole package is left out.
    """
    graph = {}
    for file in sorted(package.rglob("*.py")):
        words = file.relative_to(package).with_suffix("").parts
        name = ".".join(words[:-1] if words[-1] == "__init__" else words)
        if name:
            graph[name] = modules_imported(package, file) - {name}
    return graph


def circles_in(package: Path) -> list[list[str]]:
    """Return the groups of modules of a package that import each other in a circle."""
    graph = graph_of(package)

    def reached(start: str) -> set[str]:
        seen, waiting = set(), [start]
        while waiting:
            for name in graph.get(waiting.pop(), ()):
                if name not in seen:
                    seen.add(name)
                    waiting.append(name)
        return seen

    reach = {name: reached(name) for name in graph}
    on_circle = sorted(name for name in graph if name in reach[name])
    groups = {tuple(b for b in on_circle if b in reach[a] and a in reach[b]) for a in on_circle}
    return sorted(map(list, groups))
