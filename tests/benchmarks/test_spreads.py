"""The measurement of spreads: against laws whose spreads are known, and on made-up runs."""

import numpy as np
import pytest
import xarray as xr
from pendula.datasets.netcdf import read, save
from pendula.figure_diff.structure import COUNTS, DISTANCES, STATISTICS
from pendula.figure_diff.tolerances import Rule

from benchmarks import spreads
from benchmarks.reproduction import ROOT
from benchmarks.spreads import Measured

RUNS = 10
TAU = np.linspace(0, 50, 2001)
CHAOS = Rule(name="chaos", labels=["*:l2*"], method="chaotic", reason="The run is chaotic.")


def made_up(seed: int, horizon: float = 9.0, factor: float = 1.0) -> xr.Dataset:
    """Return two smooth random curves about 5 that part from each other after the horizon."""
    rng = np.random.default_rng(seed)
    window = np.hanning(41) / np.linalg.norm(np.hanning(41))
    wobble = [np.convolve(rng.normal(size=TAU.size + 40), window, "valid") for _ in range(2)]
    known, parted = 5 + 0.6 * np.sin(3 * TAU), np.clip(TAU - horizon, 0, 1)
    beyond = factor * (known + parted * (0.6 * np.array(wobble) - 0.6 * np.sin(3 * TAU)))
    norms = np.where(horizon >= TAU, known, beyond)
    about = {"long_name": "l2 norm", "units": "1"}
    return xr.Dataset(
        {"l2": (("component", "tau"), norms, about)}, {"component": ["A", "B"], "tau": TAU}
    )


@pytest.fixture(scope="module")
def members(tmp_path_factory):
    folder = tmp_path_factory.mktemp("members")
    for seed in range(RUNS):
        for name in ("runs.nc", "copies.nc"):
            save(folder / str(seed) / name, made_up(seed))
    return [folder / str(seed) for seed in range(RUNS)]


@pytest.fixture(scope="module")
def measured(members):
    return spreads.measure(members, ["copies.nc", "runs.nc"], [CHAOS, spreads.REGULAR])


def column(name: str) -> int:
    return list(STATISTICS).index(name)


def test_epsilon_is_moved_in_one_line_of_the_project():
    name, old = spreads.MOVED_LINE
    assert (ROOT / name).read_text().count(old) == 1


def test_the_horizon_is_where_the_first_two_runs_part(measured):
    assert {each.label for each in measured} == {
        f"{file}:l2 {words}"
        for file in ("runs", "copies")
        for words in ("component=A", "component=B", "all curves together")
    }
    one = measured[0]
    assert one.horizon == pytest.approx(9.0) and one.scale == pytest.approx(5.0, rel=0.02)


def test_the_spread_of_a_mean_is_that_of_its_law(measured, tmp_path):
    """A sample wobbles by 0.6, and about 28 samples are one independent number."""
    spreads.write(tmp_path / "spreads.nc", measured, spreads.accusations(measured))
    data = read(tmp_path / "spreads.nc")
    level = data["spread"].values[:2, column("level")] * data["scale"].values[:2]
    window = np.hanning(41) / np.linalg.norm(np.hanning(41))
    expected = 0.6 * window.sum() / np.sqrt((TAU > 9).sum())
    assert level == pytest.approx(expected, rel=0.5)
    assert (data["freedom"].values[:2, column("level")] >= RUNS - 1).all()


def test_curves_that_are_the_same_in_all_runs_are_copies(measured):
    following = dict(zip([m.label for m in measured], spreads.copies(measured), strict=True))
    assert following["runs:l2 component=A"] == "copies:l2 component=A"
    assert following["copies:l2 component=A"] == "runs:l2 component=A"
    assert following["runs:l2 all curves together"] == ""


def test_right_runs_pass_and_a_wrong_one_is_accused(members, measured, tmp_path):
    said = list(spreads.in_words(measured, spreads.accusations(measured)))
    assert said == [f"0 of {RUNS} pairs of right runs would be accused without the widening"]
    save(tmp_path / "runs.nc", made_up(seed=77, factor=1.09))
    wrong = spreads.measure([*members, tmp_path], ["runs.nc"], [CHAOS, spreads.REGULAR])
    said = list(spreads.in_words(wrong, spreads.accusations(wrong)))
    assert said[-1].startswith("2 of ") and any("jump" in line for line in said)


def test_a_statistic_that_accused_a_right_run_is_widened_for_its_group(measured):
    excess = np.zeros((RUNS, len(measured), len(STATISTICS) + len(DISTANCES)))
    excess[3, 0, column("level")] = 1.7
    factors = spreads.widening(measured, excess)
    group = [each.group == measured[0].group for each in measured]
    assert factors[:, column("level")].tolist() == [1.7 if same else 1.0 for same in group]
    assert (np.delete(factors, column("level"), 1) == 1).all() and not all(group)


def test_a_curve_that_moves_without_a_rule_is_named(members, capsys):
    assert spreads.measure(members, ["runs.nc"], [spreads.REGULAR]) == []
    assert "moves without a rule: runs:l2 component=A" in capsys.readouterr().out


def drawn(sizes: np.ndarray, runs: int = RUNS, widest: bool = False) -> list[Measured]:
    """Return curves with normal statistics of these standard deviations."""
    rng = np.random.default_rng(1)
    told = rng.normal(size=(sizes.size, runs, len(STATISTICS))) * sizes[:, None, None]
    told[..., [column(name) for name in COUNTS]] = 0
    apart = np.full((runs, runs, len(DISTANCES)), np.nan)
    return [Measured(f"m:x n={i}", ("r", "x"), 1, -1, t, apart, widest) for i, t in enumerate(told)]


def pooled(curves: list[Measured]) -> tuple[np.ndarray, np.ndarray]:
    spread = np.array([each.told.std(0, ddof=1) for each in curves])
    found, freedom = spreads.pooled(curves, spread, RUNS - 1)
    return found[:, column("level")], freedom[:, column("level")]


def test_alike_curves_share_one_spread_with_more_freedom():
    found, freedom = pooled(drawn(np.full(100, 0.3)))
    assert found == pytest.approx(0.3, rel=0.15) and (freedom > 50).all()


def test_unlike_curves_keep_their_own_spread():
    sizes = np.geomspace(1e-3, 10, 60)
    found, freedom = pooled(drawn(sizes))
    loud = sizes > 0.3
    assert np.median(abs(np.log(found / sizes))[loud]) < 0.3 and (freedom < 15).all()


def test_no_curve_has_a_spread_far_below_its_group():
    """A largest value that was reached before the runs parted, in all runs but the next one."""
    sizes = np.full(40, 0.3)
    sizes[7] = 0.0
    assert pooled(drawn(sizes))[0][7] > 0.1


def test_the_widest_spread_holds_for_all_where_the_table_says_so():
    found, _ = pooled(drawn(np.geomspace(0.01, 1, 20), widest=True))
    assert np.ptp(found) == 0 and found[0] > 0.5


def test_the_prior_finds_the_law_that_variances_were_drawn_from():
    """Variances from a scaled inverse chi-square law with 8 degrees of freedom about 0.25."""
    rng = np.random.default_rng(2)
    true = 0.25 * 8 / rng.chisquare(8, size=4000)
    seen = true * rng.chisquare(RUNS - 1, size=4000) / (RUNS - 1)
    typical, freedom = spreads._prior(np.log(seen), RUNS - 1)
    assert typical == pytest.approx(0.25, rel=0.05) and freedom == pytest.approx(8, rel=0.2)
