"""Which code a job depends on: its script, the modules it imports, and the pinned packages.

Snakemake does not see a change in a module that a script imports. So each rule takes as input a
record of all of them with their hashes, in results/code/. A record is written only when its
content changes: editing a module reruns what imports it, while touching files, or cloning the
project anew beside finished results, reruns nothing.
"""

import ast
import hashlib
import os
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SCRIPTS = ROOT / "scripts"
RECORDS = Path("results/code")


def code(script: str) -> str:
    """Return the path of the record for scripts/`script`, brought up to date."""
    record = RECORDS / (script.removesuffix(".py").replace("/", ".") + ".txt")
    files = sorted({ROOT / "environment.txt", SCRIPTS / "job.py", *_modules_of(SCRIPTS / script)})
    text = "".join(f"{_digest(file)}  {file.relative_to(ROOT).as_posix()}\n" for file in files)
    if not record.exists() or record.read_text(encoding="utf-8") != text:
        RECORDS.mkdir(parents=True, exist_ok=True)
        partial = record.with_name(f".{os.getpid()}.{record.name}")
        partial.write_text(text, encoding="utf-8")
        partial.replace(record)
    return record.as_posix()


@cache
def _digest(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()


def _modules_of(script: Path) -> set[Path]:
    """Return the script and every module below scripts/ that it imports, at any depth."""
    found, waiting = set(), [script]
    while waiting:
        file = waiting.pop()
        if file not in found:
            found.add(file)
            waiting.extend(_imports_of(file))
    return found


@cache
def _imports_of(file: Path) -> frozenset[Path]:
    names = set()
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            package = file.relative_to(SCRIPTS).parts[: -node.level] if node.level else ()
            base = ".".join([*package, *([node.module] if node.module else [])])
            names.update([base, *(f"{base}.{alias.name}" for alias in node.names)])
    return frozenset(path for name in names for path in _files_of(name))


def _files_of(name: str) -> list[Path]:
    """Return the files that importing `name` executes: the module and its packages."""
    parts = name.split(".")
    paths = []
    for depth in range(1, len(parts) + 1):
        folder = SCRIPTS.joinpath(*parts[:depth])
        paths += [folder / "__init__.py", folder.with_suffix(".py")]
    return [path for path in paths if path.is_file()]
