"""A Snakemake job that calls a function and writes the dataset or datasets that it returns."""

from pendula.contract.log import run  # first: its hook logs an import that fails

# isort: split

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import pendula.names  # noqa: F401, so that datasets have the paper's words
from latticode.datasets.netcdf import Variable, read, save, write
from latticode.datasets.stated import COMPUTED_BY, COMPUTED_FROM, stated
from latticode.datasets.trajectories import Contents
from latticode.simulation.runs import ManyRuns, join_chunks, run_chunk
from pendula.contract.arguments import Arguments, function_of, load_arguments
from pendula.contract.kinds import KINDS
from replication.logs import Progress
from xarray import Dataset


def compute(snakemake: Any) -> None:
    """Write the dataset that the function in `params.call` returns, or each that it yields.

    A dataset is an xarray.Dataset, or the variables and attributes of `netcdf.write`. It records
    the arguments of the function as attributes, unless the function does so itself.

    A function may return `ManyRuns`. The job then makes all runs, or reads them from
    `input.chunks`. A job with the wildcard `chunk`, such as ".parts/2-of-8", makes and writes every
    eighth run.
    """
    function = function_of(snakemake.params.call)
    arguments = load_arguments(function, snakemake, KINDS)
    result = function(**arguments.values)
    if isinstance(result, ManyRuns):
        if chunk := snakemake.wildcards.get("chunk"):
            return write_chunk(snakemake.output[0], result, chunk)
        chunks = snakemake.input.get("chunks")
        result = result.conclude(retained_of(result, chunks, snakemake.output[0]))
    results = [result] if len(snakemake.output) == 1 else result
    for path, contents in zip(snakemake.output, results, strict=True):
        save_with_provenance(path, contents, function, arguments)


def save_with_provenance(
    path: str, contents: Dataset | Contents, function: Callable, arguments: Arguments
) -> None:
    """Write a dataset with its provenance: the function that computed it, and its inputs."""
    names = [name for names in arguments.sources.values() for name in names]
    if isinstance(contents, tuple):
        variables, attributes = contents
        provenance = stated(arguments.settings, variables, names, function)
        write(path, variables, provenance | without_provenance(attributes))
    else:
        variables = map(str, contents.variables)
        provenance = stated(arguments.settings, variables, names, function)
        attributes = {**contents.attrs, **provenance, **without_provenance(contents.attrs)}
        save(path, contents.assign_attrs(attributes))


def without_provenance(attributes: Mapping[str, Any]) -> dict[str, Any]:
    """Return attributes without provenance, which may be copied from another dataset."""
    provenance = (COMPUTED_BY, COMPUTED_FROM)
    return {key: value for key, value in attributes.items() if key not in provenance}


def retained_of(runs: ManyRuns, files: Sequence[str] | None, path: str) -> dict[str, np.ndarray]:
    """Return the results of all runs: read from the files of chunks, or computed if None.

    The log reports how many of the runs of `path` are done.
    """
    if files:
        return join_chunks(map(arrays_in, files))
    return run_chunk(runs.problems, runs.retain, progress=Progress(f"runs of {path}"))


def write_chunk(path: str, runs: ManyRuns, chunk: str) -> None:
    """Make the runs of one chunk, such as ".parts/2-of-8", and write their results."""
    number, count = map(int, re.findall(r"\d+", chunk))
    retained = run_chunk(runs.problems, runs.retain, number - 1, count, Progress(f"runs of {path}"))
    variables = {
        name: Variable(
            ("run", *(f"{name}_{axis}" for axis in range(1, values.ndim))), values, "of each run"
        )
        for name, values in retained.items()
    }
    write(path, variables, {"title": "A part of many runs"})


def arrays_in(path: str) -> dict[str, np.ndarray]:
    """Return the arrays of a chunk's dataset by name."""
    return {str(name): array.values for name, array in read(path).data_vars.items()}


if __name__ == "__main__":
    run(compute, snakemake)  # noqa: F821
