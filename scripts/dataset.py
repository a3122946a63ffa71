"""A Snakemake job that computes datasets: it calls a function, and writes what this returns."""

from pendula.contract.log import Progress, run  # first: its hook logs an import that fails

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
from xarray import Dataset


def compute(snakemake: Any) -> None:
    """Write what the function that `params.call` names returns, or each dataset that it yields.

    This is an xarray.Dataset, or its variables and attributes, as `netcdf.write` takes them. Each
    dataset records the arguments of the function as attributes, unless the function has recorded
    them itself.

    A study may return `ManyRuns`. The job makes them all, or reads them from `input.chunks`; a job
    with the wildcard `chunk`, such as ".parts/2-of-8", makes and writes every eighth of them.
    """
    function = function_of(snakemake.params.call)
    arguments = load_arguments(function, snakemake, KINDS)
    result = function(**arguments.values)
    if isinstance(result, ManyRuns):
        if chunk := snakemake.wildcards.get("chunk"):
            return write_chunk(snakemake.output[0], result, chunk)
        result = result.conclude(retained_of(result, snakemake.input.get("chunks")))
    results = [result] if len(snakemake.output) == 1 else result
    for path, contents in zip(snakemake.output, results, strict=True):
        save_with_provenance(path, contents, function, arguments)


def save_with_provenance(
    path: str, contents: Dataset | Contents, function: Callable, arguments: Arguments
) -> None:
    """Write a dataset with attributes that say which function computed it, from what."""
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
    """Return attributes without those on computation, which may be copied from another dataset."""
    of_others = (COMPUTED_BY, COMPUTED_FROM)
    return {key: value for key, value in attributes.items() if key not in of_others}


def retained_of(runs: ManyRuns, files: Sequence[str] | None) -> dict[str, np.ndarray]:
    """Return what is retained of all runs: read from files of chunks, or made if there are none."""
    if files:
        return join_chunks(map(arrays_in, files))
    return run_chunk(runs.problems, runs.retain, progress=Progress())


def write_chunk(path: str, runs: ManyRuns, chunk: str) -> None:
    """Make the runs of one chunk, such as ".parts/2-of-8", and write what is retained of them."""
    number, count = map(int, re.findall(r"\d+", chunk))
    retained = run_chunk(runs.problems, runs.retain, number - 1, count, Progress())
    variables = {
        name: Variable(
            ("run", *(f"{name}_{axis}" for axis in range(1, values.ndim))), values, "of each run"
        )
        for name, values in retained.items()
    }
    write(path, variables, {"title": "A part of many runs"})


def arrays_in(path: str) -> dict[str, np.ndarray]:
    """Return what the dataset of a chunk holds, by name."""
    return {str(name): array.values for name, array in read(path).data_vars.items()}


if __name__ == "__main__":
    run(compute, snakemake)  # noqa: F821
