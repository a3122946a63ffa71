"""Which code and which committed data a job depends on, by content.

Snakemake does not see a change in a module that a script imports. So each rule takes as input a
record of its script, of all modules that it imports, of the templates and styles beside them, and
of the pinned packages, with their hashes, in results/code/. A record is written only when its
content changes: editing a module reruns what imports it, while touching files, or cloning the
project anew beside finished results, reruns nothing. Committed data are copied in the same way,
since their paths would change with the clone.

A call that only looks, such as a dry run, writes nothing to results/. The records that are missing
or out of date go to a temporary folder then, so that Snakemake sees the same as in a run.
"""

import atexit
import shutil
import tempfile
from functools import cache
from pathlib import Path

from pendula.archive.contents import code_files
from pendula.datasets import DatasetError, complete_or_absent
from pendula.sources import SCRIPTS, attached_to, digest_of, modules_of
from pendula.studies import STUDIES
from stop import stop

ROOT = SCRIPTS.parent
RECORDS, COPIES, KEPT = (Path("results") / name for name in ("code", "truth", "kept"))
_handed_out: set[str] = set()
_parts: dict[Path, tuple[str, ...]] = {}

only_looks = False
"""Whether this call of Snakemake makes nothing; the rules set it."""


def code(script: str, *parts: str, of: str = "") -> str:
    """Return the path of the record for a script, brought up to date.

    `script` is a path below scripts/, or one of benchmarks/ below the project's folder. `parts`
    names modules, such as "section", that the script finds by the list of studies, or such as
    "paper/claims" in one of them: its imports do not show them. Raises ValueError where two rules
    want different records of one script, unless `of` tells them apart.
    """
    name = script.removesuffix(".py").replace("/", ".")
    record = RECORDS / (f"{name}.{of}.txt" if of else f"{name}.txt")
    if _parts.setdefault(record.absolute(), parts) != parts:
        raise ValueError(f"{script} is recorded with {_parts[record.absolute()]} and {parts}")
    folder = ROOT if script.startswith("benchmarks/") else SCRIPTS
    entries = [folder / script, *(path for part in parts for path in _of_studies(part))]
    modules = modules_of(*entries)
    common = [ROOT / "environment.txt", SCRIPTS / "job.py"]
    return _hand_out(record, _lines([*common, *modules, *attached_to(modules)]))


def _of_studies(part: str) -> list[Path]:
    """Return the modules in the studies whose names start with this, each with its package."""
    alone, _, start = part.rpartition("/")
    folders = [SCRIPTS / "pendula/studies" / study for study in ([alone] if alone else STUDIES)]
    found = [path for folder in folders for path in sorted(folder.glob(f"{start}*.py"))]
    return [path for module in found for path in (module.with_name("__init__.py"), module)]


def whole_project() -> str:
    """Return the path of the record for all files of the project, brought up to date.

    Raises ArchiveError, which says the way out, where it is not known which files these are.
    """
    files = [ROOT / name for name in code_files(ROOT)]
    return _keep(RECORDS / "whole_project.txt", _lines(files))


def committed(file: str, folder: str = "") -> str:
    """Return the path of a copy of a committed file, brought up to date.

    Files of one name need a `folder` of their own.
    """
    source = ROOT / file
    return _hand_out(COPIES / folder / source.name, source.read_bytes())


def is_committed(file: str) -> bool:
    """Return whether the project has a file, so that `committed` can hand out a copy."""
    return (ROOT / file).exists()


def kept(file: str) -> str:
    """Return the path of a copy of a result, brought up to date.

    A job that takes the copy in place of the result never makes the result again. Where an archive
    was unpacked, the copy is there without the result.
    """
    source, copy = Path(file), KEPT / Path(file).name
    return _hand_out(copy, (source if source.exists() else copy).read_bytes())


def was_made(file: str) -> bool:
    """Return whether a result, or a copy of it, is there to be kept."""
    return Path(file).exists() or (KEPT / Path(file).name).exists()


def records() -> list[str]:
    """Return every record that a rule has asked for so far: an archive needs them all."""
    return sorted(path for path in _handed_out if path.endswith(".txt"))


def copies() -> list[str]:
    """Return every copy that a rule has asked for so far: an archive needs them all."""
    return sorted(_handed_out.difference(records()))


def _lines(files: list[Path]) -> bytes:
    return "".join(dict.fromkeys(map(_line, files))).encode()


@cache
def _line(file: Path) -> str:
    return f"{digest_of(file)}  {file.relative_to(ROOT).as_posix()}\n"


def _hand_out(path: Path, content: bytes) -> str:
    written = _keep(path, content)
    _handed_out.add(written)
    return written


def _keep(path: Path, content: bytes) -> str:
    """Write the file if its content is another; no reader ever sees half of it."""
    if path.is_file() and path.read_bytes() == content:
        return path.as_posix()
    path = _elsewhere() / path if only_looks else path
    try:
        with complete_or_absent(path) as partial:
            partial.write_bytes(content)
    except DatasetError as error:
        stop(error)
    return path.as_posix()


@cache
def _elsewhere() -> Path:
    """Return a temporary folder, which goes when Python ends."""
    folder = Path(tempfile.mkdtemp(prefix="pendula-dry-run-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder
