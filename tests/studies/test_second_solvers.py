"""Numbers of studies that one solver makes, taken again by a solver of another family.

Where the motion is regular both give the same number. Where it is chaotic two solvers draw two
samples of one distribution, so that means of ensembles agree within their confidence intervals.
"""

import numpy as np
import pytest
from latticode.datasets.netcdf import as_xarray
from latticode.equations.ensembles import draw_members
from pendula.problem import PENDULA
from pendula.studies.breathers.fates import map_fates
from pendula.studies.breathers.sensitivity import measure_sensitivity
from pendula.studies.newton.over_the_top import measure_passage
from problems import problem_of
from scipy.stats import fisher_exact, mannwhitneyu

DOP853 = {"name": "dop853", "rtol": 1e-9, "atol": 1e-9}
TAYLOR = {"name": "taylor", "rtol": 1e-7, "atol": 1e-7}
CRANK_NICOLSON = {"name": "crank_nicolson", "step": 4e-3, "tolerance": 1e-10, "iterations": 50}
KAHAN_LI = {"name": "kahan_li", "step": 0.1}
CHANCE = 1e-4
"""Of a right pair of solvers: that a test on two samples refuses it."""


@pytest.mark.parametrize("solver", [DOP853, CRANK_NICOLSON], ids=["dop853", "crank_nicolson"])
def test_fates_of_regular_motions_are_those_of_every_solver(solver):
    """At Omega = 8 no initial condition of the map is chaotic, nor any with A = B."""

    def fates(chosen):
        amplitudes = 7.0 * (np.arange(4) + 0.5) / 4
        ends = {"end_time": 70.0, "output_step": 70.0, "solver": chosen}
        problems = {omega: problem_of(omega=omega, **ends) for omega in (-4.0, 8.0)}
        return as_xarray(*map_fates(problems, amplitudes).make())["fate"]

    by_taylor, by_second = fates(TAYLOR), fates(solver)
    assert (by_taylor.sel(omega=8) == by_second.sel(omega=8)).all()
    synchronised = [np.diag(fate.sel(omega=-4)) for fate in (by_taylor, by_second)]
    assert (synchronised[0] == synchronised[1]).all()
    assert len(np.unique(by_taylor)) > 2


def test_as_many_perturbed_runs_spread_by_dop853():
    """A share is that of independent runs, so that Fisher's exact test compares two of them."""
    members, perturbation = 96, 1e-3
    problem = problem_of("fig3_large", end_time=70.0, output_step=70.0)
    spread = []
    for solver, seed in ((TAYLOR, 1), (DOP853, 2)):
        contents = measure_sensitivity(
            "fig3_large", problem.changed(solver=solver), [perturbation], members, seed
        )
        spread.append(round(float(as_xarray(*contents.make())["share"][0]) * members))
    table = [[count, members - count] for count in spread]
    assert fisher_exact(table).pvalue > CHANCE
    assert fisher_exact([[members, 0], table[1]]).pvalue < CHANCE  # if all of them spread


def test_pendula_go_over_the_top_as_early_by_a_symplectic_method():
    case = problem_of("fig4_small", model=PENDULA, mu=0.3, end_time=12.0)
    times = []
    for solver, seed in (({**TAYLOR, "rtol": 1e-8}, 1), (KAHAN_LI, 2)):
        members = draw_members(case.changed(solver=solver), 1e-2, 16, seed)
        times.append([measure_passage(member)["time"] for member in members])
    assert np.isfinite(times).all()
    assert mannwhitneyu(*times).pvalue > CHANCE
    assert mannwhitneyu(times[0], 2.0 * np.array(times[1])).pvalue < CHANCE
