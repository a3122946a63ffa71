"""Hashes of the code and the files that jobs depend on, as parameters of their rules.

Snakemake does not notice changes in modules that a script imports. Each rule therefore has a
parameter with a hash of all code that its function imports.
"""

from collections.abc import Iterable
from pathlib import Path

from latticode.kernels.sources import digest_of, digest_of_code, files_of_module, modules_of

from pendula.contract.arguments import COMMITTED
from pendula.sources import SCRIPTS

PROJECT = SCRIPTS.parent
_called: set[tuple[Path, ...]] = set()


def script_digest(name: str) -> str:
    """Return a hash of a script in scripts/ with all that it imports."""
    return digest_of_code(SCRIPTS / name)


def function(name: str, *, modules: Iterable[str] = (), also: Iterable[str] = ()) -> list[str]:
    """Return the dotted name of a function, and a hash of all code that it depends on.

    `modules` are further modules that it imports by name. A change of a value in `also`, such as
    the version of a package, also reruns the job.
    """
    names = [name.rpartition(".")[0], *modules]
    files = tuple(file for module in names for file in files_of_module(module))
    _called.add(files)
    return [name, digest_of_code(*files), *also]


def code_of_jobs() -> list[str]:
    """Return the paths, in the project, of all modules that the functions of rules depend on."""
    modules = {module for files in _called for module in modules_of(*files)}
    return sorted(module.relative_to(PROJECT).as_posix() for module in modules)


def committed(path: str) -> dict[str, str]:
    """Return the parameter that stands for a file of the project: its relative path and digest.

    As an input, its path would differ between copies of the project, and the job would rerun.
    """
    return {COMMITTED: path, "sha256": digest_of(PROJECT / path)}
