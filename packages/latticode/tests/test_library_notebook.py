"""The library in a notebook: its public names, examples, refusals and figures."""

import doctest
import os
import pydoc
import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import latticode
import pytest
from latticode import (
    Case,
    ConfigurationError,
    Model,
    abs2,
    check,
    lap,
    notebook,
    simulate,
    sin,
    survey,
    sweep,
)
from latticode.datasets import netcdf
from latticode.datasets.trajectories import trajectory_contents
from latticode.drawing import runs, style, surveys
from latticode.simulation.simulate import simulate as made

LADDER = Model(
    fields=("u", "v"),
    parameters={"c": 0.5},
    i_dt=lambda p, u, v: (lap(u) + p.c * v + abs2(u) * u, lap(v) + p.c * u + abs2(v) * v),
)
CASE = Case(model=LADDER, initial={0: [1, 0.5]}, half_width=4, end_time=2)
PROBLEM = CASE.kind.of(CASE.shown_problem())


@pytest.fixture(scope="module")
def run():
    return simulate(CASE)


def test_importing_the_package_loads_nothing_else():
    code = "import sys, latticode; print(*(m for m in sys.modules if m.startswith('latticode.')))"
    paths = {**os.environ, "PYTHONPATH": str(Path(latticode.__file__).parents[1])}
    command = [sys.executable, "-c", code + "; print('numpy' in sys.modules)"]
    process = subprocess.run(command, env=paths, capture_output=True, text=True, check=True)
    assert process.stdout.split() == ["False"]


def test_every_public_name_is_there_and_explained():
    for name in latticode.__all__:
        assert getattr(latticode, name).__doc__, name
        assert name in dir(latticode)
    with pytest.raises(AttributeError, match="no attribute 'simulat'"):
        _ = latticode.simulat


def test_type_checkers_see_the_names_that_there_are():
    text = Path(latticode.__file__).read_text()
    seen = re.findall(r"^    from (\S+) import (\w+) as \2$", text, re.M)
    assert sorted(name for _, name in seen) == latticode.__all__
    assert {home for home, _ in seen} == latticode._HOMES.keys()
    for home, name in seen:
        assert getattr(latticode, name) is getattr(import_module(home), name)
    assert (Path(latticode.__file__).parent / "py.typed").exists()


def test_help_on_a_case_begins_with_its_keys():
    lines = pydoc.plaintext.document(latticode.Case).splitlines()
    assert lines[1].startswith(" |  Case(*, model, parameters={}, initial, half_width=30,")
    assert "model: a Model, or the path of its file." in lines[7]


def test_the_examples_in_the_docstrings_run():
    results = doctest.testmod(notebook, optionflags=doctest.IGNORE_EXCEPTION_DETAIL)
    assert results.attempted and not results.failed


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda r: simulate({"omega": 8}), "a case from `Case`, but got"),
        (lambda r: simulate(CASE, 3), "a name for the dataset, but got 3"),
        (lambda r: simulate(CASE, hours=-1), "hours: is -1; it must be greater"),
        (lambda r: sweep(CASE, [2, 2]), "the same value is given twice: 2"),
        (lambda r: sweep(CASE, [3 * 10**9], [(1, 2)]), "half_widths: the run would"),
        (lambda r: sweep(CASE, [2], [(1, 2), (1, 2)]), "is given twice: .1.0, 2.0"),
        (lambda r: sweep(CASE, [2], [(1, 2)], "a b"), "is not a name: use"),
        (lambda r: check(CASE, 8), "a run from `simulate` or `read`, but got"),
        (lambda r: notebook.draw_norms(r.drop_vars("tau")), "the dataset has no tau"),
        (lambda r: simulate(CASE, hours=1e-9), "the run would take less than a"),
        (lambda r: simulate(CASE.changed(end_time=2e6)), "end_time: the run would"),
        (lambda r: sweep(CASE, 3), "half_widths: is 3, not a list"),
        (lambda r: check(CASE, r[["l2"]]), "the dataset has no linf"),
        (lambda r: check(CASE.changed(parameters={"c": 1}), r), "differs in parameters"),
        (
            lambda r: notebook.draw_spacetime(r.drop_vars("modulus")),
            "or 'state'., but the data",
        ),
        (lambda r: notebook.draw_survey(r["l2"]), "a survey from `survey`, but got"),
        (lambda r: notebook.draw_sweep(r), "a sweep from `sweep`, but the dataset"),
    ],
)
def test_what_cannot_be_done_is_told_before_anything_runs(call, words, run):
    with pytest.raises(ConfigurationError, match=words):
        call(run)


def test_snapshots_are_chosen_by_their_times(run, tmp_path):
    latticode.save(tmp_path / "run.nc", run)
    netcdf.write(tmp_path / "job.nc", *trajectory_contents("job", PROBLEM, made(PROBLEM)))
    for opened in (run, latticode.read(tmp_path / "run.nc"), latticode.read(tmp_path / "job.nc")):
        chosen = opened["modulus"].sel(snapshot=1.5)
        assert (chosen == opened["modulus"].isel(snapshot=60)).all() and chosen.ndim == 2
        with pytest.raises(KeyError):
            opened["modulus"].sel(snapshot=20)
    assert len(notebook.draw_spacetime(run).axes) >= 3


def test_titles_and_captions_name_the_model_its_fields_and_the_data(run):
    figure = notebook.draw_norms(run)
    left, right = figure.axes
    assert left.get_title("left") == "model: c 0.5,  $M = 4$"
    assert right.get_title("left") == "$(u_{0}, v_{0}) = (1, 0.5)$,  ends at rest"
    assert [line.get_color() for line in left.get_lines()] == [style.RED, style.BLUE]
    assert "Norms of u (red) and v (blue) against" in runs.gather_norms(run).attrs["caption"]
    swept = sweep(CASE, [2, 4], windows=[(1, 2)])
    assert notebook.draw_sweep(swept).axes[0].get_ylabel().endswith("of $(u, v)$")
    assert len(notebook.draw_spacetime(run).axes) == 3


def test_a_survey_is_drawn_against_one_axis_over_two_as_maps_or_by_member():
    values, members = [0.5, 1.0], {"count": 3, "size": 0.01, "seed": 1}
    case = CASE.changed(end_time=1)
    line = notebook.draw_survey(survey(case, {"c": values}, keep=["final_l2"]))
    assert [list(curve.get_xdata()) for curve in line.axes[0].get_lines()] == [values] * 2
    over_two = survey(case, {"c": values, "end_time": [1, 2]}, keep=["final_l2"])
    maps = notebook.draw_survey(over_two).axes
    assert [axes.get_title() for axes in maps[:2]] == ["u", "v"]
    drawn = maps[0].collections[0].get_array()
    assert (drawn == over_two["final_l2"].isel(component=0).T).all()
    points = notebook.draw_survey(survey(case, {}, keep=["final_l2"], members=members))
    assert points.axes[0].get_lines()[0].get_linestyle() == "None"


@pytest.mark.parametrize("cores", [0, -1, 1.5, True, "2"])
def test_a_survey_on_no_core_is_refused_by_name(cores):
    with pytest.raises(ConfigurationError, match=r"cores: is .* give a whole number, at least 1"):
        survey(CASE, {"c": [0.5]}, cores=cores)


def test_imaginary_parts_that_nothing_reads_are_refused_and_others_explained(capsys):
    turning = Model(fields="u", parameters={}, i_dt=lambda p, u: 1j * sin(u.right.real - u.real))
    with pytest.raises(ConfigurationError, match=r"site 0: u has the imaginary part 2, which no"):
        Case(model=turning, initial={0: ["1+2j"]}, half_width=3)
    growing = Model(fields="x", parameters={}, i_dt=lambda p, x: 1j * (x.left * x - x))
    waves = Model(fields="u", parameters={}, i_dt=lambda p, u: 1j * (lap(u) - abs2(u) * u))
    for model, explained in ((growing, True), (waves, False)):
        case = Case(model=model, initial={0: ["1+2j"]}, half_width=3, end_time=0.1)
        simulate(case)
        assert ("the equations are those of real fields" in capsys.readouterr().out) == explained
        simulate(case.changed(initial={0: [1]}))
        assert capsys.readouterr().out == ""


def test_a_survey_with_failed_runs_is_drawn_and_says_how_many_are_left_out():
    escaping = Model(fields="x", parameters={"k": 1.0}, d2_dt2=lambda p, x: p.k * x * x * x)
    case = Case(model=escaping, initial={0: [1]}, half_width=1, end_time=2)
    data = survey(case, {"k": [0.1, 0.5, 9.0]}, keep=["final_l2"])
    assert data.attrs["failed_runs"] == 1 and str(data["failure"][2].values).startswith("taylor")
    drawn = surveys.gather_survey(data)
    assert "Failed runs (1) are left out." in drawn.attrs["caption"]
    assert len(notebook.draw_survey(data).axes) == 1
