"""Which code and which committed data a job depends on, by content.

Snakemake does not see a change in a module that a script imports. So each rule takes as input a
record of its script, of all modules that it imports, of what else lies in their packages (such as
templates) and of the pinned packages, with their hashes, in results/code/. A record is written only
when its content changes: editing a module reruns what imports it, while touching files, or cloning
the project anew beside finished results, reruns nothing. Committed data are copied in the same way:
their paths do not change with the clone.
"""

import os
from pathlib import Path

from pendula.sources import SCRIPTS, attached_to, digest_of, modules_of

ROOT = SCRIPTS.parent
RECORDS, COPIES = Path("results/code"), Path("results/truth")


def code(script: str) -> str:
    """Return the path of the record for scripts/`script`, brought up to date."""
    record = RECORDS / (script.removesuffix(".py").replace("/", ".") + ".txt")
    modules = modules_of(SCRIPTS / script)
    common = [ROOT / "environment.txt", SCRIPTS / "job.py"]
    files = [*common, *modules, *attached_to(modules)]
    lines = [f"{digest_of(file)}  {file.relative_to(ROOT).as_posix()}\n" for file in files]
    return _keep(record, "".join(dict.fromkeys(lines)).encode())


def committed(file: str) -> str:
    """Return the path of a copy of a committed file, brought up to date."""
    source = ROOT / file
    return _keep(COPIES / source.name, source.read_bytes())


def kept(file: str) -> str:
    """Return the path of a copy of a result, brought up to date: a job is not made to renew it."""
    return _keep(COPIES.with_name("kept") / Path(file).name, Path(file).read_bytes())


def _keep(path: Path, content: bytes) -> str:
    """Write the file if its content is another."""
    if not path.exists() or path.read_bytes() != content:
        path.parent.mkdir(parents=True, exist_ok=True)
        partial = path.with_name(f".{os.getpid()}.{path.name}")
        partial.write_bytes(content)
        partial.replace(path)
    return path.as_posix()
