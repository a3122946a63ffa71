"""Lemma 2 on runs, beside SciPy on plain arrays forward and backward in time."""

import numpy as np
import pytest
import xarray as xr
from oracle import slope
from pendula.jobs.decide import all_claims
from pendula.studies.theory import well_posed
from replication.ledger.verdicts import decide
from scipy.integrate import solve_ivp

OMEGA, POWER = 0.0, 26.0


@pytest.fixture(scope="module")
def check() -> xr.Dataset:
    return xr.Dataset.from_dict(well_posed.check_well_posed())


def solved(start: np.ndarray, end_time: float) -> np.ndarray:
    """Return the state at `end_time`, which may be negative, by SciPy at tight tolerances."""

    def rates(_, z):
        return slope(z.reshape(2, -1), (1.0, 1.0, OMEGA), "dirichlet").ravel()

    solution = solve_ivp(
        rates, (0.0, end_time), start.ravel(), method="DOP853", rtol=1e-12, atol=1e-12
    )
    return solution.y[:, -1].reshape(2, -1)


@pytest.mark.parametrize(("course", "sign"), [("forward", 1), ("backward", -1)])
@pytest.mark.parametrize("direction", well_posed.DIRECTIONS)
def test_distances_are_those_of_scipy_in_both_directions_of_time(check, course, sign, direction):
    """Backward in time SciPy takes the data themselves, and the study their conjugates."""
    start = well_posed.start_of(POWER, course)
    near = well_posed.perturbed(start, direction, 1e-4)
    start, near = (state.conj() if sign < 0 else state for state in (start, near))
    ends = [solved(state, sign * well_posed.CLOSE_TIME) for state in (start, near)]
    ratio = well_posed.distance_of(*ends) / well_posed.distance_of(start, near)
    cell = {"omega": OMEGA, "initial_power": POWER, "course": course, "direction": direction}
    assert float(check["distance_ratio"].sel(cell).sel(perturbation_size=1e-4)) == pytest.approx(
        ratio, rel=1e-6
    )


def test_a_perturbation_has_its_size_and_moves_only_what_it_names():
    start = well_posed.start_of(POWER, "forward")
    for direction in well_posed.DIRECTIONS:
        change = well_posed.perturbed(start, direction, 1e-3) - start
        size = np.sqrt((np.abs(change) ** 2).sum() / (np.abs(start) ** 2).sum())
        assert size == pytest.approx(1e-3)
        unperturbed = change[1] if direction == "A alone" else change[:, :10]
        assert np.all(unperturbed == 0.0) != (direction == "all sites")


def test_rows_on_lemma_2_are_decided_by_every_cell(check):
    """One cell that contradicts them is enough, whatever its Omega, size and direction."""
    claims = {claim.name: claim for claim in all_claims("theory/claims_nonlinear")}
    terms = xr.DataArray(
        np.zeros((2, 1)),
        {"identity": ["distance of two solutions", "(19)"], "boundary": ["free"]},
    )
    identities = xr.Dataset({"terms": terms})
    wrong = {
        "global_existence": ("steepest", 1.01),
        "uniqueness": ("between_solvers", 1e-8),
        "continuous_dependence": ("distance_ratio", 1e4),
    }
    for name, (variable, value) in wrong.items():
        sources = {"checks/identities": identities, "checks/well_posed": check}
        finding = decide(claims[name], sources)
        assert finding.verdict == "confirmed with a caveat"
        assert "P up to 1000 and" in finding.because and "relies on the proof" in finding.because
        changed = check[variable].copy()
        changed[dict.fromkeys(changed.dims, 0)] = value
        sources["checks/well_posed"] = check.assign({variable: changed})
        assert decide(claims[name], sources).verdict == "not reproduced"


def test_no_coordinate_has_the_name_of_an_axis_of_time(check):
    """CF readers take a coordinate "time" for one, and its labels are no times."""
    assert "time" not in check.variables and check["course"].values.tolist() == [
        "forward",
        "backward",
    ]
