"""What is measured of the solvers, and what decides the sentences on them."""

import numpy as np
import pytest
import xarray as xr
from accepted import dataset
from oracle import CASES, SOLVERS, hamiltonian
from pendula.ledger.criterion import Verdict
from pendula.studies.paper import solvers
from pendula.studies.paper.claims_energy import drifts
from pendula.studies.paper.claims_second_solver import swept_chance
from problems import problem_of


@pytest.fixture(scope="module")
def measured():
    """Return a short case of each kind by all solvers, reduced."""
    case = problem_of("fig2_small", half_width=6, end_time=2.0, output_step=0.02).plain()
    del case["solver"]
    given = {name: SOLVERS[name] for name in ("ode45", "crank_nicolson", "delfour_fortin_payre")}
    return solvers.compare_solvers({"fig2_small": solvers.run_by_all("fig2_small", case, given)})


def test_the_second_solver_tends_to_the_first_as_the_square_of_its_step(measured):
    assert measured["second_step"].values.tolist() == [0.005, 0.0025]
    whole, half = measured["second_difference"].values[0]
    assert whole / half == pytest.approx(4.0, rel=0.05)
    drift = measured["largest_drift"].sel(case="fig2_small", of="absolute", span="whole")
    assert (
        drift.sel(solver="delfour_fortin_payre") < 1e-8 < 1e-5 < drift.sel(solver="crank_nicolson")
    )


def test_a_drift_by_each_reading_and_until_when_it_is_kept(measured, trajectories):
    relative, absolute = (measured["largest_drift"].sel(of=of) for of in ("relative", "absolute"))
    start = np.zeros((2, 13), complex)
    start[:, 6] = CASES["fig2_small"][1]
    energy = hamiltonian(start, (1.0, 1.0, CASES["fig2_small"][0]), "dirichlet")
    np.testing.assert_allclose(absolute / abs(energy), relative)
    runs = {"fig2_small": dict(trajectories["fig2_small"])}
    for real, at in (("ode45", 3.0), ("ode45_real", 4.0)):
        run = runs["fig2_small"][real]
        runs["fig2_small"][real] = run.assign(energy=-0.5 + 2.1e-6 * (run["tau"] >= at))
    until = solvers.compare_solvers(runs)["kept_until"].isel(case=0)
    assert until.sel(solver=["ode45", "ode45_real"]).values.tolist() == [[3.0, 3.0], [4.0, 4.0]]
    assert (until.sel(solver="dop853") == np.inf).all()


@pytest.mark.parametrize(
    ("drift", "start", "verdict", "said"),
    [
        ({}, 1.0, Verdict.CONFIRMED, ""),
        ({("case1", "ode45", "whole"): 3e-6}, 1.0, Verdict.UNDECIDED, "decides in case1"),
        ({("case1", "ode45"): 3e-6}, 1.0, Verdict.UNDECIDED, "decides in case1"),
        ({("case1",): 3e-6}, 1.0, Verdict.NOT_REPRODUCED, "by every definition in case1"),
        ({("case1",): 3e-6}, 100.0, Verdict.UNDECIDED, "decides in case1"),
        ({("case0", "ode45"): 3e-6, ("case1",): 3e-4}, 100.0, Verdict.NOT_REPRODUCED, "case1"),
    ],
)
def test_an_energy_that_only_some_readings_keep_is_not_decided(drift, start, verdict, said):
    """All drift by 1e-7, but for what is given; the energy at the start is `start`."""
    axes = {
        "case": ["case0_small", "case1_small"],
        "solver": [*solvers.UNKNOWNS.values()],
        "of": [*solvers.OF],
        "span": ["early", "whole"],
    }
    largest = xr.DataArray(np.full((2, 2, 2, 2), 1e-7), axes, list(axes))
    for (case, *where), value in drift.items():
        at = dict(zip(("solver", "span"), where, strict=False))
        largest.loc[{"case": f"{case}_small", **at}] = value
    largest.loc[{"of": "relative"}] = largest.sel(of="absolute") / start
    until = ("span", [10.0, 50.0])
    finding = drifts(xr.Dataset({"largest_drift": largest, "until": until}), "small")
    assert finding.verdict == verdict and said in finding.because.replace("_small", "")


def test_the_most_distant_means_decide_the_chance_of_a_sweep():
    """Of 24 means one is off by five standard errors, then all agree."""
    ensembles = dataset("checks/ensembles").sel(half_width=[25, 60, 100])
    far = ensembles["l2_mean"] + 5.0 * np.hypot(*2 * [ensembles["l2_error"]])
    here = (ensembles["half_width"] == 60) & (ensembles["statistic"] == "mean")
    off = ensembles.assign(l2_mean=ensembles["l2_mean"].where(~here, far))
    assert swept_chance("fig6_right", ensembles, off) < 0.001
    assert swept_chance("fig6_right", ensembles, ensembles) == 1.0
