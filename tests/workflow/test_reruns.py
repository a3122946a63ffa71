"""What reruns after a change, and what does not: asked of the real snakemake."""

import os
import shutil

import pytest
import xarray as xr
from helpers import change, edit, planned, snakemake_with

SIMULATIONS = {"trajectory", "sweep"}
PLOTS = {f"fig{n}" for n in range(1, 7)} | {"solver_figures"}


def test_nothing_is_to_be_done_after_a_full_run(finished, clone):
    """The clone is newer than every result: only its content counts."""
    assert planned(clone, finished) == {}


def test_touching_every_file_changes_nothing(finished, clone):
    for path in [*clone.rglob("*"), *finished.glob("results/code/*")]:
        os.utime(path)
    assert planned(clone, finished) == {}


def test_results_moved_beside_a_new_clone_are_taken_as_they_are(finished, clone, tmp_path):
    """Even without Snakemake's own records, as after unpacking an archive."""
    shutil.copytree(finished / "results", tmp_path / "new" / "results")
    assert planned(clone, tmp_path / "new") == {}


def test_a_new_omega_reruns_its_case_and_the_figures_that_show_it(finished, clone):
    edit(clone / "config/config.yaml", "{<<: *large, omega: 0}", "{<<: *large, omega: 0.5}")
    jobs = planned(clone, finished)
    assert jobs.pop("trajectory") == jobs.pop("trajectory_by_solvers") == 1
    shown_in = {"fig4", "solver_figures", "solver_table", "all"}
    assert jobs.keys() >= shown_in
    # the ensembles of all chaotic cases lie in one dataset, which Figs 3 to 6 show
    assert not jobs.keys() & {"fig1", "fig2", "sweep"}


def test_a_new_omega_reaches_the_sweep_of_its_case(finished, clone):
    edit(clone / "config/config.yaml", "{<<: *small, omega: 0}", "{<<: *small, omega: 0.5}")
    jobs = planned(clone, finished)
    assert jobs["sweep"] == 1 and "fig5" in jobs and "fig2" not in jobs


def test_the_plot_style_reruns_plots_only(finished, clone):
    edit(clone / "scripts/pendula/drawing/style.py", '"font.size": 8', '"font.size": 9')
    jobs = planned(clone, finished)
    assert set(jobs) & SIMULATIONS == set() and jobs.keys() >= PLOTS


def test_one_plot_reruns_alone(finished, clone):
    change(clone / "scripts/pendula/studies/paper/chain_figure.py")
    assert set(planned(clone, finished)) == {"fig1", "report", "all"}


@pytest.mark.parametrize(
    "module", ["models/amplitudes.py", "models/amplitudes_series.py", "compiled.py"]
)
def test_the_equations_rerun_every_simulation(finished, clone, module):
    change(clone / "scripts/pendula" / module)
    jobs = planned(clone, finished)
    assert jobs["trajectory"] == jobs["trajectory_by_solvers"] == 6
    assert jobs["sweep"] == jobs["sweep_by_second_solver"] == 4


def test_a_pin_reruns_everything(finished, clone):
    pins = clone / "environment.txt"
    pins.write_text(pins.read_text() + "another==1.0\n")
    jobs = planned(clone, finished)
    assert jobs.keys() >= SIMULATIONS | PLOTS | {"compile_solver"}


def test_a_change_taken_back_changes_nothing(finished, clone):
    chain = clone / "scripts/pendula/models/amplitudes.py"
    text = chain.read_text()
    chain.write_text(text + "# changed\n")
    assert planned(clone, finished)
    chain.write_text(text)
    assert planned(clone, finished) == {}


def test_an_edit_of_the_equations_reaches_the_numbers(clone, tmp_path):
    """A stale cache of compiled kernels would give the old numbers."""
    case = {"omega": 8, "initial": {0: [1, 0.1]}, "end_time": 1, "solver": "dop853"}
    target = "results/trajectories/mine.nc"

    def drift():
        result = snakemake_with({"cases": {"mine": case}}, clone, tmp_path, target)
        assert result.returncode == 0, result.stderr
        with xr.open_dataset(tmp_path / target) as data:
            return float(abs(data["energy"] - data["energy"][0]).max())

    before = drift()
    equations = clone / "scripts/pendula/models/amplitudes.py"
    edit(equations, "+ 0.5 * squared_modulus", "+ 0.25 * squared_modulus")
    assert before < 1e-6 < 1e-3 < drift()
