"""How long the central pair stays excited, against its initial amplitude.

Zero is unstable, so that the chain around the centre is always set in motion; a large enough
oscillation lasts there for some time, which differs from run to run. The transition is over when
the central pair holds at most P / N, where N is the number of pairs: a
definition without any number to choose. An excited pair is not yet a localised motion, see the
study of breathers: the chain around it may hold most of P. Lives that outlast the run are censored.
"""

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.trajectories import Contents
from latticode.measures.confidence import Limits, median_limits, share_limits
from latticode.simulation.ensembles import draw_members
from latticode.simulation.problem import output_times
from latticode.simulation.runs import Run, run_all
from latticode.simulation.simulate import simulate

from pendula.many_cases import describe_cases
from pendula.problem import Problem

SPAN = 10.0
"""Units of tau from one look at the centre to the next: a run ends with the life that it follows.
Pieces of a run start from the state alone."""


def follow(problem: Problem) -> dict[str, float]:
    """Run a problem until its centre first holds at most its share of P; return this time.

    It is infinite if the run ends before.
    """
    spans = max(1, round(problem.end_time / SPAN))
    piece = problem.changed(end_time=problem.end_time / spans, snapshot_every=1)
    for done in range(spans):
        run = simulate(piece, energy=False)
        ended = np.flatnonzero(shares_alike(run.modulus))
        if ended.size:
            return {"life": float(done * piece.end_time + run.tau[ended[0]])}
        piece = piece.changed(initial=run.final)
    return {"life": np.inf}


def shares_alike(modulus: np.ndarray) -> np.ndarray:
    """Return whether the central pair holds at most 1 / N of P, (time,).

    `modulus` is (component, site, time), with an odd number N of sites.
    """
    power = (modulus**2).sum(axis=0)
    return power[len(power) // 2] <= power.mean(axis=0)


def surviving(lives: np.ndarray, tau: np.ndarray) -> Limits:
    """Return the share of members still excited at each tau, with exact limits, all (time,).

    No life is censored before the runs end, so that this is the estimate of Kaplan and Meier.
    """
    counts = (lives[:, None] > tau).sum(axis=0)
    known = {int(count): share_limits(int(count), len(lives)) for count in np.unique(counts)}
    return Limits(*np.array([known[int(count)] for count in counts]).T)


def measure_lifetimes(
    problem: Problem, amplitudes: list[float], ratio: float, size: float, members: int, seed: int,
    run: Run = run_all,
) -> Contents:  # fmt: skip
    """Return the lives of `members` runs from each amplitude A_0 with B_0 = `ratio` A_0."""
    starts = [problem.changed(initial=[[a0], [ratio * a0]]) for a0 in amplitudes]
    drawn = [one for start in starts for one in draw_members(start, size, members, seed)]
    lives = run(drawn, follow)["life"].reshape(len(amplitudes), members)
    tau, over = output_times(problem.end_time, 0.5), ("start_amplitude",)
    variables = {
        "start_amplitude": Variable(over, np.array(amplitudes), "initial amplitude A_0"),
        "tau": Variable(("tau",), tau),
        "life": Variable(
            (*over, "member"), lives, "time of the transition, infinite if after the end"
        ),
        **_limits(
            "surviving", (*over, "tau"), [surviving(one, tau) for one in lives],
            "share of runs whose central pair is still excited",
        ),
        **_limits(
            "median", over, [median_limits(one) for one in lives],
            "median life, from order statistics",
        ),
    }  # fmt: skip
    _, shared = describe_cases({"centre": problem})
    about = {"initial": f"A_0 and B_0 = {ratio:g} A_0 on the central pair", "ratio": ratio}
    about |= {"perturbation": size, "members": members, "seed": seed}
    title = "How long the central pair stays excited, against its initial amplitude"
    return variables, {**shared, "title": title, **about}


def _limits(name: str, dimensions, limits: list[Limits], words: str) -> dict[str, Variable]:
    """Return estimates and their two limits as three variables."""
    value, low, high = np.moveaxis(np.array(limits), 1, 0)
    return {
        name: Variable(dimensions, value, words),
        f"{name}_low": Variable(dimensions, low, f"{words}, lower confidence limit"),
        f"{name}_high": Variable(dimensions, high, f"{words}, upper confidence limit"),
    }
