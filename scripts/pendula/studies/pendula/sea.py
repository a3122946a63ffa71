"""The state that fills the chain at Omega = 0, of pendula beside that of the amplitudes.

Both are chaotic, so ensembles are compared: each member is reduced to means over all sites of the
same chain and over one window of time. That these also are near the thermal state without energy
of a chain without ends (pendula.studies.unbounded) is another question, since the chain has ends.
"""

from collections.abc import Sequence

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import Contents, describe_cases
from pendula.numerics.elementary import sin, square_modulus
from pendula.problem import Problem, name_window
from pendula.simulation.ensembles import draw_members

from .envelope import LIMIT, at_mu, states

EDGES = np.linspace(0.0, 8.0, 41)
"""Cells of the distribution of moduli; the sea reaches up to seven."""


class Waves:
    """The even waves of a chain of N sites at rest beyond its ends: sin(k n), n = 1..N."""

    def __init__(self, sites: int):
        self.numbers = np.pi * np.arange(1, sites + 1, 2) / (sites + 1)  # k, in rad
        self.shapes = sin(self.numbers[:, None] * np.arange(1, sites + 1))  # (wave, site)
        # the mean over these waves is the mean square over the sites
        self.scale = 2.0 / (sites + 1) * len(self.numbers) / sites

    def spectrum(self, amplitudes: np.ndarray) -> np.ndarray:
        """Return the mean of |A(k)|^2 over components and times of (component, site, time)."""
        waves = [(shape[:, None] * amplitudes).sum(axis=1) for shape in self.shapes]
        return self.scale * square_modulus(np.array(waves)).mean(axis=(1, 2))


def reduce_member(problem: Problem, window: tuple[float, float], waves: Waves) -> dict:
    """Return P a site, norms, spectrum and distribution of one run, mean over the window."""
    tau, amplitudes = states(problem)
    amplitudes = amplitudes[..., (tau >= window[0]) & (tau <= window[1])]
    squares = square_modulus(amplitudes)
    return {
        "site_power": squares.sum(axis=0).mean(),
        "l2_level": np.sqrt(squares.sum(axis=(0, 1))).mean(),
        "linf_level": np.sqrt(squares.max(axis=(0, 1))).mean(),
        "wave_power": waves.spectrum(amplitudes),
        "modulus_share": np.histogram(np.sqrt(squares), EDGES)[0] / squares.size,
    }


def measure_sea(
    problem: Problem, mus: Sequence[float], window: tuple[float, float], size: float,
    members: int, seed: int,
) -> Contents:  # fmt: skip
    """Return what REDUCED names of members of the chain of amplitudes, mu = 0, and of pendula."""
    every, waves = [LIMIT, *mus], Waves(problem.sites)
    drawn = draw_members(problem, size, members, seed)
    rows = [[reduce_member(at_mu(one, mu), window, waves) for one in drawn] for mu in every]
    over = ("mu", "member")
    _, shared = describe_cases({"sea": problem})
    variables = {
        "mu": Variable(("mu",), every),
        "even_wave": Variable(("even_wave",), waves.numbers, "wave number k, even waves", "rad"),
        "modulus": Variable(("modulus",), 0.5 * (EDGES[1:] + EDGES[:-1])),
    }
    for name, (rest, words) in REDUCED.items():
        values = np.array([[one[name] for one in row] for row in rows])
        variables[name] = Variable((*over, *rest), values, words)
    title = f"The sea of the pendula beside that of the amplitudes, over {name_window(window)}"
    about = {"perturbation": size, "members": members, "seed": seed}
    about |= {"window": name_window(window), "omega": problem.constants.omega}
    return variables, {**shared, **about, "title": f"{title}; mu = 0 stands for (4)"}


REDUCED = {
    "site_power": ((), "mean of |A_n|^2 + |B_n|^2 over sites and time"),
    "l2_level": ((), "mean of the l2 norm over the time window"),
    "linf_level": ((), "mean of the l-infinity norm over the time window"),
    "wave_power": (("even_wave",), "mean |A(k)|^2 over the chain and time"),
    "modulus_share": (("modulus",), "share of moduli in a cell"),
}
"""What each member is reduced to: dimensions after mu and member, and in words."""
