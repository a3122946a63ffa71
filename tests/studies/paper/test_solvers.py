"""What is measured of the solvers, and which numbers decide the claims on them."""

import numpy as np
import pytest
import xarray as xr
from latticode.measures.difference import VISIBLE
from oracle import CASES, SOLVERS, hamiltonian
from pendula.studies.paper import solvers
from pendula.studies.paper.claims_energy import drifts
from problems import problem_of
from replication.ledger.criterion import Verdict
from two_norms import run


@pytest.fixture(scope="module")
def measured():
    """Return a short case of each kind by all solvers, reduced."""
    case = problem_of("fig2_small", half_width=6, end_time=2.0, output_step=0.02).plain()
    del case["solver"]
    compared_solvers = {
        name: SOLVERS[name] for name in ("ode45", "crank_nicolson", "delfour_fortin_payre")
    }
    return solvers.compare_solvers(
        {"fig2_small": solvers.run_by_all("fig2_small", case, compared_solvers)}
    )


def test_the_second_solver_tends_to_the_first_as_the_square_of_its_step(measured):
    assert measured["second_step"].values.tolist() == [0.005, 0.0025]
    full_step, half_step = measured["second_difference"].values[0]
    assert full_step / half_step == pytest.approx(4.0, rel=0.05)
    drift = measured["largest_drift"].sel(case="fig2_small", of="absolute")
    assert (
        drift.sel(solver="delfour_fortin_payre") < 1e-8 < 1e-5 < drift.sel(solver="crank_nicolson")
    )


def test_a_drift_by_each_reading(measured):
    relative, absolute = (measured["largest_drift"].sel(of=of) for of in ("relative", "absolute"))
    start = np.zeros((2, 13), complex)
    start[:, 6] = CASES["fig2_small"][1]
    energy = hamiltonian(start, (1.0, 1.0, CASES["fig2_small"][0]), "dirichlet")
    np.testing.assert_allclose(absolute / abs(energy), relative)
    np.testing.assert_array_equal(measured["drift"].max("tau"), absolute)


@pytest.mark.parametrize(
    ("drift", "start", "verdict", "reason"),
    [
        ({}, 1.0, Verdict.CONFIRMED, ""),
        ({("case1", "ode45"): 3e-6}, 1.0, Verdict.UNDECIDED, "on the definition in case1"),
        (
            {("case1",): 3e-6},
            1.0,
            Verdict.NOT_REPRODUCED,
            "larger in case1 (absolute or relative, with complex or real unknowns)",
        ),
        ({("case1",): 3e-6}, 100.0, Verdict.UNDECIDED, "on the definition in case1"),
        ({("case0", "ode45"): 3e-6, ("case1",): 3e-4}, 100.0, Verdict.NOT_REPRODUCED, "case1"),
    ],
)
def test_an_energy_that_only_some_readings_keep_is_not_decided(drift, start, verdict, reason):
    """All drift by 1e-7, but for what is given; the energy at the start is `start`."""
    axes = {
        "case": ["case0_small", "case1_small"],
        "solver": [*solvers.UNKNOWNS.values()],
        "of": ["absolute", "relative"],
    }
    largest = xr.DataArray(np.full((2, 2, 2), 1e-7), axes, list(axes))
    for (case, *where), value in drift.items():
        largest.loc[{"case": f"{case}_small", **dict(zip(("solver",), where, strict=False))}] = (
            value
        )
    largest.loc[{"of": "relative"}] = largest.sel(of="absolute") / start
    finding = drifts(xr.Dataset({"largest_drift": largest}, {"tau": [0.0, 50.0]}), "small")
    assert finding.verdict == verdict and reason in finding.because.replace("_small", "")


def test_each_solver_has_its_horizon():
    bad = run(changes={("l2", 1, 2): 1.008, ("l2", 1, 6): 1.02})
    runs = {"case": {"taylor": run(), "ode45": bad, "crank_nicolson": run(omega=7.0)}}
    computed = solvers.trust_solvers(runs, {"case": run()}).sel(case="case")
    horizons = computed["horizon"]
    assert horizons.sel(solver="ode45") == 3.0
    assert (horizons.sel(solver="taylor") == np.inf).all()
    assert horizons.sel(solver="crank_nicolson").isnull().all()
    assert computed["visible"] == VISIBLE


@pytest.mark.parametrize(("omega", "known"), [(8.0, [0.02, 0.4, 0.8]), (7.0, [np.nan] * 3)])
def test_a_bound_is_proved_of_a_curve_of_the_same_case(omega, known):
    """Its norms are lower by 0.4 of the bound, which those of the reference rise by."""
    right = run().isel(tau=slice(2))
    rising = xr.DataArray([0.0, 0.008], dims="tau")
    proved = (right + rising - 0.008).assign(bound=xr.full_like(right["tau"], 0.02))
    proved = proved.assign_attrs(right.attrs | {"omega": omega})
    reference = right + rising
    computed = solvers.trust_solvers(
        {"case": {"ode45": run()}}, {"case": reference.assign_attrs(right.attrs)}, {"case": proved}
    )
    values = [float(computed[name][0]) for name in ("l2_bound", "distance", "late_distance")]
    assert values == pytest.approx(known, nan_ok=True)
