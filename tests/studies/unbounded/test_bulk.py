"""The bulk behind the front: sums over its sites, means over time, and P from the slope of l2^2."""

import numpy as np
import pytest
from made_up_unbounded import POWER, TERMS, exact, spread, thermal
from oracle import hamiltonian, random_chain
from pendula.ledger.criterion import UndecidableError
from pendula.studies.unbounded import bulk
from pendula.studies.unbounded.claims_bulk import at_energy, unbounded_warm
from problems import constants_of

NUMBERS = (1.2, 0.7, -3.0)
CONSTANTS = constants_of(NUMBERS)


def right_half(half_width):
    """Return an even chain, and the rows of its sites 0..W."""
    z = random_chain(half_width, even=True)
    a, b = z[:, half_width:]
    return z, np.array([a.real, a.imag, b.real, b.imag])


def test_terms_of_the_energy_add_up_to_it():
    z, sites = right_half(9)
    terms = bulk.energy_terms(sites, CONSTANTS)
    both = 2.0 * terms.sum() - terms[:3, 0].sum()  # the centre has no twin, each bond has one
    assert both == pytest.approx(hamiltonian(z, NUMBERS, "dirichlet"), rel=1e-12)
    assert (terms[3] <= 0).all()


def test_means_of_the_bulk_are_those_of_nine_tenths_of_the_way_without_the_centre():
    z, sites = right_half(12)
    (power, *terms), again = bulk.bulk_means(sites, CONSTANTS, np.array([10.0, 10.9]))
    assert power == pytest.approx((np.abs(z[:, 13:21]) ** 2).sum(axis=0).mean())
    np.testing.assert_allclose(terms, bulk.energy_terms(sites, CONSTANTS)[:, 1:9].mean(axis=1))
    assert again[0] == power
    assert (bulk.bulk_of(200.0), bulk.bulk_of(0.0)) == (slice(1, 180), slice(1, 2))


def test_maxima_are_those_of_blocks_on_the_first_half_of_the_way_to_the_front():
    z, sites = right_half(40)
    moduli = np.abs(z).max(axis=0)[41:59]  # the front is at 38.7; its centre is left out
    found = bulk.bulk_maxima(sites, 38.7)
    for i, size in enumerate(bulk.NEIGHBOURS):
        maxima = [max(moduli[end - size : end]) for end in range(size, 19, size)]
        assert found[i] == pytest.approx(np.mean(maxima) if maxima else np.nan, nan_ok=True), size
    assert np.isfinite(found).tolist() == [True] * 5 + [False] * 2
    assert np.isnan(bulk.bulk_maxima(sites, -1.0)).all()


def test_profile_spectrum_and_their_places():
    np.testing.assert_allclose(
        bulk.profile(np.arange(10.0)[None], np.array([0, 2, 10])), [[0.5, 5.5]]
    )
    wave, expected = 3.0 * np.exp(2j * np.pi * 5 / 16 * np.arange(40)), np.zeros(16)
    expected[5] = 9.0 * 16
    np.testing.assert_allclose(bulk.spectrum(wave, 16), expected, atol=1e-10)
    found = bulk.statistics_of(np.zeros(bulk.LENGTH), np.zeros(2), np.array([0.0, 1.0, 3.0]))
    assert found["wave_number"].values[[0, 16, 32]].tolist() == [0.0, np.pi / 2.0, np.pi]
    assert found["modulus"].values.tolist() == [0.5, 2.0]


def test_late_means_are_taken_of_the_late_half():
    run = spread()
    tau = run["piece_tau"].values
    assert bulk.late_means(tau, run)[0] == pytest.approx(tau[tau > 100.0].mean())
    np.testing.assert_allclose(bulk.late_means(tau, run, 2), [125.0, 175.0], atol=1.5)
    assert bulk.mean_powers(run) == pytest.approx(POWER, rel=0.01)
    assert bulk.bulk_powers(run, 4.0).shape == (1, 2, len(tau))
    np.testing.assert_allclose(bulk.mean_terms(run, 4.0)[0, 0], TERMS, rtol=1e-3)


@pytest.mark.parametrize(("delay", "power"), [(1.4, POWER), (0.5, POWER), (0.0, np.nan)])
def test_the_slope_gives_the_power_whatever_the_offset_and_the_delay(delay, power):
    found = bulk.slope_powers(exact(delay))[0].value
    assert found == pytest.approx(power, rel=1e-9, nan_ok=True)


@pytest.mark.parametrize("run", [exact(), exact().isel(tau=slice(0, 395, 2))])
def test_the_line_through_the_squares_starts_at_a_quarter_of_the_run(run):
    """With the quarter itself if there is an output: of a run to 200 at 50, of one to 197 at 50."""
    for first, right in ((49.0, True), (50.0, False)):
        spoilt = run.assign(l2=run["l2"].where(run["tau"] > first, 0.0))
        assert (abs(bulk.slope_powers(spoilt)[0].value - POWER) < 1e-6) == right


def test_a_thermal_state_of_an_energy_lies_between_the_solved_ones():
    states = thermal().assign(warm_power=("site_energy", [16.0, 17.0, 20.0]))
    for energy, power, rise in ((0, 16.0, 0.5), (1, 16.5, 0.5), (3, 18.5, 1.5), (4, 20.0, 1.5)):
        found = at_energy(states, energy)
        assert (found["power"], found["rise"]) == pytest.approx((power, rise))
    with pytest.raises(UndecidableError):
        at_energy(states, 4.5)


def test_the_error_of_the_energy_widens_the_limits_of_p():
    """P of the thermal states rises by 0.1 per unit of energy."""
    warm = spread(omegas=(-4.0,), members=4)
    energies = warm["member"].copy(data=np.array([0.5, 1.5, 0.5, 1.5]))
    uneven = warm.assign(bulk_terms=warm["bulk_terms"] * energies)
    wide, narrow = (unbounded_warm(run, thermal()).measured for run in (uneven, warm))
    assert narrow["energy"] == pytest.approx(sum(TERMS), abs=0.05)
    spans = [one["off_thermal_at_most"] - one["off_thermal_at_least"] for one in (wide, narrow)]
    assert spans[0] == pytest.approx(0.1 * 2.0 * wide["energy_error"], rel=0.2)
    assert spans[0] > 3.0 * spans[1]
