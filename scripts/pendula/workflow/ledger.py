"""The parts of the ledger, with their modules of claims and the datasets that decide them."""

import json
import os
from contextlib import suppress
from pathlib import Path

from latticode.kernels.cache import kept_in

from pendula.studies import STUDIES, files_with_prefix

PAPER = "paper"
ON_FIGURES = ("claims_norms", "claims_sweeps")
"""Modules of the study `paper` with the claims on Figs 2 to 6, which `snakemake paper` decides."""
CLAIMS = "claims"


def parts_of_ledger() -> dict[str, list[str]]:
    """Return the prefixes of the modules of claims in each part, such as "theory/claims".

    Each study with claims is a part, except `paper`, which has two: its claims on the figures, and
    all others. Every module of a study belongs to a part if its name begins with "claims".
    """
    modules_by_part: dict[str, list[str]] = {"figures": [], "solvers": []}
    for path in files_with_prefix(f"{PAPER}/{CLAIMS}"):
        part_of_paper = "figures" if path.stem in ON_FIGURES else "solvers"
        modules_by_part[part_of_paper].append(f"{PAPER}/{path.stem}")
    for study in STUDIES:
        if study != PAPER and files_with_prefix(f"{study}/{CLAIMS}"):
            modules_by_part[study] = [f"{study}/{CLAIMS}"]
    return modules_by_part


def modules_of(beginnings: list[str]) -> list[str]:
    """Return the dotted names of all modules of claims with these prefixes."""
    paths = (path for beginning in beginnings for path in files_with_prefix(beginning))
    return [f"pendula.studies.{path.parent.name}.{path.stem}" for path in paths]


def datasets_of_claims(modules: list[str], digest: str) -> list[str]:
    """Return the names of all datasets that the claims of these modules read.

    Importing the claims takes longer than reading all rules, so the names are cached in the folder
    of compiled kernels, under the digest of the modules' code.
    """
    folder = kept_in()
    cache_file = folder and folder / CLAIMS / f"{digest[:32]}.json"
    if cache_file:
        with suppress(OSError, ValueError):
            return json.loads(cache_file.read_text(encoding="utf-8"))
    # imported here: claims import slow libraries
    from replication.ledger.verdicts import needed

    from pendula.jobs.decide import all_claims

    names = needed(all_claims(*modules))
    if cache_file:
        with suppress(OSError):
            _write_whole(cache_file, json.dumps(names))
    return names


def _write_whole(path: Path, text: str) -> None:
    """Write a file atomically, so that no other process reads an incomplete one."""
    path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    partial = path.with_suffix(f".{os.getpid()}")
    partial.write_text(text, encoding="utf-8")
    partial.replace(path)
