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
from latticode.measures.confidence import median_limits
from latticode.simulation.ensembles import draw_members
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


def measure_lifetimes(
    problem: Problem, amplitudes: list[float], ratio: float, size: float, members: int, seed: int,
    run: Run = run_all,
) -> Contents:  # fmt: skip
    """Return the lives of `members` runs from each amplitude A_0 with B_0 = `ratio` A_0."""
    starts = [problem.changed(initial=[[a0], [ratio * a0]]) for a0 in amplitudes]
    drawn = [one for start in starts for one in draw_members(start, size, members, seed)]
    lives = run(drawn, follow)["life"].reshape(len(amplitudes), members)
    medians, over = [median_limits(one) for one in lives], ("start_amplitude",)
    words = "median life, from order statistics"
    variables = {
        "start_amplitude": Variable(over, np.array(amplitudes), "initial amplitude A_0"),
        "life": Variable(
            (*over, "member"), lives, "time of the transition, infinite if after the end"
        ),
        "median": Variable(over, [one.value for one in medians], words),
        "median_low": Variable(over, [one.low for one in medians], f"{words}, lower limit"),
        "median_high": Variable(over, [one.high for one in medians], f"{words}, upper limit"),
    }
    _, shared = describe_cases({"centre": problem})
    about = {"initial": f"A_0 and B_0 = {ratio:g} A_0 on the central pair", "ratio": ratio}
    about |= {"perturbation": size, "members": members, "seed": seed}
    title = "How long the central pair stays excited, against its initial amplitude"
    return variables, {**shared, "title": title, **about}
