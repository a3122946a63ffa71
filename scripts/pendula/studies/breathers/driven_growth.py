"""How the drive feeds a localised motion: the law of weak drives, and where it ends.

Let A_n = a_n exp(-i lambda tau), B = 0 be a breather of the chain without drive, real and even in
n. To first order in gamma the drive acts on B by gamma conj A, at the frequency -lambda. B_n = b_n
exp(i lambda tau) obeys

    epsilon (b_{n+1} - 2 b_n + b_{n-1}) + (Omega + lambda) b_n = -gamma a_n.

If lambda + Omega = 4 epsilon sin^2(k / 2) with 0 < k < pi, -lambda is the frequency of a linear
wave of wave number k, and B is radiated: outgoing waves have the amplitude

    |b| = gamma |sum_n a_n cos(k n)| / (2 epsilon sin k)

on both sides and travel at 2 epsilon sin k, so that

    dP_B / dtau = gamma^2 (sum_n a_n cos(k n))^2 / (epsilon sin k).                          (G)

P_A gains as much: the term of the drive that joins A and B changes P_A and P_B alike, by
2 gamma Im sum conj A_n conj B_n, since it makes quanta in pairs, one at lambda and one at -lambda.
The breather grows, lambda rises with P_A, and this ends where lambda leaves the band, at |Omega| +
4 epsilon for Omega < 0. A's own image radiates too, but |a_0|^2 keeps it away from the centre: its
rate is that of `own_radiation`, less than a hundredth of (G).
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import Contents
from pendula.numerics.elementary import complex_of, interpolated
from pendula.problem import Constants, output_times
from pendula.simulation.simulate import simulate

from .contents import kept
from .periodic import DECIMALS, problem_from, shoot, single_site, unfolded
from .steady import power, second_difference


class FreeBreather(NamedTuple):
    """A breather of A alone without drive: its frequency, profile on the sites 0..M, and P."""

    frequency: float
    profile: np.ndarray
    power: float


def free_breathers(constants: Constants, frequencies, half_width: int) -> list[FreeBreather]:
    """Return the breathers of A alone for gamma = 0 at rising frequencies.

    A and B are uncoupled there, so that A is that of A = B, which is found sooner.
    """
    free = Constants(epsilon=constants.epsilon, gamma=0.0, omega=constants.omega)
    falling = sorted(frequencies, reverse=True)
    found, data = [], single_site(free, falling[0], "A = B", half_width)
    for frequency in falling:
        data = shoot(free, frequency, data).data
        portable = np.round(data, DECIMALS)
        found.append(FreeBreather(frequency, portable[0], float(power(portable)[0])))
    return found[::-1]


def edge(constants: Constants) -> float:
    """Return the frequency with which a breather leaves the band of waves, for Omega < 0."""
    return 4.0 * constants.epsilon - constants.omega


def wave(constants: Constants, frequency: float) -> tuple[float, float] | None:
    """Return cos k and sin k of the linear wave at -lambda, or None where there is none."""
    share = (frequency + constants.omega) / (4.0 * constants.epsilon)  # the square of sin(k / 2)
    if not 0.0 < share < 1.0:
        return None
    return 1.0 - 2.0 * share, 2.0 * float(np.sqrt(share * (1.0 - share)))


def rate(constants: Constants, breather: FreeBreather) -> float:
    """Return the right side of (G); zero outside the band."""
    found = wave(constants, breather.frequency)
    if found is None:
        return 0.0
    cosine, sine = found
    source, before, here = breather.profile[0], cosine, 1.0  # cos(-k) and cos(0)
    for amplitude in breather.profile[1:]:
        before, here = here, 2.0 * cosine * here - before
        source += 2.0 * amplitude * here
    return float(constants.gamma**2 * source**2 / (constants.epsilon * sine))


def own_radiation(constants: Constants, breather: FreeBreather) -> float:
    """Return the rate at which A radiates its own image, in the potential of the breather."""
    found = wave(constants, breather.frequency)
    if found is None:
        return 0.0
    cosine, sine = found
    a = breather.profile
    matrix = constants.epsilon * second_difference(a.size).astype(complex)
    matrix += np.diag(constants.omega + breather.frequency + a * a)
    matrix[-1, -1] += constants.epsilon * complex_of(cosine, -sine)  # outgoing at the last site
    last = np.linalg.solve(matrix, constants.gamma * a.astype(complex))[-1]
    return float(4.0 * constants.epsilon * sine * (last.real**2 + last.imag**2))


def predicted(
    constants: Constants, family: list[FreeBreather], start: int, times: np.ndarray
) -> np.ndarray:
    """Return P of the breather by the law (G) at `times`, from the member `start` of a family.

    The frequency follows from P along the free family. Since dtau = dP / rate(P), time is a sum
    over the family. It ends with the last member, at the edge of the band, where sin k = 0 in (G)
    and dtau / dP vanishes; from there on P stays.
    """
    slowness = np.append([1.0 / rate(constants, one) for one in family[start:-1]], 0.0)
    passed = np.array([one.power for one in family[start:]])
    spans = np.diff(passed) * 0.5 * (slowness[1:] + slowness[:-1])
    return interpolated(times, np.append(0.0, np.cumsum(spans)), passed)


def gained(
    constants: Constants, breather: FreeBreather, half_width: int, times: np.ndarray,
    tolerance: float,
) -> np.ndarray:  # fmt: skip
    """Return the sum of |B_n|^2 at equally spaced `times`, (time,).

    The drive is switched on at tau = 0 on a breather of the chain without drive, whose B is zero.
    """
    data = unfolded(np.stack([breather.profile, np.zeros_like(breather.profile)]))
    end, step = float(times[-1]), float(times[1])
    return simulate(problem_from(constants, data, end, step, tolerance, half_width)).l2[1] ** 2


def growth_contents(
    epsilon: float, omega: float, end_times: Mapping[float, float], frequencies: Sequence[float],
    start: float, half_widths: Mapping[str, int], outputs: int, tolerance: float,
) -> Contents:  # fmt: skip
    """Return what a free breather gains from each drive, by runs and by the law of weak drives.

    The law is summed over breathers at `frequencies` up to the edge of the band of waves.
    `end_times` is by gamma; `half_widths` those of the `profile` and the `chain`.
    """
    free = Constants(epsilon=epsilon, gamma=1.0, omega=omega)
    inside = [frequency for frequency in frequencies if frequency < edge(free)]
    family = free_breathers(free, [*inside, edge(free)], half_widths["profile"])
    first = int(np.argmin([abs(one.frequency - start) for one in family]))
    times, runs, laws = [], [], []
    for gamma, end in end_times.items():
        constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
        times.append(output_times(end, end / outputs))
        runs.append(gained(constants, family[first], half_widths["chain"], times[-1], tolerance))
        law = predicted(constants, family, first, times[-1])
        laws.append(law - law[0])
    grid, over = ("gamma", "output"), ("frequency",)
    rates, own = ([of(free, one) for one in family] for of in (rate, own_radiation))
    variables = {
        "gamma": Variable(("gamma",), np.array(list(end_times))),
        "time": Variable(grid, np.array(times), "slow time of the run with this gamma"),
        "gained": Variable(grid, np.array(runs), "sum of |B|^2, which the breather gains as well"),
        "predicted_gain": kept(grid, laws, "the same by the law of weak drives", 9),
        "frequency": Variable(
            over, [one.frequency for one in family], "frequency lambda of the breather"
        ),
        "free_power": kept(over, [one.power for one in family], "P of the breather without drive"),
        "predicted_rate": kept(over, rates, "rate of growth of P by the law, over gamma^2", 9),
        "own_rate": kept(over, own, "rate at which A radiates its own image, over gamma^2", 9),
    }
    about = {"epsilon": epsilon, "omega": omega, "start_frequency": start, "tolerance": tolerance}
    return variables, {"title": "How the drive feeds a localised motion", **about}
