"""Which rooms of a package import from which."""

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
            pair for pair in self.imports()
            if Path("__init__.py") not in pair and pair[0].parts[0] != pair[1].parts[0]
        ]  # fmt: skip

    def upwards(self) -> list[tuple[str, str]]:
        """Return the imports from a room that is above."""
        return [
            (str(module), str(other)) for module, other in self.between()
            if self.storey_of(other) < self.storey_of(module)
        ]  # fmt: skip

    def lines(self, modules) -> int:
        return sum(len((self.package / one).read_text().splitlines()) for one in modules)


@cache
def imports_of(package: Path, module: Path) -> list[Path]:
    """Return the modules of a package that one of them imports, and the packages around them."""
    files = sources._imports_of(package / module)
    return [file.relative_to(package) for file in files if file.is_relative_to(package)]
