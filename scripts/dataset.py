"""A Snakemake job that computes datasets: its function is given what it takes, and returns them."""

from collections.abc import Mapping, Sequence
from inspect import isgenerator, signature
from pathlib import Path
from typing import Any

import numpy as np
import pendula.names  # noqa: F401, so that datasets have the paper's words
from job import arguments, called, datasets_in, name_of, run, step
from latticode.datasets.netcdf import Variable, read, save, write
from latticode.datasets.stated import COMPUTED_BY, COMPUTED_FROM, stated
from latticode.datasets.trajectories import Contents
from latticode.simulation.runs import ManyRuns, joined, run_part
from pendula.problem import Problem, by_name

STEPS = 20
"""How often the log of a job that makes many runs says how many are done."""


def make(snakemake) -> None:
    """Write what the function that `params.call` names returns, or all that it yields.

    This is an xarray.Dataset, or its variables and attributes, as `netcdf.write` takes them. Each
    dataset states what the function was given, where the function does not state it already. A
    function that takes `step` is told by it how to say how far it is.

    The runs of `ManyRuns` are all made here, or read from the input `chunks`. A job with the
    parameter `chunk`, such as [2, 8], makes and writes every eighth run from number 2 on.
    """
    (function,) = called(snakemake)
    files = {name: datasets_in(value) for name, value in arguments(snakemake).items()}
    given = {name: taken(name, value) for name, value in arguments(snakemake).items()}
    plain = {name: value for name, value in given.items() if not files[name]}
    names = [name_of(path) for paths in files.values() for path in paths]
    if "step" in signature(function).parameters:
        given.setdefault("step", step)
    made = function(**given)
    if isinstance(made, ManyRuns):
        if chunk := snakemake.params.get("chunk"):
            retained = run_part(made.problems, made.retain, *chunk, report_progress)
            return write(snakemake.output[0], *chunk_contents(retained))
        made = made.conclude(retained_of(made, snakemake.input.get("chunks")))
    for path, contents in zip(snakemake.output, made if isgenerator(made) else [made], strict=True):
        told = of_output(path, plain)
        if isinstance(contents, tuple):
            variables, attributes = contents
            said = stated(told, variables, names, function)
            write(path, variables, said | own(attributes))
        else:
            said = stated(told, map(str, contents.variables), names, function)
            save(path, contents.assign_attrs({**contents.attrs, **(said | own(contents.attrs))}))


def report_progress(done: int, count: int) -> None:
    """Log how many runs are done, STEPS times in all."""
    if done % max(1, count // STEPS) == 0:
        step(f"{done} of {count} runs done")


def retained_of(runs: ManyRuns, files: Sequence[str] | None) -> dict[str, np.ndarray]:
    """Return what is retained of all runs: read from files of chunks, or made if there are none."""
    if files:
        return joined(map(arrays_of, files))
    return run_part(runs.problems, runs.retain, progress=report_progress)


def chunk_contents(found: Mapping[str, np.ndarray]) -> Contents:
    """Return the contents of the dataset of a chunk of the runs."""
    variables = {
        name: Variable(
            ("run", *(f"{name}_{axis}" for axis in range(1, values.ndim))), values, "of each run"
        )
        for name, values in found.items()
    }
    return variables, {"title": "A part of many runs"}


def arrays_of(path: str) -> dict[str, np.ndarray]:
    """Return what the dataset of a chunk holds."""
    return {str(name): one.values for name, one in read(path).data_vars.items()}


def own(attributes: Mapping[str, Any]) -> dict[str, Any]:
    """Return attributes without what a copy of those of another dataset would say of its making."""
    return {key: one for key, one in attributes.items() if key not in (COMPUTED_BY, COMPUTED_FROM)}


def of_output(path: str, given: Mapping[str, Any]) -> dict[str, Any]:
    """Return the arguments, of a table by the names of the outputs only the entry of this one."""
    found = {}
    for name, value in given.items():
        names = value if isinstance(value, Mapping) else ()
        own = [key for key in names if path.endswith(f"/{key}.nc")]
        entry = value[max(own, key=len)] if own else value
        found |= entry if own and isinstance(entry, Mapping) else {name: entry}
    return found


def taken(name: str, value: Any) -> Any:
    """Return what the function is given for an input or a parameter.

    The path of a dataset becomes the dataset, and many paths a mapping of datasets by name. Plain
    values that describe a problem become a Problem.
    """
    if isinstance(value, str) and datasets_in(value):
        return read(value)
    if datasets_in(value):
        return {Path(path).stem: read(path) for path in datasets_in(value)}
    if name.endswith("problem"):
        return Problem.of(value)
    if name.endswith("problems"):
        return by_name(value) if isinstance(value, dict) else [Problem.of(one) for one in value]
    return value


if __name__ == "__main__":
    run(make, snakemake)  # noqa: F821
