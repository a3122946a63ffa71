"""Ensembles of long runs, and the norms of one chain at many half-widths."""

import numpy as np
import pytest
from pendula.studies.unbounded import active_sites
from pendula.studies.unbounded.active_sites import run_chains, run_long
from pendula.studies.unbounded.long_runs import maxima, member, window_map
from problems import problem_of

LOOSE = {"name": "dop853", "rtol": 1e-8, "atol": 1e-8}
TIGHT = {"name": "dop853", "rtol": 1e-13, "atol": 1e-13}
PROBLEM = problem_of("fig4_small", half_width=None, end_time=40.0, output_step=0.25, solver=LOOSE)
REGULAR = problem_of("fig3_small", half_width=None, end_time=40.0, output_step=0.5, solver=TIGHT)
REST = 1e-20


def test_members_differ_by_little_and_are_the_same_every_time():
    drawn = ((1e-6, 2017, 1), (1e-6, 2017, 1), (1e-6, 2017, 2), (1e-6, 1, 1), (1e-3, 2017, 1))
    first, again, second, other, larger = (member(PROBLEM, *one).initial for one in drawn)
    assert member(PROBLEM, 1e-6, 2017, 0) is PROBLEM
    np.testing.assert_array_equal(first, again)
    assert (first != second).all() and (other != first).all()
    np.testing.assert_allclose(larger - PROBLEM.initial, 1e3 * (first - PROBLEM.initial), rtol=1e-8)
    assert first[0, 0] == pytest.approx(1.0, rel=1e-5)


def test_chains_that_share_their_first_pieces_have_the_norms_of_each_run_alone(monkeypatch):
    """Four of the five chains share most pieces of the longest one, which has twenty."""
    done, advance = [], active_sites.advance
    monkeypatch.setattr(
        active_sites, "advance", lambda *given, **more: done.append(1) or advance(*given, **more)
    )
    widths = [10, 64, 70, 100, 2000]
    found = run_chains(REGULAR, REST, widths)
    assert len(done) < 20 + 10
    for half_width, (tau, l2, linf) in zip(widths, found, strict=True):
        alone = run_long(REGULAR.changed(half_width=half_width), REST)
        np.testing.assert_array_equal(tau, alone.tau)
        np.testing.assert_allclose(l2, alone.l2, rtol=1e-11)
        np.testing.assert_allclose(linf, alone.linf, atol=1e-11)
    assert np.abs(found[0][1] - found[-1][1]).max() > 1e-3


def test_a_map_has_the_maxima_of_each_chain():
    widths, ends = [4, 300], np.array([12.0, 20.0])
    found = window_map(REGULAR, REST, widths, ends)
    for half_width, norms in zip(widths, found.swapaxes(0, 1), strict=True):
        alone = run_long(REGULAR.changed(half_width=half_width), REST)
        np.testing.assert_allclose(norms[0], maxima(alone.tau, alone.l2, ends), rtol=1e-6)
        np.testing.assert_allclose(norms[1], maxima(alone.tau, alone.linf, ends), rtol=1e-6)


def test_maxima_start_at_ten_and_include_the_end():
    tau = np.arange(0.0, 20.5, 0.5)
    series = np.where(tau < 10, 99.0, tau)
    np.testing.assert_array_equal(maxima(tau, series, np.array([12.0, 15.5])), [12.0, 15.5])


def test_other_tolerances_give_other_trajectories_of_the_same_power_and_front():
    """So 1e-6 is small enough for the chaotic state."""
    powers, fronts = {}, set()
    for tolerance in (1e-6, 1e-11):
        solver = {"name": "taylor", "rtol": tolerance, "atol": tolerance}
        problems = [member(PROBLEM, 1e-6, 2017, number) for number in range(4)]
        runs = [run_long(one.changed(solver=solver), REST) for one in problems]
        powers[tolerance] = np.array([(run.l2**2)[run.tau > 20.0].mean() for run in runs])
        fronts |= {round(run.front[-1, 0], 2) for run in runs}
    loose, tight = powers.values()
    error = np.hypot(loose.std(ddof=1), tight.std(ddof=1)) / 2.0
    assert abs(loose.mean() - tight.mean()) < 3.0 * error < 0.1 * tight.mean()
    assert len(fronts) == 1
