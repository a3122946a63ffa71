"""What reruns after a change, and what does not: asked of the real snakemake.

To ask costs seconds, so that edits with different answers share a clone where the answers do not
overlap. Which files a job depends on is asked of its record, in tests/test_project.py.
"""

import os

from helpers import change, edit, planned

SIMULATIONS = {"trajectory", "measure_solvers", "sweep", "sweep_by_second_solver"}
MEASURES = {
    "measure_lyapunov",
    "run_ensembles",
    "run_lifetimes",
    "run_members",
}


def test_a_new_omega_reruns_its_case_its_sweep_and_the_figures_that_show_them(full_run, clone):
    for size in ("large", "small"):  # a sweep uses the small case, and none uses the large one
        change_of = f"{{<<: *{size}, omega: 0}}", f"{{<<: *{size}, omega: 0.5}}"
        edit(clone / "config/config.yaml", *change_of)
    jobs = planned(clone, full_run)
    assert jobs["trajectory"] == 2 and jobs["measure_solvers"] == 1
    assert jobs["sweep"] == 1 and "sweep_by_second_solver" not in jobs
    # the ensembles of all cases lie in one dataset, which Figs 3 and 4 show
    shown_in = {"norms_by_half_width", "energy_drift", "trust_horizons"}
    assert jobs.keys() >= shown_in | MEASURES
    assert jobs["norms_in_time"] < 3 and "fig1" not in jobs


def test_figures_claims_checks_and_tangent_equations_rerun_alone(full_run, clone):
    """What was observed and what algebra proves have no part in what checks do: checks.py."""
    for module in ("paper/chain_figure", "paper/claims_norms", "theory/figures", "theory/checks"):
        change(clone / f"scripts/pendula/studies/{module}.py")
    change(clone / "packages/latticode/latticode/localised/tangents.py")
    jobs = planned(clone, full_run)
    assert jobs.keys() & MEASURES == {"measure_lyapunov"} and not jobs.keys() & SIMULATIONS
    checks = {entry for entry in jobs if entry.startswith("check_")}
    assert checks == {"check_theory"}
    assert {"fig1", "stability_chart", "bounds"} <= jobs.keys()
    assert {"decide_claims", "claims", "report", "article", "all"} <= jobs.keys()
    assert not {"norms_by_half_width", "fronts", "fates"} & jobs.keys()


def test_the_equations_rerun_every_simulation_until_the_change_is_taken_back(finished, clone):
    """Times of files, comments and docstrings rerun nothing: neither those of the project, which
    is newer than every result, nor of what a figure shows."""
    equations = clone / "scripts/pendula/models/amplitudes.py"
    text = equations.read_text()
    change(equations)
    jobs = planned(clone, finished)
    assert jobs["trajectory"] == 6 and jobs["measure_solvers"] == 1
    assert jobs["sweep"] == 4 and jobs["sweep_by_second_solver"] == 2
    equations.write_text(text)
    for module in ("models/amplitudes", "studies/paper/figures", "studies/paper/claims_norms"):
        path = clone / f"scripts/pendula/{module}.py"
        path.write_text(path.read_text().replace('"""', '"""Said again. ', 1) + "# a comment\n")
    for path in (finished / "results/figures").glob("*.nc"):
        os.utime(path)
    assert planned(clone, finished) == {}
