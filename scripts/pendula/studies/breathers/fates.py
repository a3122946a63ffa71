"""What becomes of data on one pair: they disperse, stay as a breather, move away, or spread.

The four fates are told apart by the end of a run on an even chain, without a number to choose:

- one pair, or a pair and its mirror image, holds more than half of P: the central one, then the
  motion ends as a *breather*, or another one, then it *moves*;
- no pair does, and P is no larger than linear waves could have made it: it *disperses*;
- no pair does, and P is larger: it *spreads*, and the drive feeds the sea that fills the chain.

Linear waves of A - B at the detuning kappa = Omega - 4 epsilon sin^2(k / 2) conserve
(kappa + 2 gamma) q^2 + (kappa - 2 gamma) p^2 up to signs, so that their P grows at most by the
factor (|kappa| + 2 gamma) / (|kappa| - 2 gamma); waves of A + B keep theirs. Where zero is unstable
no wave has a bound, and all growth counts.
"""

import numpy as np

from pendula.problem import Constants, Problem
from pendula.simulation.simulate import Trajectory, simulate

FATES = ("disperses", "breather", "moves", "spreads")
DISPERSES, BREATHER, MOVES, SPREADS = range(len(FATES))
MAJORITY = 0.5
ROUNDING = 1e-6
"""By how much a run may miss the conservation of P where it holds."""


def largest_linear_gain(constants: Constants) -> float:
    """Return by how much linear waves can multiply P: 1 where zero is unstable, see above."""
    ends = np.array([constants.omega - 4.0 * constants.epsilon, constants.omega])
    least = 0.0 if ends[0] * ends[1] <= 0.0 else np.abs(ends).min()
    drive = 2.0 * abs(constants.gamma)
    return float((least + drive) / (least - drive)) if least > drive else 1.0


def folded_power(modulus: np.ndarray) -> np.ndarray:
    """Return P of each pair and its mirror image, (distance from the centre,).

    `modulus` is (component, site) on an odd number of sites.
    """
    power = (modulus**2).sum(axis=0)
    centre = len(power) // 2
    folded = power[centre:].copy()
    folded[1:] += power[:centre][::-1]
    return folded


def fate_of(modulus: np.ndarray, initial_power: float, gain: float) -> int:
    """Return the fate that the moduli (component, site) at the end of a run show."""
    power = folded_power(modulus)
    strongest = int(power.argmax())
    if power[strongest] > MAJORITY * power.sum():
        return MOVES if strongest else BREATHER
    return SPREADS if power.sum() > gain * (1.0 + ROUNDING) * initial_power else DISPERSES


def at_the_end(run: Trajectory) -> np.ndarray:
    """Return the moduli of a run at its end time, (component, site)."""
    return np.sqrt(run.final.real**2 + run.final.imag**2)


def fate(problem: Problem) -> tuple[int, Trajectory]:
    """Return the fate of the data of a problem, and the run that shows it."""
    run = simulate(problem)
    initial_power = float(np.sum(problem.initial.real**2 + problem.initial.imag**2))
    return fate_of(at_the_end(run), initial_power, largest_linear_gain(problem.constants)), run


def map_of_fates(problem: Problem, amplitudes: np.ndarray) -> np.ndarray:
    """Return the fate of each (A_0, B_0) from a list of amplitudes for both, (A_0, B_0).

    Exchanging A and B changes no fate, so that one half mirrors the other.
    """
    fates = np.empty(2 * [len(amplitudes)], dtype=np.int8)
    for i, a in enumerate(amplitudes):
        for j, b in enumerate(amplitudes[: i + 1]):
            fates[i, j] = fate(problem.changed(initial=np.array([[a], [b]], complex)))[0]
            fates[j, i] = fates[i, j]
    return fates
