"""What a function gets of the inputs and parameters of its rule, by its annotations."""

import math
from collections.abc import Mapping, Sequence
from types import SimpleNamespace

import pytest
import xarray as xr
from helpers import ROOT
from latticode.datasets.netcdf import Variable, write
from pendula.contract.arguments import RuleError, check_names, function_of, load_arguments
from pendula.problem import PaperProblem
from problems import problem_of

KINDS = {xr.Dataset: xr.load_dataset, PaperProblem: PaperProblem.of}
ENTRIES = problem_of("fig2_small").plain()


def job(inputs=(), params=(), outputs=()) -> SimpleNamespace:
    """Return a job as Snakemake hands it to a script."""
    places = {"input": dict(inputs), "params": dict(params), "output": dict(outputs)}
    return SimpleNamespace(rule="measure_waves", **places)


def loaded(function, **places):
    return load_arguments(function, job(**places), KINDS)


@pytest.fixture
def paths(tmp_path) -> list[str]:
    """Return the paths of two datasets in results/checks."""
    files = [str(tmp_path / f"checks/{name}.nc") for name in ("left", "right")]
    for number, path in enumerate(files):
        write(path, {"mine": Variable((), float(number), "mine")}, {"title": "Mine"})
    return files


def measure(
    one: xr.Dataset,
    several: Sequence[xr.Dataset],
    by_name: Mapping[str, xr.Dataset],
    optional: xr.Dataset | None = None,
    path: str = "",
):
    """Take datasets in all ways."""


def test_paths_become_datasets_by_annotation_alone(paths):
    inputs = {"one": paths[1], "several": paths, "by_name": paths, "optional": [], "path": paths[0]}
    arguments = loaded(measure, inputs=inputs)
    values = arguments.values
    assert float(values["one"]["mine"]) == 1.0
    assert [float(data["mine"]) for data in values["several"]] == [0.0, 1.0]
    assert list(values["by_name"]) == ["left", "right"]
    assert "optional" not in values and values["path"] == paths[0]
    assert arguments.sources.keys() == {"one", "several", "by_name"}
    assert arguments.sources["one"][0].endswith("checks/right")
    assert arguments.settings == {"path": paths[0]}


def integrate(
    problem: PaperProblem, several: list[PaperProblem], by_case: dict[str, PaperProblem], seed: int
):
    """Take problems in all ways."""


def test_plain_values_become_problems_by_annotation_alone():
    params = {"problem": ENTRIES, "several": [ENTRIES], "by_case": {"a": ENTRIES}, "seed": 7}
    values = loaded(integrate, params=params).values
    problems = values["problem"], values["several"][0], values["by_case"]["a"]
    assert all(isinstance(problem, PaperProblem) for problem in problems) and values["seed"] == 7


def draw(long: xr.Dataset | None, files: list[str], output: str):
    """Take files of the project, and an output."""


def test_a_file_of_the_project_is_found_wherever_the_job_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    place = "tests/baseline/quoted/chaos.nc"
    committed = {"committed": place, "sha256": "0f"}
    params = {"call": ["x", "0f"], "code": "0f", "long": committed, "files": [committed]}
    arguments = loaded(draw, params=params, outputs={"output": "a.png"})
    assert arguments.sources == {"long": ["tests/baseline/quoted/chaos"]}
    assert arguments.values["files"] == [str(ROOT / place)]
    assert arguments.values["output"] == "a.png"


def waves(sizes, seed, members=3):
    """Take plain values."""


@pytest.mark.parametrize(
    ("params", "sentence"),
    [
        ({"sizes": 1, "sede": 2}, "has no parameter 'sede'; did you mean 'seed'?"),
        ({"sizes": 1, "seed": 2, "kernels": 3}, "has no parameter 'kernels' (it takes sizes, seed"),
        ({"seed": 2}, "does not give sizes, which"),
    ],
)
def test_an_unknown_misspelt_or_missing_parameter_is_refused_by_name(params, sentence):
    with pytest.raises(RuleError) as error:
        loaded(waves, params=params)
    assert sentence in str(error.value) and str(error.value).startswith("rule measure_waves")
    assert f"{__name__}.waves" in str(error.value)


def test_a_name_that_is_an_input_and_a_parameter_is_refused():
    with pytest.raises(RuleError, match="gives 'sizes' twice"):
        loaded(waves, inputs={"sizes": "a"}, params={"sizes": 1, "seed": 2})


def test_a_rule_names_its_function_with_a_hash_of_the_code():
    assert function_of(["math.sqrt", "0f"]) is math.sqrt
    check_names(waves, {"sizes": 1, "seed": 2}, "rule right")
