"""The interface for notebooks: what it returns, refuses and shows, and what importing it costs."""

import doctest
import subprocess
import sys
from pathlib import Path

import pendula
import pytest
import xarray as xr
from pendula import notebook
from pendula.datasets.netcdf import read
from pendula.own_cases import figures
from simulate_own import as_the_workflow_writes

ROOT = Path(__file__).resolve().parents[1]
SHORT = {"omega": -4, "half_width": 6, "end_time": 2}


@pytest.fixture(scope="module")
def case():
    return pendula.Case(**SHORT)


@pytest.fixture(scope="module")
def run(case):
    return pendula.simulate(case, "short")


def test_importing_the_package_loads_nothing_else():
    code = "import sys, pendula; print(*(m for m in sys.modules if m.startswith('pendula.')))"
    said = subprocess.run(
        [sys.executable, "-c", code + "; print('numpy' in sys.modules)"],
        cwd=ROOT / "scripts",
        capture_output=True,
        text=True,
        check=True,
    )
    assert said.stdout.split() == ["False"]


def test_every_public_name_is_there_and_explained():
    for name in pendula.__all__:
        assert getattr(pendula, name).__doc__, name
        assert name in dir(pendula)
    with pytest.raises(AttributeError, match="no attribute 'simulat'"):
        _ = pendula.simulat


def test_the_examples_in_the_docstrings_run():
    found = doctest.testmod(notebook, optionflags=doctest.IGNORE_EXCEPTION_DETAIL)
    assert found.attempted and not found.failed


def test_a_run_is_what_the_workflow_writes_and_the_final_state(case, run, tmp_path):
    written = as_the_workflow_writes(case, "short", tmp_path / "short.nc")
    xr.testing.assert_identical(run.drop_vars(["final", "part"]), written)
    run.to_netcdf(tmp_path / "saved.nc", engine="netcdf4")
    xr.testing.assert_identical(read(tmp_path / "saved.nc"), run)


def test_the_final_state_has_the_norms_of_the_end(run):
    final = run["final"].sel(part="re") + 1j * run["final"].sel(part="im")
    l2 = (abs(final) ** 2).sum("site") ** 0.5
    assert l2.values == pytest.approx(run["l2"].isel(tau=-1).values, rel=1e-14)


def test_a_case_has_the_defaults_of_the_yaml():
    from pendula.configuration.messages import load

    configured = load({"cases": {"mine": SHORT}})
    assert pendula.Case(**SHORT).shown_problem() == configured.shown_problem("mine")


def test_faults_are_told_in_words_and_all_at_once():
    with pytest.raises(pendula.ConfigurationError) as told:
        pendula.Case(omega="fast", half_width=1, initial={5: (1, 0)}, solver="dop835")
    assert str(told.value).splitlines() == [
        "the case has 2 faults:",
        "  omega: is 'fast', not a number",
        "  solver: there is no solver 'dop835'; did you mean 'dop853'?",
    ]
    with pytest.raises(pendula.ConfigurationError, match="site 5 lies outside the chain"):
        pendula.Case(omega=1, half_width=1, initial={5: (1, 0)})


def test_a_changed_case_is_checked_anew(case):
    assert case.changed(omega=8).omega == 8
    with pytest.raises(pendula.ConfigurationError, match="half_width: is -1"):
        case.changed(half_width=-1)


def test_a_sweep_needs_no_fitting_half_width_of_its_case(case):
    peaks = pendula.sweep(case, [2, 4], [(1, 2)], "wider")
    assert dict(peaks.sizes) == {"half_width": 2, "quantity": 3, "statistic": 2, "window": 1}
    assert peaks.attrs["case"] == "wider" and peaks.attrs["end_time"] == 2
    with pytest.raises(pendula.ConfigurationError, match="does not run forward"):
        pendula.sweep(case, [2, 4], [(2, 1)])


def test_a_missing_file_and_an_impossible_run_are_told_in_words(tmp_path):
    with pytest.raises(pendula.DatasetError, match="is missing"):
        pendula.read(tmp_path / "none.nc")
    with pytest.raises(pendula.ConfigurationError, match=r"initial: the squares .* overflow"):
        pendula.Case(omega=0, initial={0: ("1e200", 0)}, end_time=1)
    chaotic = pendula.Case(omega=0, solver={"name": "auto", "error": 1e-12})
    with pytest.raises(pendula.IntegrationError, match=r"agree to 1e-12 only before tau = \d"):
        pendula.simulate(chaotic)


def test_a_notebook_is_given_a_picture(run):
    assert pendula.draw_norms(run)._repr_png_().startswith(b"\x89PNG")


def test_a_run_without_snapshots_is_no_picture_of_space_and_time(run):
    with pytest.raises(ValueError, match="snapshot_step"):
        pendula.draw_spacetime(run.drop_vars("modulus"))


def test_the_second_run_is_drawn_where_it_diverges_only(run, case):
    checks = pendula.check(case, run)
    assert len(pendula.draw_norms(run, checks).axes) == 2
    checks["divergence_time"] = xr.full_like(checks["divergence_time"], 1.0)
    assert len(figures.draw_norms(figures.gather_norms(run, checks)).axes) == 4
