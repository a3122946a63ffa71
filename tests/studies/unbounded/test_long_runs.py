"""Long runs in pieces: checkpoints keep the bits, members differ, maps know free chains."""

import random

import numpy as np
import pytest
from pendula.datasets import DatasetError
from pendula.studies.unbounded import active_sites
from pendula.studies.unbounded.active_sites import SERIES, run_chains, run_long
from pendula.studies.unbounded.long_runs import maxima, member, window_map
from problems import problem_of

LOOSE = {"name": "dop853", "rtol": 1e-8, "atol": 1e-8}
PROBLEM = problem_of("fig4_small", half_width=None, end_time=40.0, output_step=0.25, solver=LOOSE)
REST = 1e-20


def count_pieces(monkeypatch, most=np.inf):
    """Return a list that grows with each piece; Ctrl-C comes after so many."""
    done, advance = [], active_sites.advance

    def counted(*arguments, **more):
        done.append(1)
        if len(done) > most:
            raise KeyboardInterrupt
        return advance(*arguments, **more)

    monkeypatch.setattr(active_sites, "advance", counted)
    return done


@pytest.fixture
def interrupted(monkeypatch, tmp_path):
    """Return the checkpoint of a run that was killed at its 14th piece, after 10 were kept."""
    with monkeypatch.context() as patch, pytest.raises(KeyboardInterrupt):
        count_pieces(patch, 13)
        run_long(PROBLEM, REST, tmp_path / "kept.npz", keep_every=5)
    return tmp_path / "kept.npz"


def test_a_run_continued_from_a_checkpoint_has_the_bits_of_one_never_interrupted(
    interrupted, monkeypatch
):
    whole = run_long(PROBLEM, REST)
    done = count_pieces(monkeypatch)
    continued = run_long(PROBLEM, REST, interrupted)
    assert len(done) == 10
    for name, values in whole._asdict().items():
        np.testing.assert_array_equal(values, getattr(continued, name), name)


def test_a_checkpoint_of_another_problem_is_not_taken(interrupted, monkeypatch):
    done = count_pieces(monkeypatch)
    run_long(PROBLEM.changed(end_time=24.0), REST, interrupted)
    assert len(done) == 12
    run_long(PROBLEM, 0.1 * REST, interrupted)
    assert len(done) == 12 + 20


@pytest.mark.parametrize("part", [0.0, 0.01, 0.5, 0.999])
def test_a_checkpoint_cut_short_is_refused_with_the_way_out(interrupted, part):
    content = interrupted.read_bytes()
    interrupted.write_bytes(content[: int(part * len(content))])
    with pytest.raises(DatasetError, match=r"kept\.npz is damaged .* delete it and run snakemake"):
        run_long(PROBLEM, REST, interrupted)


def test_a_flipped_bit_in_a_checkpoint_is_refused_or_changes_nothing(interrupted):
    content, kept = interrupted.read_bytes(), active_sites.describe_run(PROBLEM, REST)
    whole = active_sites.recall_checkpoint(interrupted, kept)
    for bit in random.Random(0).sample(range(8 * len(content)), 200):
        changed = bytearray(content)
        changed[bit // 8] ^= 1 << bit % 8
        interrupted.write_bytes(changed)
        try:
            found = active_sites.recall_checkpoint(interrupted, kept)
        except DatasetError:
            continue
        for name in (*SERIES, "state"):
            np.testing.assert_array_equal(found[name], whole[name])


def test_series_are_at_every_output_once():
    run = run_long(PROBLEM.changed(end_time=6.0), REST)
    np.testing.assert_array_equal(run.tau, 0.25 * np.arange(25))
    assert run.l2.shape == run.linf.shape == run.energy.shape == (25,)
    assert run.front.shape == (3, 4) and (np.diff(run.front[-1]) <= 0).all()
    assert run.l2[0] == pytest.approx(np.hypot(1.0, 0.1)) and run.linf[0] == 1.0


def test_members_differ_by_little_and_are_the_same_every_time():
    drawn = ((1e-6, 2017, 1), (1e-6, 2017, 1), (1e-6, 2017, 2), (1e-6, 1, 1), (1e-3, 2017, 1))
    first, again, second, other, larger = (member(PROBLEM, *one).initial for one in drawn)
    assert member(PROBLEM, 1e-6, 2017, 0) is PROBLEM
    np.testing.assert_array_equal(first, again)
    assert (first != second).all() and (other != first).all()
    np.testing.assert_allclose(larger - PROBLEM.initial, 1e3 * (first - PROBLEM.initial), rtol=1e-8)
    assert first[0, 0] == pytest.approx(1.0, rel=1e-5)


def test_chaos_makes_of_members_different_runs():
    one, other = (run_long(member(PROBLEM, 1e-6, 2017, n), REST) for n in (0, 1))
    apart = np.abs(one.l2 / other.l2 - 1.0)
    assert apart[:8].max() < 1e-3 < apart.max()
    assert one.front[-1, 0] == pytest.approx(other.front[-1, 0], abs=0.01)


def test_a_map_has_the_maxima_of_each_chain_and_runs_the_longest_one_from_the_start(monkeypatch):
    done = count_pieces(monkeypatch)
    short, ends = PROBLEM.changed(end_time=20.0), np.array([12.0, 20.0])
    (short_l2, long_l2, longest_l2), linf = window_map(short, REST, [4, 300, 2000], ends)
    assert len(done) == 10 + 1  # the shortest cannot grow, and needs no pieces
    assert np.array_equal(long_l2, longest_l2) and linf.shape == (3, 2)
    assert (long_l2 > short_l2).all() and (np.diff([short_l2, long_l2], axis=1) >= 0).all()


def test_chains_that_share_their_first_pieces_have_the_norms_of_each_run_alone(monkeypatch):
    done = count_pieces(monkeypatch)
    tight = {"name": "dop853", "rtol": 1e-13, "atol": 1e-13}
    changes = {"half_width": None, "end_time": 40.0, "output_step": 0.5, "solver": tight}
    problem = problem_of("fig3_small", **changes)
    widths = [10, 64, 70, 100, 2000]
    found = run_chains(problem, REST, widths)
    assert len(done) < 20 + 10
    for half_width, (tau, l2, linf) in zip(widths, found, strict=True):
        alone = run_long(problem.changed(half_width=half_width), REST)
        np.testing.assert_array_equal(tau, alone.tau)
        np.testing.assert_allclose(l2, alone.l2, rtol=1e-11)
        np.testing.assert_allclose(linf, alone.linf, atol=1e-11)
    assert np.abs(found[0][1] - found[-1][1]).max() > 1e-3


def test_maxima_start_at_ten_and_include_the_end():
    tau = np.arange(0.0, 20.5, 0.5)
    series = np.where(tau < 10, 99.0, tau)
    np.testing.assert_array_equal(maxima(tau, series, np.array([12.0, 15.5])), [12.0, 15.5])


def test_a_tolerance_of_1e_6_is_enough_for_the_sea():
    """Other tolerances make other trajectories of the same power, and the same front."""
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
