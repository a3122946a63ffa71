"""The fate of initial conditions on one pair: they stay localised, move, disperse, or spread.

A motion is *localised* while more than half of P is on the central pair and the two pairs coupled
to it, the only ones that its motion drives directly.

The final state of a run on an even chain distinguishes the four fates without a free parameter:

- three neighbouring pairs, or three and their mirror images, have more than half of P: if these are
  the central ones, the motion is localised and *stays*, otherwise it *moves*;
- no three pairs do, and P is at most what linear waves can reach: the motion *disperses*;
- no three pairs do, and P is larger: the motion *spreads*, and the drive feeds the chaotic state
  that fills the chain.

One pair would not be enough, because breathers of small P and moving localised states are wider. On
61 pairs, dispersed waves and chaotic states have less than a third of P on any three pairs.

Linear waves A - B = p + i q at the detuning kappa = Omega - 4 epsilon sin^2(k / 2) conserve
(kappa + 2 gamma) q^2 + (kappa - 2 gamma) p^2, so their P grows at most by the factor
(|kappa| + 2 gamma) / (|kappa| - 2 gamma); waves of A + B conserve P. If zero is unstable, waves
have no bound, and any growth of P counts as spreading.
"""

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.stated import describe_run
from latticode.datasets.trajectories import Contents
from latticode.simulation.lattice import find_reduction, unpack
from latticode.simulation.runs import ManyRuns
from latticode.simulation.simulate import integrate
from latticode.simulation.survey import Survey, Surveyed
from replication.variables import FEW_CHOICES, chaotic_along

from pendula.problem import Constants, PaperProblem

FATES = ("disperses", "stays", "moves", "spreads")
DISPERSES, STAYS, MOVES, SPREADS = range(len(FATES))
MAJORITY = 0.5
ROUNDING = 1e-6
"""Largest relative error in P of a run that conserves P."""


def largest_linear_gain(constants: Constants) -> float:
    """Return the largest factor by which linear waves can multiply P, or 1 if zero is unstable."""
    ends = np.array([constants.omega - 4.0 * constants.epsilon, constants.omega])
    least = 0.0 if ends[0] * ends[1] <= 0.0 else np.abs(ends).min()
    drive = 2.0 * abs(constants.gamma)
    return float((least + drive) / (least - drive)) if least > drive else 1.0


def power_by_distance(state: np.ndarray) -> np.ndarray:
    """Return P of each pair plus its mirror image, (distance,), of a state (component, site)."""
    power = (state.real**2 + state.imag**2).sum(axis=0)
    centre = len(power) // 2
    folded = power[centre:].copy()
    folded[1:] += power[:centre][::-1]
    return folded


def share_of_three_pairs(power: np.ndarray) -> np.ndarray:
    """Return the share of P on three neighbouring pairs and their mirror images, (distance,).

    `power` is P by distance. The first entry is the share of the three central pairs, the second
    is the share of the five central pairs.
    """
    held = power.copy()
    held[1:] += power[:-1]
    held[:-1] += power[1:]
    return held / power.sum()


def is_localised(power: np.ndarray, majority: float = MAJORITY) -> bool:
    """Return whether a motion with this `power`, P by distance, is localised."""
    return bool(share_of_three_pairs(power)[0] > majority)


def place_of(power: np.ndarray, majority: float = MAJORITY) -> int | None:
    """Return the distance from the centre at which three pairs have most of P, or None.

    Three pairs at the distance 1 include the centre and do not count. `majority` is the share of P
    that counts as most, 0.5 by default.
    """
    if is_localised(power, majority):
        return 0
    held = share_of_three_pairs(power)
    if len(held) < 3:
        return None
    strongest = 2 + int(held[2:].argmax())
    return strongest if held[strongest] > majority else None


def fate_of(problem: PaperProblem, final: np.ndarray, majority: float = MAJORITY) -> int:
    """Return the fate, an index of FATES, of the final state (component, site) of a run."""
    power = power_by_distance(final)
    place = place_of(power, majority)
    if place is not None:
        return MOVES if place else STAYS
    initial = np.sum(problem.initial.real**2 + problem.initial.imag**2)
    most = largest_linear_gain(problem.constants) * (1.0 + ROUNDING) * initial
    return SPREADS if power.sum() > most else DISPERSES


def keep_fate(problem: PaperProblem, majority: float = MAJORITY) -> dict[str, int]:
    """Run a problem and return the fate of its initial data, the only stored result."""
    reduction = find_reduction(problem.amplitudes)
    _, y, _ = integrate(problem.equations, reduction)
    return {"fate": fate_of(problem, unpack(y, reduction), majority)}


# --- A map ----------------------------------------------------------------------------------------


def map_fates(
    problems: Mapping[float, PaperProblem],
    amplitudes: Sequence[float],
    majority: float = MAJORITY,
) -> ManyRuns:
    """Return the runs that map the fate of (A_0, B_0) on one pair, at the Omega of each problem.

    A_0 and B_0 take the values `amplitudes`. Exchanging A and B changes no fate, so only half of
    the map is run.
    """
    rows, columns = np.tril_indices(len(amplitudes))
    data = np.array(amplitudes)[np.stack([rows, columns], -1)]
    survey = Survey({"omega": list(problems), "initial.0.0, initial.0.1": data})
    (first, *_) = problems.values()
    runs = Surveyed(first.changed(initial=np.ones((2, 1))), survey)

    def conclude(retained: Mapping[str, np.ndarray]) -> Contents:
        return _map_contents(problems, amplitudes, retained["fate"].reshape(survey.shape))

    return ManyRuns(runs, partial(keep_fate, majority=majority), conclude)


def _map_contents(
    problems: Mapping[float, PaperProblem], amplitudes: Sequence[float], fates: np.ndarray
) -> Contents:
    """Return the dataset of the map, from the fates (omega, run) of one half of it."""
    rows, columns = np.tril_indices(len(amplitudes))
    (first, *_) = problems.values()
    mapped = np.empty((len(problems), *2 * [len(amplitudes)]), dtype=np.int8)
    mapped[:, rows, columns] = mapped[:, columns, rows] = fates
    flags = {"flag_values": np.arange(len(FATES), dtype=np.int8), "flag_meanings": " ".join(FATES)}
    flags |= chaotic_along("omega")
    variables = {
        "omega": Variable(("omega",), np.array(list(problems)), attributes=FEW_CHOICES),
        "a0": Variable(("a0",), amplitudes, "initial amplitude A_0 of the centre"),
        "b0": Variable(("b0",), amplitudes, "initial amplitude B_0 of the centre"),
        "fate": Variable(("omega", "a0", "b0"), mapped, "fate of the data", attributes=flags),
    }
    attributes = describe_run("pairs", first, first.solver)
    attributes = {
        key: value for key, value in attributes.items() if key not in ("omega", "initial", "case")
    }
    return variables, attributes | {"title": "What becomes of data on one pair"}
