"""Who is compared: every solver of this project, and those of other people that are installed.

A contestant is prepared for a problem once (it compiles what it compiles) and then solves it at a
given accuracy (a tolerance, or a step), again and again.
"""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
from pendula.problem import Problem
from pendula.simulation.simulate import simulate

from . import peers_as_programs, peers_in_python
from .peer import Peer, Solve
from .timing import timed

TOLERANCES = 10.0 ** -np.arange(4.0, 15.5)
ITERATED = ("crank_nicolson", "delfour_fortin_payre")
STEPS = {name: 0.04 / 2.0 ** np.arange(6) for name in ITERATED}

PEERS: dict[str, Peer] = {
    "scipy_rk45_numpy": peers_in_python.RK45_NUMPY,
    "scipy_dop853_numpy": peers_in_python.DOP853_NUMPY,
    "scipy_rk45": peers_in_python.RK45,
    "scipy_dop853": peers_in_python.DOP853,
    "scipy_lsoda": peers_in_python.LSODA,
    "scipy_radau": peers_in_python.RADAU,
    "heyoka_full": peers_in_python.HEYOKA,
    "heyoka_half": peers_in_python.HEYOKA_HALF,
    "cvode_adams": peers_in_python.CVODE_ADAMS,
    "octave_ode45": peers_as_programs.OCTAVE_ODE45,
    "numbalsoda_dop853": peers_in_python.NUMBALSODA,
    "numbalsoda_dop853_half": peers_in_python.NUMBALSODA_HALF,
    "cpp_taylor": peers_as_programs.TAYLOR_SEPARATE,
    "cpp_taylor_contracted": peers_as_programs.TAYLOR_FUSED,
    "cpp_taylor_eight": peers_as_programs.TAYLOR_EIGHT,
}


class Contestant(NamedTuple):
    """Its name in tables, what it can be asked for, and how it is made ready for a problem."""

    title: str
    accuracies: np.ndarray
    prepare: Callable[[Problem], Solve]


def controls(name: str, accuracy: float) -> dict:
    """Return the controls of one of our solvers for a tolerance or a step."""
    if name in ITERATED:
        return {"name": name, "step": accuracy, "tolerance": 1e-13, "iterations": 50}
    atol = accuracy / 100 if name == "ode45" else accuracy  # the paper's ratio for ode45
    return {"name": name, "rtol": accuracy, "atol": atol}


def _prepare_own(name: str, problem: Problem) -> Solve:
    def solve(accuracy: float) -> tuple[np.ndarray, float]:
        given = problem.changed(solver=controls(name, accuracy))
        run, seconds = timed(lambda: simulate(given))
        return run.final, seconds

    return solve


OURS = {
    name: Contestant(name, STEPS.get(name, TOLERANCES), partial(_prepare_own, name))
    for name in ("ode45", *ITERATED, "dop853", "taylor")
}


def find_peers() -> tuple[dict[str, Contestant], dict[str, str]]:
    """Return the peers that are installed, and for the others the reason why they are missing."""
    present, absent = {}, {}
    for name, peer in PEERS.items():
        if reason := peer.why_absent():
            absent[name] = reason
        else:
            present[name] = Contestant(peer.title, TOLERANCES, peer.prepare)
    return present, absent
