"""How long the central pendulum keeps to itself, against its initial amplitude.

Zero is unstable, so that the chain around the centre is always set in motion; a large enough
oscillation stays localised in it for some time, which differs from run to run. The transition is
over when the central pair holds no more than an even share of P, which is P over the number of
pairs: a definition without any number to choose. Lives that outlast the run are censored.
"""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import Contents, describe_cases
from pendula.measures.confidence import (
    Limits,
    chance_of_law,
    event_rate,
    median_limits,
    share_limits,
)
from pendula.measures.norms import drift
from pendula.problem import Problem, output_times
from pendula.simulation.ensembles import draw_members
from pendula.simulation.simulate import simulate

SPAN = 10.0
"""Units of tau from one look at the centre to the next: a run ends with the life that it follows.
Pieces of a run start from the state alone."""


def follow(problem: Problem) -> tuple[float, float, int]:
    """Follow one run at its output times until the centre holds no more than an even share of P.

    Return the time at which it does so first, infinite where it does not; the largest |H - H(0)|
    over |H(0)|; and the right-hand sides, of the Taylor method the series of the solution.
    """
    spans = max(1, round(problem.end_time / SPAN))
    piece = problem.changed(end_time=problem.end_time / spans, snapshot_every=1)
    energies, work, time = [], 0, np.inf
    for done in range(spans):
        run = simulate(piece)
        energies.append(run.energy)
        work += run.outcome.evaluations
        ended = np.flatnonzero(shares_alike(run.modulus))
        if ended.size:
            time = float(done * piece.end_time + run.tau[ended[0]])
            break
        piece = piece.changed(initial=run.final)
    energy = np.concatenate(energies)
    return time, float(drift(energy).max() / abs(energy[0])), work


def shares_alike(modulus: np.ndarray) -> np.ndarray:
    """Return whether the central pair holds no more than an even share of P, (time,).

    `modulus` is (component, site, time), with an odd number of sites.
    """
    power = (modulus**2).sum(axis=0)
    return power[len(power) // 2] <= power.mean(axis=0)


# --- Many lives -----------------------------------------------------------------------------------


class Lives(NamedTuple):
    """The runs of one ensemble up to their transitions."""

    times: np.ndarray  # (member,), infinite if later than the end
    drift: float  # largest relative error of the energy
    work: int  # of all members


def follow_members(
    problem: Problem, amplitude: float, ratio: float, tolerance: float, kind: str,
    size: float, members: int, seed: int,
) -> Lives:  # fmt: skip
    """Follow an ensemble from A_0 = `amplitude` and B_0 = `ratio` A_0 on the central pair alone."""
    one = problem.changed(
        initial=np.array([[amplitude], [ratio * amplitude]], complex),
        solver={**problem.solver, "rtol": tolerance, "atol": tolerance},
    )
    lives = [follow(member) for member in draw_members(one, size, members, seed, kind)]
    times, drifts, work = zip(*lives, strict=True)
    return Lives(np.array(times), max(drifts), sum(work))


def surviving(lives: np.ndarray, tau: np.ndarray) -> Limits:
    """Return the share of members still localised at each tau, with exact limits, all (time,).

    No life is censored before the runs end, so that this is the estimate of Kaplan and Meier.
    """
    counts = (lives[:, None] > tau).sum(axis=0)
    known = {int(count): share_limits(int(count), len(lives)) for count in np.unique(counts)}
    return Limits(*np.array([known[int(count)] for count in counts]).T)


def measure_lifetimes(
    problem: Problem, amplitudes: list[float], ratio: float, compared: Mapping, size: float,
    members: int, settled: float, seed: int,
) -> Contents:  # fmt: skip
    """Return the lives of `members` from each amplitude A_0 with B_0 = `ratio` A_0.

    `compared` holds an `amplitude` that is run again by other `choices` of tolerance and kind of
    ensemble, for the error and the cost of the rate of transitions.
    """
    own, again, choices = problem.solver["rtol"], compared["amplitude"], compared["choices"]
    main = [(a0, own, "even") for a0 in amplitudes]
    others = [(again, *choice) for choice in choices]
    found = {
        one: follow_members(problem, one[0], ratio, *one[1:], size, members, seed)
        for one in dict.fromkeys(main + others)
    }
    lives, numerics = [found[one] for one in main], [found[one] for one in others]
    tau, end_time = output_times(problem.end_time, 0.5), problem.end_time

    def rates(ensembles: list[Lives]) -> list[Limits]:
        return [event_rate(one.times, settled, end_time) for one in ensembles]

    over, over_choices = ("start_amplitude",), ("choice",)
    drift_says = "largest relative error of the energy"
    work_says = "work of the ensemble, right-hand sides"
    rate_says = "transitions per unit of tau and member that is localised, after the settled time"
    variables = {
        "start_amplitude": Variable(over, amplitudes, "initial amplitude A_0 of the centre"),
        "tau": Variable(("tau",), tau),
        "life": Variable(
            (*over, "member"), np.array([one.times for one in lives]),
            "time of the transition, infinite if later",
        ),
        "relative_drift": Variable(
            over, [one.drift for one in lives], f"{drift_says} in any member"
        ),
        "work": Variable(over, [one.work for one in lives], work_says),
        **_limits(
            "surviving", (*over, "tau"), [surviving(one.times, tau) for one in lives],
            "share of members that are still localised",
        ),
        **_limits(
            "median", over, [median_limits(one.times) for one in lives],
            "median life, from order statistics",
        ),
        **_limits("rate", over, rates(lives), rate_says),
        # not from the start: the data are almost equal, and it takes time until members differ
        "rate_chance": Variable(
            over,
            [chance_of_law(one.times[one.times > settled] - settled, end_time - settled)
             for one in lives],
            "chance of lives as far from a constant rate",
        ),
        "compared_amplitude": Variable(
            (), float(again), "initial amplitude A_0 of the compared ensembles"
        ),
        "choice_tolerance": Variable(
            over_choices, [tolerance for tolerance, _ in choices], "tolerance of the solver"
        ),
        "choice_kind": Variable(over_choices, [kind for _, kind in choices],
                                "kind of the ensemble"),
        "choice_drift": Variable(over_choices, [one.drift for one in numerics], drift_says),
        "choice_work": Variable(over_choices, [one.work for one in numerics], work_says),
        **_limits("choice_rate", over_choices, rates(numerics), rate_says),
    }  # fmt: skip
    _, shared = describe_cases({"centre": problem})
    about = {"initial": f"A_0 and B_0 = {ratio:g} A_0 on the central pair", "settled": settled}
    about |= {"perturbation": size, "members": members, "seed": seed, "ratio": ratio}
    title = "How long the central pendulum stays localised, against its initial amplitude"
    return variables, {**shared, "title": title, **about}


def _limits(name: str, dimensions, limits: list[Limits], words: str) -> dict[str, Variable]:
    """Return estimates and their two limits as three variables."""
    value, low, high = np.moveaxis(np.array(limits), 1, 0)
    return {
        name: Variable(dimensions, value, words),
        f"{name}_low": Variable(dimensions, low, f"{words}, lower confidence limit"),
        f"{name}_high": Variable(dimensions, high, f"{words}, upper confidence limit"),
    }
