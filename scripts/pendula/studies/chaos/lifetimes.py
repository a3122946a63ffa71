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
from pendula.numerics.elementary import modulus
from pendula.problem import Problem, output_times
from pendula.simulation.ensembles import draw_members
from pendula.simulation.simulate import simulate

SPAN = 10.0
"""Units of tau from one look at the centre to the next: a run ends with the life that it follows.
Pieces of a run start from the state alone."""


class Life(NamedTuple):
    """One run up to its transition, or to its end."""

    time: float  # first output time at which the centre holds no more than its share; else infinite
    drift: float  # largest |H - H(0)| over |H(0)|
    work: int  # right-hand sides; of the Taylor method, series of the solution


def follow(problem: Problem) -> Life:
    """Follow one run at its output times until the centre holds no more than an even share of P."""
    spans = max(1, round(problem.end_time / SPAN))
    piece = problem.changed(end_time=problem.end_time / spans, snapshot_every=1)
    energies, work = [], 0
    for done in range(spans):
        run = simulate(piece)
        energies.append(run.energy)
        work += run.outcome.evaluations
        ended = np.flatnonzero(shares_alike(run.modulus))
        if ended.size:
            return Life(float(done * piece.end_time + run.tau[ended[0]]), _drift(energies), work)
        piece = piece.changed(initial=run.final)
    return Life(np.inf, _drift(energies), work)


def shares_alike(modulus: np.ndarray) -> np.ndarray:
    """Return whether the central pair holds no more than an even share of P, (time,).

    `modulus` is (component, site, time), with an odd number of sites.
    """
    power = (modulus**2).sum(axis=0)
    return power[len(power) // 2] <= power.mean(axis=0)


def _drift(energies: list[np.ndarray]) -> float:
    energy = np.concatenate(energies)
    return float(drift(energy).max() / abs(energy[0]))


# --- Many lives -----------------------------------------------------------------------------------


def localised(problem: Problem, amplitude: float, ratio: float) -> Problem:
    """Return the problem with A_0 = `amplitude` and B_0 = `ratio` A_0 on the central pair alone."""
    return problem.changed(initial=np.array([[amplitude], [ratio * amplitude]], complex))


def follow_members(
    problem: Problem, size: float, members: int, seed: int, kind: str = "even"
) -> list[Life]:
    """Follow the members of an ensemble of `problem`, one Life each."""
    return [follow(member) for member in draw_members(problem, size, members, seed, kind)]


def chance_of_rate(lives: np.ndarray, settled: float, end_time: float) -> float:
    """Return the chance of lives as far from a constant rate, of those localised at `settled`.

    Lives are (member,), infinite where they outlast `end_time`. The rate cannot be constant from
    the start: the data are almost equal, and it takes time until members differ.
    """
    return chance_of_law(lives[lives > settled] - settled, end_time - settled)


def surviving(lives: np.ndarray, tau: np.ndarray) -> Limits:
    """Return the share of members still localised at each tau, with exact limits, all (time,).

    No life is censored before the runs end, so that this is the estimate of Kaplan and Meier.
    """
    counts = (lives[:, None] > tau).sum(axis=0)
    known = {int(count): share_limits(int(count), len(lives)) for count in np.unique(counts)}
    return Limits(*np.array([known[int(count)] for count in counts]).T)


NUMBERS = {
    "median": "median life, from order statistics",
    "rate": "transitions per unit of tau and member that is localised, after the settled time",
}
ENDS = {"value": "", "low": ", lower confidence limit", "high": ", upper confidence limit"}


def measure_lives(
    problem: Problem, amplitudes: list[float], ratio: float, size: float, members: int,
    settled: float, seed: int,
) -> Contents:  # fmt: skip
    """Return the lives of `members` from each amplitude A_0 with B_0 = `ratio` A_0."""
    runs = [follow_members(localised(problem, a0, ratio), size, members, seed) for a0 in amplitudes]
    lives = np.array([[life.time for life in row] for row in runs])
    tau = output_times(problem.end_time, 0.5)
    shares = [surviving(row, tau) for row in lives]
    medians = [median_limits(row) for row in lives]
    rates = [event_rate(row, settled, problem.end_time) for row in lives]
    chances = [chance_of_rate(row, settled, problem.end_time) for row in lives]
    over, share = ("start_amplitude",), "share of members that are still localised"
    variables = {
        "start_amplitude": Variable(over, amplitudes, "initial amplitude A_0 of the centre"),
        "tau": Variable(("tau",), tau),
        "life": Variable((*over, "member"), lives, "time of the transition, infinite if later"),
        "relative_drift": Variable(
            over, [max(life.drift for life in row) for row in runs],
            "largest relative error of the energy in any member",
        ),
        "work": Variable(
            over, [sum(life.work for life in row) for row in runs],
            "work of the ensemble, right-hand sides",
        ),
        **_limits("surviving", (*over, "tau"), shares, share),
        **_limits("median", over, medians, NUMBERS["median"]),
        **_limits("rate", over, rates, NUMBERS["rate"]),
        "rate_chance": Variable(over, chances, "chance of lives as far from a constant rate"),
    }  # fmt: skip
    _, shared = describe_cases({"centre": problem})
    about = {"initial": f"A_0 and B_0 = {ratio:g} A_0 on the central pair", "settled": settled}
    about |= {"perturbation": size, "members": members, "seed": seed}
    title = "How long the central pendulum stays localised, against its initial amplitude"
    return variables, {**shared, "title": title, **about}


class Found(NamedTuple):
    """What an ensemble tells of its tolerance and its kind."""

    times: np.ndarray  # (member,), lives
    drift: float  # largest relative error of the energy
    work: int  # right-hand sides


def compare_numerics(
    problem: Problem, choices: list[tuple[float, str]], size: float, members: int,
    settled: float, seed: int, lives: dict[str, Variable],
) -> dict[str, Variable]:  # fmt: skip
    """Return the rate of transitions, its error and its cost, for (tolerance, kind of ensemble).

    The choice by which `measure_lives` made `lives` is not run again if they hold the amplitude.
    """
    a0, found = float(modulus(problem.initial[0]).max()), []
    known = a0 in lives["start_amplitude"].values
    for tolerance, kind in choices:
        if known and (tolerance, kind) == (problem.solver["rtol"], "even"):
            found.append(_measured(lives, a0))
            continue
        solver = {**problem.solver, "rtol": tolerance, "atol": tolerance}
        runs = follow_members(problem.changed(solver=solver), size, members, seed, kind)
        times, drifts, work = zip(*runs, strict=True)
        found.append(Found(np.array(times), max(drifts), sum(work)))
    rates = [event_rate(one.times, settled, problem.end_time) for one in found]
    over = ("choice",)
    return {
        "compared_amplitude": Variable((), a0, "initial amplitude A_0 of the compared ensembles"),
        "choice_tolerance": Variable(over, [one for one, _ in choices], "tolerance of the solver"),
        "choice_kind": Variable(over, [kind for _, kind in choices], "kind of the ensemble"),
        "choice_drift": Variable(
            over, [one.drift for one in found], "largest relative error of the energy"
        ),
        "choice_work": Variable(
            over, [one.work for one in found], "work of the ensemble, right-hand sides"
        ),
        **_limits("choice_rate", over, rates, NUMBERS["rate"]),
    }


def _measured(lives: dict[str, Variable], a0: float) -> Found:
    """Return what `measure_lives` found of the ensemble from one of its amplitudes."""
    row = list(lives["start_amplitude"].values).index(a0)
    return Found(*(lives[name].values[row] for name in ("life", "relative_drift", "work")))


def _limits(name: str, dimensions, limits: list[Limits], words: str) -> dict[str, Variable]:
    """Return an estimate and its two limits as three variables."""
    return {
        f"{name}_{end}" if end != "value" else name: Variable(
            dimensions, np.array([getattr(one, end) for one in limits]), words + said
        )
        for end, said in ENDS.items()
    }


def measure_lifetimes(
    problem: Problem, amplitudes: list[float], ratio: float, compared: Mapping, size: float,
    members: int, settled: float, seed: int,
) -> Contents:  # fmt: skip
    """Return the lives from each amplitude, and those from one of them by other `choices`."""
    drawn = (size, members, settled, seed)
    lives, attributes = measure_lives(problem, amplitudes, ratio, *drawn)
    one = localised(problem, compared["amplitude"], ratio)
    numerics = compare_numerics(one, compared["choices"], *drawn, lives)
    return lives | numerics, {**attributes, "ratio": ratio}
