"""A Snakemake job that computes datasets: its function is given what it takes, and returns them."""

from collections.abc import Mapping, Sequence
from functools import partial
from inspect import isgenerator, signature
from pathlib import Path
from typing import Any

import numpy as np
import pendula.names  # noqa: F401, so that datasets have the paper's words
from job import arguments, called, datasets_in, name_of, run, step
from latticode.datasets.netcdf import Variable, read, save, write
from latticode.datasets.stated import COMPUTED_BY, COMPUTED_FROM, stated
from latticode.datasets.trajectories import Contents
from latticode.simulation.runs import Make, joined, run_part
from pendula.problem import Problem, by_name

STEPS = 20
"""How often the log of a job that makes many runs says how many are done."""


def make(snakemake) -> None:
    """Write what the function that `params.call` names returns, or all that it yields.

    This is an xarray.Dataset, or its variables and attributes, as `netcdf.write` takes them. Each
    dataset states what the function was given, where the function does not state it already. A
    function that takes `step` is told by it how to say how far it is.

    A function that takes `run` makes many runs by it. They are all made here, or read from the
    input `chunks`. A job with the parameter `chunk`, such as [2, 8], makes and writes this part.
    """
    (function,) = called(snakemake)
    files = {name: datasets_in(value) for name, value in arguments(snakemake).items()}
    given = {name: taken(name, value) for name, value in arguments(snakemake).items()}
    plain = {name: value for name, value in given.items() if not files[name]}
    names = [name_of(path) for paths in files.values() for path in paths]
    if "step" in signature(function).parameters:
        given.setdefault("step", step)
    if "run" in signature(function).parameters:
        given.setdefault("run", partial(run_or_read, snakemake))
    try:
        made = function(**given)
    except PartIsMade as part:
        return write(snakemake.output[0], *part_contents(*part.args))
    for path, contents in zip(snakemake.output, made if isgenerator(made) else [made], strict=True):
        told = of_output(path, plain)
        if isinstance(contents, tuple):
            variables, attributes = contents
            said = stated(told, variables, names, function)
            write(path, variables, said | own(attributes))
        else:
            said = stated(told, map(str, contents.variables), names, function)
            save(path, contents.assign_attrs({**contents.attrs, **(said | own(contents.attrs))}))


class PartIsMade(BaseException):
    """A function has made the part of its runs that its job is about, and need not go on."""


def run_or_read(snakemake, problems: Sequence[Problem], make: Make) -> dict[str, np.ndarray]:
    """Return what is kept of many runs, and end the function if only a part of them is made."""

    def tell(done: int, count: int) -> None:
        if done % max(1, count // STEPS) == 0:
            step(f"{done} of {count} runs done")

    if files := snakemake.input.get("chunks"):
        return joined(map(arrays_of, files))
    if part := snakemake.params.get("chunk"):
        raise PartIsMade(run_part(problems, make, *part, tell))
    return run_part(problems, make, progress=tell)


def part_contents(found: Mapping[str, np.ndarray]) -> Contents:
    """Return the contents of the dataset of a part."""
    variables = {
        name: Variable(
            ("run", *(f"{name}_{axis}" for axis in range(1, values.ndim))), values, "of each run"
        )
        for name, values in found.items()
    }
    return variables, {"title": "A part of many runs"}


def arrays_of(path: str) -> dict[str, np.ndarray]:
    """Return what the dataset of a part holds."""
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
