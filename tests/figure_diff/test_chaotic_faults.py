"""Faults in chaotic data, planted into a right run that takes another path than the accepted one.

`two_runs` holds parts of two whole reproductions as the baseline keeps them: 1 is the accepted one,
and in 2 epsilon was moved by 3e-15 of itself. Run 2 passes as it is; each line of FAULTS names what
is done to it, and the comparison has to refuse it by what was measured (tests/baseline/spreads.nc).
"""

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from pendula.figure_diff import DIFFERENT, NEARLY, Finding, compare_curves, hashes
from pendula.figure_diff.tolerances import TOLERANCES, read_tolerances

RUNS = Path(__file__).parent / "two_runs"
NAMES = sorted(p.relative_to(RUNS / "1").as_posix() for p in (RUNS / "1").rglob("*.nc"))
BASELINE = Path(__file__).resolve().parents[1] / "baseline"

FIG3, FIG4 = "trajectories/fig3_large.nc", "trajectories/fig4_small.nc"


@cache
def run(number: int, name: str):
    """Return a dataset of one of the two runs; it must not be changed."""
    return hashes.as_dataset(hashes.read(RUNS / str(number) / name))


@cache
def tolerances():
    assert (BASELINE / TOLERANCES).exists()
    return read_tolerances(BASELINE)


def compare(name: str, plant: Callable, made_too: Callable | None = None) -> Finding:
    """Compare run 2, with a fault, with run 1."""
    made = plant(run(2, name).copy(deep=True))
    return compare_curves.compare(name, run(1, name), made, tolerances(), made_too)


class Fault(NamedTuple):
    """What is wrong, in which file, what the finding must name, and how it is planted."""

    name: str
    file: str
    where: str
    plant: Callable


def values(change: Callable, *names: str) -> Callable:
    """Return a plant: `change` takes the array of each variable and returns another."""

    def plant(data):
        for name in names:
            data[name] = (data[name].dims, change(data[name].values), data[name].attrs)
        return data

    return plant


def tails(change: Callable, after: float, *names: str) -> Callable:
    """Return a plant: `change` takes the arrays (..., tau) after this time and returns others."""

    def plant(data):
        beyond = data["tau"].values > after
        for name in names or ("l2", "linf"):
            assert data[name].dims[-1] == "tau"
            data[name].values[..., beyond] = change(data[name].values[..., beyond])
        return data

    return plant


def times(factor: float) -> Callable:
    return lambda array: factor * array


def reverse(array: np.ndarray) -> np.ndarray:
    """Turn the last dimension round."""
    return array[..., ::-1]


def shift(array: np.ndarray) -> np.ndarray:
    """Move all by one along the last dimension."""
    return np.roll(array, 1, -1)


def exchange(array: np.ndarray) -> np.ndarray:
    """Turn the first dimension round: the two components, or the two sizes of the data."""
    return array[::-1]


def noise(array: np.ndarray) -> np.ndarray:
    """Return noise with the mean and the standard deviation of each curve."""
    drawn = np.random.default_rng(5).normal(size=array.shape)
    return array.mean(-1, keepdims=True) + array.std(-1, keepdims=True) * drawn


def dead(array: np.ndarray) -> np.ndarray:
    """Return each curve as the constant with which it starts."""
    return np.broadcast_to(array[..., :1], array.shape)


def smooth(array: np.ndarray) -> np.ndarray:
    """Return the mean of each sample and its eight neighbours."""
    return np.mean([np.roll(array, k, -1) for k in range(-4, 5)], 0)


def delay(array: np.ndarray) -> np.ndarray:
    """Repeat the first unit of tau, 40 samples, and let all else come later."""
    return np.concatenate([array[..., :40], array[..., :-40]], -1)


def coarse(array: np.ndarray) -> np.ndarray:
    """Keep one decimal of a curve between 0 and about 10."""
    unit = 10.0 ** np.ceil(np.log10(array.max()) - 1)
    return unit * np.round(array / unit, 1)


def stretch(array: np.ndarray) -> np.ndarray:
    """Let time run at half of its speed."""
    return np.repeat(array, 2, -1)[..., : array.shape[-1]]


def spike(array: np.ndarray) -> np.ndarray:
    """Raise one sample to ten times its value."""
    array[..., 301] *= 10
    return array


def gap(array: np.ndarray) -> np.ndarray:
    """Lose one sample."""
    array[..., 301] = np.nan
    return array


def turn_infinities(array: np.ndarray) -> np.ndarray:
    assert np.isinf(array).any()
    return np.where(np.isinf(array), -array, array)


def right(change: Callable) -> Callable:
    """Return the change of the right panel alone, the last of the first dimension."""

    def one(array):
        array[-1] = change(array[-1])
        return array

    return one


def of_tail(title: str, file: str, after: float, where: str = "") -> list[Fault]:
    """Return the faults of the tail of both norms of a trajectory."""
    changes = {
        "reversed in time": reverse,
        "replaced by noise": noise,
        "dead": dead,
        "smoothed": smooth,
        "delayed by 1": delay,
        "with one decimal": coarse,
        "at half speed": stretch,
        "with a spike": spike,
        "with a NaN": gap,
        "halved": times(0.5),
    }
    return [
        Fault(f"{title} {name}", file, where, tails(change, after))
        for name, change in changes.items()
    ]


FAULTS = [
    # Tails, from the horizon of trust on and from later on
    Fault("Fig 4 raised by 9 %", FIG4, "", tails(times(1.09), 8.0)),
    Fault("Fig 4 raised by 9 %, late", FIG4, "l2", tails(times(1.09), 20.0)),
    Fault("Fig 4 lowered by 9 %, late", FIG4, "l2", tails(times(0.91), 20.0)),
    Fault("Fig 4, A and B exchanged late", FIG4, "l2", tails(exchange, 20.0)),
    *of_tail("Fig 4, late tail", FIG4, 20.0),
    Fault("Fig 3 raised by 45 %", FIG3, "", tails(times(1.45), 20.0)),
    Fault("Fig 3 raised by 45 %, late", FIG3, "", tails(times(1.45), 28.0)),
    Fault("Fig 3, A and B exchanged late", FIG3, "l2", tails(exchange, 28.0)),
    *of_tail("Fig 3, late tail", FIG3, 28.0),
    Fault("large and small of Fig 4", "figures/fig4.nc", "l2", values(exchange, "l2")),
    Fault("energy of Fig 4 off by 1 %", FIG4, "energy", values(times(1.01), "energy")),
    # Sweeps
    Fault("Fig 6 right times 1.4", "figures/fig6.nc", "right", values(right(times(1.4)), "l2")),
    Fault("its sweep times 1.4", "sweeps/fig6_right.nc", "l2", values(times(1.4), "l2")),
    Fault("Fig 5 right in reverse", "figures/fig5.nc", "right", values(right(reverse), "l2")),
    Fault("Fig 5 right by one M", "figures/fig5.nc", "l", values(right(shift), "l2", "linf")),
    Fault("its sweep in reverse", "sweeps/fig5_right.nc", "l2", values(reverse, "l2")),
    # Statistics of chaos
    Fault("exponents times 1.2", "checks/lyapunov.nc", "exponent", values(times(1.2), "exponent")),
    Fault("spectra times 1.2", "checks/lyapunov.nc", "exponents", values(times(1.2), "exponents")),
    Fault("spectra in reverse", "checks/lyapunov.nc", "exponents", values(reverse, "exponents")),
    Fault("lives halved", "checks/lifetimes.nc", "life", values(times(0.5), "life")),
    Fault("infinite lives", "checks/lifetimes.nc", "life", values(turn_infinities, "life")),
    Fault("survivors shifted", "checks/lifetimes.nc", "surviving", values(shift, "surviving")),
    Fault("median halved", "checks/lifetimes.nc", "median", values(times(0.5), "median")),
    Fault("odd parts grow faster", "figures/symmetry.nc", "rounded",
          values(lambda a: a * np.exp(np.linspace(0, 5, a.shape[-1])), "rounded")),
    Fault("horizons doubled", "checks/trust.nc", "horizon", values(times(2), "horizon")),
    Fault("band of Fig 3 by 15 %", "figures/fig3.nc", "band", values(times(1.15), "band_l2")),
    Fault("means of ensembles", "figures/ensembles.nc", "l2_mean", values(times(1.15), "l2_mean")),
    Fault("runs outside", "figures/ensembles.nc", "run_inside", values(times(0.3), "run_inside")),
    Fault("levels of members", "checks/members.nc", "l2_level", values(times(1.2), "l2_level")),
    # Chains without ends
    Fault("speed of the front", "figures/front.nc", "speed", values(times(1.5), "speed")),
    Fault("ways of the front", "figures/front.nc", "front", values(times(1.5), "front")),
    Fault("power behind the front", "figures/front.nc", "power", values(times(1.5), "mean_power")),
    Fault("growth law", "figures/growth_law.nc", "l2", values(times(0.45), "l2")),
    Fault("rates of the law", "figures/growth_law.nc", "l2_rate", values(times(0.45), "l2_rate")),
    Fault("its exponent", "figures/growth_law.nc", "exponent", values(times(0.45), "l2_exponent")),
    Fault("power of a chain", "checks/chain_growth.nc", "power", values(times(1.3), "late_power")),
]  # fmt: skip


@pytest.mark.parametrize("fault", FAULTS, ids=[fault.name for fault in FAULTS])
def test_a_fault_in_chaotic_data_is_found(fault):
    found = compare(fault.file, fault.plant)
    assert found.status == DIFFERENT and fault.where in found.says, found.line


@pytest.mark.parametrize("name", NAMES)
def test_another_right_run_passes(name):
    found = compare(name, lambda data: data, lambda other: run(2, other))
    assert found.status == NEARLY, found.line


def test_a_fault_below_chance_is_found_where_a_copy_shows_it():
    """A single norm that rises by 9 % at most is within chance, but the figure repeats the file."""
    rising = tails(lambda a: a * np.linspace(1, 1.09, a.shape[-1]), 20.0, "l2")
    name = "figures/fig4.nc"
    assert compare(name, rising).status == NEARLY
    found = compare(name, rising, lambda other: run(2, other))
    assert found.status == DIFFERENT
    assert "is not the same as trajectories/fig4_small:l2" in found.says
