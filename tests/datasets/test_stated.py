"""A dataset states what its job was given, as attributes that netCDF can hold."""

from types import SimpleNamespace

import dataset
import numpy as np
import pytest
from latticode.datasets.netcdf import Variable, read, write
from latticode.datasets.stated import stated
from pendula.problem import by_name
from problems import problem_of

CONSTANTS = {"epsilon": 1.0, "gamma": 0.5, "omega": -4.0}


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"seed": 3, "window": None}, {"seed": 3}),
        ({"constants": CONSTANTS}, CONSTANTS),
        ({"solver": {"name": "ode45", "rtol": 1e-6}}, {"solver": "ode45", "solver_rtol": 1e-6}),
        ({"sizes": [3, 9], "is": True}, {"sizes": "[3, 9]", "is": "true"}),
        ({"pair": (1 + 2j, 0.5)}, {"pair": '["(1+2j)", 0.5]'}),
        ({"grid": np.arange(2.0)}, {"grid": "[0.0, 1.0]"}),
        ({"between": {"a": [1, 2]}}, {"between": '{"a": [1, 2]}'}),
        ({"ends": {0.2: 1, 0.1: 2}}, {"ends": '{"0.2": 1, "0.1": 2}'}),
    ],
)
def test_arguments_become_numbers_and_text(given, says):
    assert stated(given, (), [], make) == says | {"computed_by": f"{__name__}.make"}


def test_several_problems_state_what_they_share_once_and_the_rest_by_name():
    problems = by_name(
        {name: problem_of(omega=at).plain() for name, at in (("a", 8.0), ("b", 0.0))}
    )
    found = stated({"problems": problems}, (), ["checks/a", "checks/b"], make)
    assert found["half_width"] == problems["a"].half_width and "omega" not in found
    assert found["problems"] == '{"a": {"omega": 8.0}, "b": {"omega": 0.0}}'
    assert found["computed_from"] == "checks/a, checks/b"
    assert "problems" not in stated({"problems": problems}, ("omega",), [], make)
    infinite = problems["a"].changed(half_width=None)
    assert "half_width" not in stated({"problem": infinite}, (), [], make)


def test_each_dataset_of_a_job_states_its_own_entry_and_names_what_it_was_made_from(tmp_path):
    source, made = tmp_path / "checks" / "source.nc", [tmp_path / f"wrong/{n}.nc" for n in "ab"]
    write(source, {"mine": Variable((), 1.0, "mine")}, {"title": "A source"})
    snakemake = SimpleNamespace(
        input={"source": str(source)},
        params=Params(
            call=[f"{__name__}.{make.__name__}", "hash of the code"],
            checks={"wrong/a": {"seed": 1}, "wrong/b": {"seed": 2}},
            members=4,
        ),
        output=list(map(str, made)),
    )
    dataset.make(snakemake)
    for seed, path in enumerate(made, 1):
        about = read(path).attrs
        assert (about["seed"], about["members"], about["sites"]) == (seed, 4, 9)
        assert "checks" not in about and about["computed_from"].endswith("checks/source")


class Params(dict):
    """Parameters of a job, by their names as Snakemake has them."""

    __getattr__ = dict.__getitem__


def make(source, checks, members):
    for _ in checks:
        yield {"mine": Variable((), float(source["mine"]), "mine")}, {"title": "Two", "sites": 9}
