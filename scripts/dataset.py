"""A Snakemake job that computes datasets: its function is given what it takes, and returns them."""

from inspect import isgenerator, signature
from pathlib import Path
from typing import Any

from job import arguments, called, run, step
from pendula.datasets.netcdf import read, save, write
from pendula.problem import Problem, by_name


def make(snakemake) -> None:
    """Write what the function that `params.call` names returns, or all that it yields.

    This is an xarray.Dataset, or its variables and attributes, as `netcdf.write` takes them. A
    function that takes `step` is told by it how to say how far it is.
    """
    (function,) = called(snakemake)
    given = {name: taken(name, value) for name, value in arguments(snakemake).items()}
    if "step" in signature(function).parameters:
        given.setdefault("step", step)
    made = function(**given)
    for path, contents in zip(snakemake.output, made if isgenerator(made) else [made], strict=True):
        if isinstance(contents, tuple):
            write(path, *contents)
        else:
            save(path, contents)


def taken(name: str, value: Any) -> Any:
    """Return what the function is given for an input or a parameter.

    The path of a dataset becomes the dataset, and many paths a mapping of datasets by name. Plain
    values that describe a problem become a Problem.
    """
    if isinstance(value, str) and value.endswith(".nc"):
        return read(value)
    if isinstance(value, list) and value and all(str(one).endswith(".nc") for one in value):
        return {Path(path).stem: read(path) for path in value}
    if name.endswith("problem"):
        return Problem.of(value)
    if name.endswith("problems"):
        return by_name(value) if isinstance(value, dict) else [Problem.of(one) for one in value]
    return value


if __name__ == "__main__":
    run(make, snakemake)  # noqa: F821
