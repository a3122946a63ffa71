"""What scripts/dataset.py writes: attributes on the computation, and chunks of a study."""

import sys
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from helpers import ROOT
from latticode.datasets.netcdf import Variable, read, write
from latticode.simulation.runs import ManyRuns
from pendula.problem import PaperProblem
from problems import problem_of


@pytest.fixture(scope="module")
def dataset():
    """Return the script as a module; its hook on uncaught errors is taken back."""
    hook, path = sys.excepthook, list(sys.path)
    sys.path.insert(0, str(ROOT / "scripts"))
    import dataset

    sys.excepthook, sys.path[:] = hook, path
    return dataset


def job(outputs, function, inputs=None, chunk="", **params) -> SimpleNamespace:
    """Return a job as Snakemake hands it to the script."""
    return SimpleNamespace(
        rule="study",
        input=inputs or {},
        params=SimpleNamespace(**params, call=[f"{__name__}.{function.__name__}", "hash"]),
        output=list(map(str, outputs)),
        wildcards={"chunk": chunk},
    )


class Places(dict):
    """Names with values, as Snakemake's are."""

    __getattr__ = dict.__getitem__


def run(dataset, snakemake, outputs=()):
    snakemake.params = Places(vars(snakemake.params))
    snakemake.output = Outputs(snakemake.output)
    dataset.compute(snakemake)


class Outputs(list):
    """Outputs without names, as Snakemake's are."""

    def items(self):
        return ()


def copy_twice(source: xr.Dataset, members: int):
    for _ in range(2):
        yield {"mine": Variable((), float(source["mine"]), "mine")}, {"title": "Two", "sites": 9}


def test_each_dataset_of_a_job_has_its_settings_and_names_its_sources(dataset, tmp_path):
    source, outputs = tmp_path / "checks/source.nc", [tmp_path / f"copies/{n}.nc" for n in "ab"]
    write(source, {"mine": Variable((), 1.0, "mine")}, {"title": "A source"})
    run(dataset, job(outputs, copy_twice, {"source": str(source)}, members=4))
    for path in outputs:
        attributes = read(path).attrs
        assert (attributes["members"], attributes["sites"]) == (4, 9)
        assert attributes["computed_from"].endswith("checks/source")
        assert attributes["computed_by"].endswith("copy_twice")


def squares(problem: PaperProblem, count: int) -> ManyRuns:
    problems = [problem.changed(end_time=float(number + 1)) for number in range(count)]

    def conclude(retained):
        return {"square": Variable(("run",), retained["square"], "square")}, {"title": "Squares"}

    return ManyRuns(problems, lambda each: {"square": each.end_time**2}, conclude)


def test_chunks_hold_every_third_run_and_are_joined_to_the_same_dataset(dataset, tmp_path):
    settings = {"problem": problem_of("fig2_small").plain(), "count": 7}
    chunks = [tmp_path / f"squares.parts/{n}-of-3.nc" for n in (1, 2, 3)]
    for path in chunks:
        run(dataset, job([path], squares, chunk=f".parts/{path.stem}", **settings))
    np.testing.assert_array_equal(read(chunks[1])["square"], [4.0, 25.0])
    unsplit, joined = tmp_path / "whole.nc", tmp_path / "joined.nc"
    run(dataset, job([unsplit], squares, **settings))
    run(dataset, job([joined], squares, {"chunks": list(map(str, chunks))}, **settings))
    np.testing.assert_array_equal(read(joined)["square"], np.arange(1.0, 8.0) ** 2)
    xr.testing.assert_identical(read(joined), read(unsplit))
