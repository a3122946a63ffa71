"""Provenance of a result: the modules that a file imports, the versions and the processor.

This module uses the standard library only.
"""

import ast
import hashlib
import os
import platform
import re
from collections.abc import Iterator
from functools import cache
from importlib.metadata import version
from operator import attrgetter
from pathlib import Path

ROOTS: dict[str, Path] = {"latticode": Path(__file__).resolve().parents[2]}
"""Parent folders of the packages whose imports are followed. A program that uses the library adds
its own packages."""

_LIST = r"(?:\([\w\s,]*\)|[\w.]+(?:[ ]as[ ]\w+)?(?:,[ ][\w.]+(?:[ ]as[ ]\w+)?)*)"
_IMPORT = re.compile(rf"\n[ ]*((?:from[ ][\w.]+[ ])?import[ ]{_LIST})[ ]*(?:[#][^\n]*)?$", re.M)
_WORD = re.compile(r"import\b")
_PATH_KEY = attrgetter("parts")  # sorts like the paths themselves, five times as fast


def modules_of(*files: Path) -> list[Path]:
    """Return the files and all modules of ROOTS that they import, directly or indirectly."""
    modules, waiting = set(), list(files)
    while waiting:
        module = waiting.pop()
        if module not in modules:
            modules.add(module)
            waiting.extend(_imports_of(module))
    return sorted(modules, key=_PATH_KEY)


def attached_to(modules: list[Path]) -> list[Path]:
    """Return the data files, such as templates, in the folders of `modules`.

    A file named after a module in its folder (section.html.j2, section.py) is returned only if that
    module is among `modules`: a computation must not depend on the layout of a page. Any other file
    is returned with its package, and files of a subpackage only if `modules` contains it.
    """
    packages = [module.parent for module in modules if module.name == "__init__.py"]
    owners = {None, *modules}
    data_files = (pair for package in packages for pair in _data_files(package))
    return sorted((path for path, owner in data_files if owner in owners), key=_PATH_KEY)


@cache
def _data_files(folder: Path) -> list[tuple[Path, Path | None]]:
    """Return the data files of a package, each with the module it is named after, or None."""
    pairs = []
    for path in folder.iterdir():
        if path.is_dir():
            if path.name != "__pycache__" and not (path / "__init__.py").exists():
                pairs += _data_files(path)
        elif path.suffix != ".py" and not path.name.startswith("."):
            module = path.with_name(path.name.split(".")[0] + ".py")
            pairs.append((path, module if module.exists() else None))
    return pairs


@cache
def digest_of(file: Path) -> str:
    """Return the SHA-256 of a file's content."""
    return hashlib.sha256(file.read_bytes()).hexdigest()


@cache
def digest_of_modules(file: Path) -> str:
    """Return one hash of a module and all modules that it imports."""
    text = "".join(f"{digest_of(module)} {module.name}\n" for module in modules_of(file))
    return hashlib.sha256(text.encode()).hexdigest()


PACKAGES = (
    *("numpy", "numba", "llvmlite", "scipy", "python-flint", "xarray", "netCDF4"),
    *("matplotlib", "pillow", "fonttools"),
)
"""Packages whose versions affect numbers or pictures."""

_LONG = '"' * 3 + r'(?:[^"\\]|\\.|"(?!""))*' + '"' * 3
_SHORT = r'"(?:[^"\\\n]|\\.)*"|' + r"'(?:[^'\\\n]|\\.)*'"
_DOCSTRING, _COMMENT = rf"^[ ]*(?P<docstring>{_LONG})[ ]*\n", r"(?P<comment>[ ]*[#][^\n]*)"
_NO_CODE = re.compile("|".join([_DOCSTRING, _LONG, _SHORT, _COMMENT]), re.MULTILINE)
_EMPTY = re.compile(r"\n\s*\n")


@cache
def digest_of_code(*files: Path) -> str:
    """Return one hash of all code that these files execute, without comments and docstrings.

    It covers the files, all modules that they import, their data files, and the versions of
    PACKAGES.
    """
    modules = modules_of(*files)
    module_digests = [f"{_digest_of_bare(path)} {path.name}" for path in modules]
    file_digests = [f"{digest_of(path)} {path.name}" for path in attached_to(modules)]
    return hashlib.sha256(
        "\n".join([*_versions(), *module_digests, *file_digests]).encode()
    ).hexdigest()


@cache
def _versions() -> list[str]:
    return [f"{name} {version(name)}" for name in PACKAGES]


@cache
def _digest_of_bare(module: Path) -> str:
    return hashlib.sha256(strip_comments(module.read_text(encoding="utf-8")).encode()).hexdigest()


def strip_comments(text: str) -> str:
    """Return a module's text without comments, docstrings and empty lines.

    It searches by a regular expression: parsing all modules would take 0.5 s at every start of a
    workflow.
    """
    without = _NO_CODE.sub(lambda match: "" if match.lastgroup else match[0], text)
    return _EMPTY.sub("\n", f"\n{without}\n")


_FOR_TYPE_CHECKERS = re.compile(r"^if TYPE_CHECKING:.*\n(?:(?: .*)?\n)+", re.MULTILINE)
"""Blocks of imports for type checkers, which are never executed."""


@cache
def _imports_of(file: Path) -> frozenset[Path]:
    names = set()
    text = _FOR_TYPE_CHECKERS.sub("", file.read_text(encoding="utf-8"))
    for node in _statements(_tree_of(text)):
        if isinstance(node, ast.Import):
            names.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            package = _packages_of(file)[: -node.level] if node.level else ()
            base = ".".join([*package, *([node.module] if node.module else [])])
            names.update([base, *(f"{base}.{alias.name}" for alias in node.names)])
    return frozenset(path for name in names for path in files_of_module(name))


def _packages_of(file: Path) -> tuple[str, ...]:
    """Return the components of the dotted name of a module below ROOTS."""
    home = max((root for root in ROOTS.values() if file.is_relative_to(root)), key=_PATH_KEY)
    return file.relative_to(home).parts


def _tree_of(text: str) -> ast.AST:
    """Return a syntax tree with all imports of a module.

    Only the import statements are parsed, which is ten times faster. If the word `import` also
    occurs elsewhere, even without comments and docstrings, the whole text is parsed.
    """
    for code in (text, strip_comments(text)):
        imports = _IMPORT.findall(f"\n{code}")
        if len(imports) == len(_WORD.findall(code)):
            return ast.parse("\n".join(imports))
    return ast.parse(text)


def _statements(tree: ast.AST) -> Iterator[ast.AST]:
    """Yield a tree and all its statements; expressions cannot contain imports."""
    waiting = [tree]
    while waiting:
        node = waiting.pop()
        yield node
        for field in ("body", "orelse", "finalbody", "handlers", "cases"):
            waiting.extend(getattr(node, field, ()))


def files_of_module(name: str) -> tuple[Path, ...]:
    """Return the files that `import name` executes: the module and its parent packages."""
    names = tuple(name.split("."))
    home = ROOTS.get(names[0])
    return _files_in(home, names) if home else ()


@cache
def _files_in(folder: Path, names: tuple[str, ...]) -> tuple[Path, ...]:
    packages = _files_in(folder, names[:-1]) if names[1:] else ()
    place = os.path.join(folder, *names)  # pathlib is slower
    candidates = (f"{place}/__init__.py", f"{place}.py")
    return (*packages, *(Path(path) for path in candidates if os.path.isfile(path)))


def describe_machine() -> dict[str, str]:
    """Return the processor's name and the versions on which the speed of a run depends."""
    linux = Path("/proc/cpuinfo")
    cpuinfo = linux.read_text(encoding="utf-8") if linux.exists() else ""
    named = re.search(r"^model name\s*:\s*(.*\S)", cpuinfo, re.MULTILINE)
    return {
        "processor": named[1] if named else platform.processor() or platform.machine(),
        "python": platform.python_version(),
        **{name: version(name) for name in ("numpy", "numba", "scipy")},
    }
