"""Whether a run that stays at one pair is a periodic breather, and of which family.

A periodic breather of `periodic` has A and B real twice in a period, with opposite signs. So a run
is continued beyond its end, and its crossings of a Poincare section are recorded: the instants at
which the larger one of A_0 and B_0, the leading one, is real. With the instants tau_0, ..., tau_K
of K half periods,

    lambda = pi K / (tau_K - tau_0),
    distance = max over k of |(A_0, B_0)(tau_k) - +-(a, b)| / |(a, b)|,

where (a, b) is the pair at the centre of the family's breather of this frequency, and +- the sign
of the leading one. The distance of a breather from its own family is zero but for interpolation,
and grows with all that the run has besides: other phases of the other one, other frequencies.
Exchanging A and B changes no equation: where B leads, a run is compared with (b, a).

The motion is periodic if the pair returns to one point of the section at each instant, but for the
waves that are left on the chain. With z_k = +-(A_0, B_0)(tau_k) and its mean over k

    P that does not return = mean over k of |z_k - mean z|^2,

and a pair outside the centre has P = w^2 on average. Waves that are even in n have an antinode at
the centre, and so twice w^2 there; the few tau of K half periods give their P within a factor of
two. A second frequency is therefore seen where more than 4 w^2 do not return.
"""

from typing import NamedTuple

import numpy as np
import xarray as xr

from pendula.integrators import DONE
from pendula.problem import Problem
from pendula.simulation.lattice import find_reduction, pack
from pendula.simulation.models import make_chain
from pendula.simulation.observables import blank_record
from pendula.simulation.solvers import SOLVERS

HALF_PERIODS = 24
STRIDE = np.pi / 6.0
"""The phase that one run covers on the way to the next instant at which the amplitude is real."""
LARGEST_TANGENT = 1.2
"""Once the tangent of the phase is smaller, the phase that is left is known."""
MOST_STRIDES = 20
"""A leading amplitude that is not real again after so many steps does not rotate."""
SLOWEST = 0.5
"""Least frequency that a step is made for."""


class Crossings(NamedTuple):
    """The pair at the centre at its crossings, with the leading amplitude real and positive."""

    frequency: float
    pairs: np.ndarray  # (instant, 2), complex: the leading amplitude and the other one


class Follower:
    """Short runs one after another from a state: their arrays would take longer than they do."""

    def __init__(self, problem: Problem, state: np.ndarray, stop: np.ndarray):
        """Start from `state`, complex (2, 2M + 1); the flag `stop` ends each run."""
        reduction = find_reduction(state)
        self._y, self._stop = pack(state, reduction), stop
        self._run, controls = SOLVERS[problem.solver["name"]], problem.solver
        self._chain = make_chain(problem.constants, problem.boundary, reduction)
        self._controls = tuple(float(controls[name]) for name in self._run.controls)
        self._work = self._run.room_for(self._chain, self._y)
        rows, columns = self._y.shape
        self._record = blank_record(rows // 2, columns - 2, 2, 0)
        self._centre = 1 if reduction.even else 1 + state.shape[1] // 2
        self.time = 0.0

    def integrate_for(self, duration: float) -> bool:
        """Integrate the state over `duration`; return whether the solver could."""
        given = np.array([0.0, duration]), self._controls, self._work, self._record
        self.time += duration
        return self._run.run(self._chain, self._y, *given, self._stop).status == DONE

    def pair(self) -> np.ndarray:
        """Return A and B of the pair at the centre."""
        y = self._y[:, self._centre]
        pair = y[::2] + 1j * y[1::2]
        return pair if len(pair) == 2 else np.repeat(pair, 2)


def crossings(follower: Follower, frequency: float) -> Crossings | None:
    """Return the next crossings of HALF_PERIODS half periods, or None where there are not so many.

    `frequency` is a guess. The amplitudes turn as exp(-i lambda tau), so that the phase of the
    leading one falls; its signs at the instants must alternate.
    """
    pair = follower.pair()
    lead = int(np.argmax(pair.real**2 + pair.imag**2))
    times, pairs = [], []
    for _ in range(HALF_PERIODS + 1):
        rate = frequency if len(times) < 2 else np.pi / (times[-1] - times[-2])
        if not _reach_crossing(follower, lead, max(rate, SLOWEST)):
            return None
        times.append(follower.time)
        pairs.append(follower.pair()[[lead, 1 - lead]])
    signs = np.sign([pair[0].real for pair in pairs])
    if (signs[1:] == signs[:-1]).any():
        return None
    return Crossings(
        np.pi * HALF_PERIODS / (times[-1] - times[0]), signs[:, None] * np.array(pairs)
    )


def _reach_crossing(follower: Follower, lead: int, rate: float) -> bool:
    """Integrate until the leading amplitude is real again; return whether that happened."""
    for _ in range(MOST_STRIDES):
        if not follower.integrate_for(STRIDE / rate):
            return False
        left = _phase_left(follower.pair()[lead])
        if left is not None:
            break
    else:
        return False
    for fraction in (0.9, 1.0):  # the first step measures the rate, the second one uses it
        before, duration = left, fraction * left / rate
        if not follower.integrate_for(duration):
            return False
        left = _phase_left(follower.pair()[lead])
        if left is None:
            return True  # just beyond
        rate = max(SLOWEST, (before - left) / duration)
    return True


def _phase_left(z: complex) -> float | None:
    """Return by how much the phase of `z` must fall until it is real, to 3 %, if that is little."""
    if not 0.0 < z.imag * z.real < LARGEST_TANGENT * z.real * z.real:
        return None
    tangent = z.imag / z.real
    return tangent / (1.0 + 0.28 * tangent * tangent)


WAVES = 4.0
"""P at the centre that waves explain, over the mean P of a pair outside, see the module's text."""
INSTANTS = 0.01
"""Relative error of a pair that stems from its instants, which are not exact."""


def unreturned(found: Crossings, waves: float) -> float:
    """Return P that does not return after half periods, over the most that `waves` explain.

    `waves` is the mean P of a pair outside the centre. Where this is at most 1, the motion is
    periodic.
    """
    mean = found.pairs.mean(axis=0)
    off = found.pairs - mean
    left, whole = ((one.real**2 + one.imag**2).sum(axis=-1).mean() for one in (off, mean))
    return float(left / (WAVES * waves + INSTANTS**2 * whole))


# --- Families -------------------------------------------------------------------------------------

NODES = 4
"""Breathers are interpolated between so many known frequencies, or all if there are fewer."""
BEYOND = 2.0
"""Over the highest known frequency. Far above the bands a family depends on 1 / lambda smoothly."""


class Families(NamedTuple):
    """Pairs of real amplitudes at the centre of breathers at one detuning, by their frequency."""

    names: list[str]
    frequencies: np.ndarray  # (frequency,), rising
    pairs: np.ndarray  # (component, family, frequency), NaN where a family does not exist

    @classmethod
    def of(cls, periodic: xr.Dataset, omega: float) -> "Families":
        """Return those of the dataset of periodic breathers; none at another detuning."""
        names = [str(name) for name in periodic["family"].values]
        if omega not in periodic["omega"].values:
            return cls(names, np.empty(0), np.empty((2, len(names), 0)))
        here = periodic.sel(omega=omega, part="re").sortby("frequency")
        pairs = here["amplitude"].transpose("component", "family", "frequency").values
        return cls(names, here["frequency"].values, pairs)

    def at(self, frequency: float) -> np.ndarray:
        """Return (family, component), NaN below and far above the frequencies of a family.

        The ratio of both amplitudes and |A_0|^2 / lambda are interpolated in 1 / lambda: to a
        hundredth, but for lambda below 9 at Omega = 8, where A alone turns into A = B: a tenth.
        """
        found = np.full((len(self.names), 2), np.nan)
        for i in range(len(self.names)):
            known = np.isfinite(self.pairs[0, i])
            frequencies = self.frequencies[known]
            if not known.any() or not frequencies[0] <= frequency <= BEYOND * frequencies[-1]:
                continue
            around = np.sort(np.argsort(np.abs(1.0 / frequencies - 1.0 / frequency))[:NODES])
            x, (a, b) = 1.0 / frequencies[around], self.pairs[:, i, known][:, around]
            own = np.eye(len(x), dtype=bool)
            ratios = np.where(own, 1.0, (1.0 / frequency - x) / (x[:, None] - x + own))
            lagrange = ratios.prod(axis=1)
            ratio, square = np.sum(lagrange * [b / a, a * a * x], axis=1)
            found[i] = np.sqrt(square * frequency) * np.array([1.0, ratio])
        return found


SHAPES = {"A only": (1.0, 0.0), "A = -B": (0.5**0.5, -(0.5**0.5)), "A = B": (0.5**0.5, 0.5**0.5)}
"""The direction of (a, b) that the symmetry of a family gives: exactly but where A leads."""


def family_of_shape(found: Crossings, names: list[str]) -> int:
    """Return the index of the family whose direction the mean pair is nearest to."""
    mean = found.pairs.mean(axis=0).real
    return int(np.argmax([(mean * SHAPES[name]).sum() for name in names]))


NEAR = 0.1
"""A breather that is no further than this from a periodic one looks like it in a figure."""


def distances(found: Crossings, families: Families) -> np.ndarray:
    """Return the distance from each family, see the module's text: (family,), NaN where none is."""
    wanted = families.at(found.frequency)[:, None]
    off = found.pairs - wanted
    squares = (off.real**2 + off.imag**2).sum(axis=-1).max(axis=-1)
    return np.sqrt(squares / (wanted**2).sum(axis=-1)[:, 0])
