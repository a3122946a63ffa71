"""The interface for notebooks: what it returns, refuses and shows, and what importing it costs."""

import doctest

import latticode
import numpy as np
import pendula
import pytest
import xarray as xr
from latticode.datasets.netcdf import read
from pendula import notebook
from pendula.configuration.messages import load
from pendula.own_cases import figures
from problems import as_the_workflow_writes

SHORT = {"omega": -4, "half_width": 6, "end_time": 2}


@pytest.fixture(scope="module")
def case():
    return pendula.Case(**SHORT)


@pytest.fixture(scope="module")
def run(case):
    return pendula.simulate(case, "short")


def test_the_examples_in_the_docstrings_run():
    examples = doctest.testmod(notebook, optionflags=doctest.IGNORE_EXCEPTION_DETAIL)
    assert examples.attempted and not examples.failed


def test_a_run_is_what_the_workflow_writes_and_the_final_state(case, run, tmp_path):
    written = as_the_workflow_writes(case, "short", tmp_path / "short.nc")
    xr.testing.assert_identical(run.drop_vars(["final", "part", "snapshot"]), written)
    run.to_netcdf(tmp_path / "saved.nc", engine="netcdf4")
    xr.testing.assert_identical(read(tmp_path / "saved.nc"), run)


def test_a_case_has_the_defaults_of_the_yaml():
    configured = load({"cases": {"mine": SHORT}})
    assert pendula.Case(**SHORT).shown_problem() == configured.shown_problem("mine")


def test_faults_are_told_in_words_and_all_at_once():
    with pytest.raises(pendula.ConfigurationError) as message:
        pendula.Case(omega="fast", half_width=1, initial={5: (1, 0)}, solver="dop835")
    assert str(message.value).splitlines() == [
        "the case has 2 errors:",
        "  solver: there is no solver 'dop835'; did you mean 'dop853'?",
        "  omega: is 'fast', not a number",
    ]
    with pytest.raises(pendula.ConfigurationError, match="site 5 is outside the chain"):
        pendula.Case(omega=1, half_width=1, initial={5: (1, 0)})


def test_a_run_by_any_solver_is_checked_and_the_second_one_is_drawn_where_it_diverges(run, case):
    checks = pendula.check(case.changed(solver="dop853"), run)
    assert checks["divergence_time"] == np.inf
    drawn = pendula.draw_norms(run, checks)
    assert len(drawn.axes) == 2 and drawn._repr_png_().startswith(b"\x89PNG")
    checks["divergence_time"] = xr.full_like(checks["divergence_time"], 1.0)
    assert len(figures.draw_norms(figures.gather_norms(run, checks)).axes) == 4


def test_a_section_of_the_papers_case_is_refused_by_a_sentence(case):
    with pytest.raises(pendula.ConfigurationError, match="case: its equations are not a Model"):
        latticode.section(case, when=lambda p, a, b: a.real)
