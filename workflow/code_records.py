"""Which code a job depends on: its script, the modules it imports, and the pinned packages.

Snakemake does not see a change in a module that a script imports. So each rule takes as input a
record of all of them with their hashes, in results/code/. A record is written only when its
content changes: editing a module reruns what imports it, while touching files, or cloning the
project anew beside finished results, reruns nothing.
"""

import os
from pathlib import Path

from pendula.sources import SCRIPTS, digest_of, modules_of

ROOT = SCRIPTS.parent
RECORDS = Path("results/code")


def code(script: str) -> str:
    """Return the path of the record for scripts/`script`, brought up to date."""
    record = RECORDS / (script.removesuffix(".py").replace("/", ".") + ".txt")
    files = [ROOT / "environment.txt", SCRIPTS / "job.py", *modules_of(SCRIPTS / script)]
    lines = [f"{digest_of(file)}  {file.relative_to(ROOT).as_posix()}\n" for file in files]
    text = "".join(dict.fromkeys(lines))
    if not record.exists() or record.read_text(encoding="utf-8") != text:
        RECORDS.mkdir(parents=True, exist_ok=True)
        partial = record.with_name(f".{os.getpid()}.{record.name}")
        partial.write_text(text, encoding="utf-8")
        partial.replace(record)
    return record.as_posix()
