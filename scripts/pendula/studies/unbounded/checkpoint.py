"""Checkpoints: what a run has done so far, whole or not there, and only for that very run."""

import json
from pathlib import Path

import numpy as np

from pendula.datasets.files import complete_or_absent
from pendula.problem import Problem
from pendula.sources import digest_of_modules

CODE = Path(__file__).with_name("spread.py")


def describe(problem: Problem, rest: float) -> str:
    """Return all that the numbers of a run depend on: its problem and the code."""
    plain = {key: str(value) for key, value in sorted(problem.plain().items())}
    return json.dumps({"problem": plain, "rest": rest, "code": digest_of_modules(CODE)})


def keep(path: str | Path, description: str, arrays: dict[str, np.ndarray]) -> None:
    """Write the arrays and the description of the run that they belong to."""
    with complete_or_absent(path) as partial, open(partial, "wb") as file:
        np.savez(file, description=description, **arrays)


def recall(path: str | Path, description: str) -> dict[str, np.ndarray] | None:
    """Return the arrays kept at `path`; None if there are none, or those of another run."""
    if not Path(path).exists():
        return None
    with np.load(path) as kept:
        if str(kept["description"]) != description:
            return None
        return {name: kept[name] for name in kept.files if name != "description"}
