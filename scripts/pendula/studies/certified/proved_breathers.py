"""The dataset of steady breathers with their proofs: existence and stability."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.registry import NAMES
from latticode.datasets.trajectories import Contents

from pendula.many_cases import COMPONENTS
from pendula.models.pairs import FAMILIES, Family
from pendula.models.steady import localised
from pendula.problem import Constants

from . import balls, existence, spectra
from .existence import Chain
from .spectra import Verdict

FLAGS = {
    "flag_values": np.array([int(one) for one in Verdict], np.int8),
    "flag_meanings": " ".join(one.name.lower() for one in Verdict),
}
DIGITS = 10
"""Decimals of a state as LAPACK finds it, which are the same on every machine."""


class Proved(NamedTuple):
    """What is proved near a computed state."""

    state: np.ndarray  # (component, site 0..M)
    radius: float  # infinite where nothing is proved
    refusal: str  # why nothing is proved


def breathers_contents(
    gamma: float, half_widths: Mapping[str, int], proofs: Sequence[Mapping],
    wrong: Sequence[float],
) -> Contents:  # fmt: skip
    """Return the proofs of the given `family`, `omega` and `epsilon`, and radii of wrong states.

    `half_widths` has that of the `block` of the infinite chain and that of the finite `chain`.
    The first state is tested at the Omegas of `wrong` too.
    """
    block, end = half_widths["block"], half_widths["chain"]
    infinite, finite, stable = [], [], []
    for one in proofs:
        family, chain, state = find(gamma, block, one)
        infinite.append(prove(chain, family, state))
        chain = chain._replace(half_width=end)
        state = existence.refined(chain, family.drive(gamma), state[:, : end + 1])
        finite.append(prove(chain, family, state, infinite=False))
        stable.append(decide(chain, family, finite[-1]))
    family, chain, state = find(gamma, block, proofs[0])
    refused = [prove(chain._replace(omega=one), family, state).radius for one in wrong]
    of = ("proof",)
    amplitude = f"{NAMES['amplitude']}; divided by i in the imaginary families"
    variables = {
        "component": COMPONENTS,
        "site": Variable(("site",), np.arange(block + 1)),
        "family": Variable(of, [one["family"] for one in proofs], "family of states"),
        "omega": Variable(of, [float(one["omega"]) for one in proofs]),
        "epsilon": Variable(of, [float(one["epsilon"]) for one in proofs]),
        "amplitude": Variable((*of, "component", "site"),
                              np.array([one.state for one in infinite]), amplitude),
        "radius": Variable(
            of, [one.radius for one in infinite],
            "one true state lies within this l-infinity distance, infinite where none is proved"),
        "proof_refusal": Variable(of, [one.refusal for one in infinite], "why nothing is proved"),
        "chain_radius": Variable(of, [one.radius for one in finite],
                                 "the same radius on the finite chain"),
        "stable": Variable(
            of, np.array(stable, np.int8),
            "whether the state on the finite chain is proved stable or unstable", attributes=FLAGS),
        "wrong_radius": Variable(
            ("wrong_proof",), refused,
            "radius that is proved of the wrong state, infinite if it is refused"),
    }  # fmt: skip
    title = "Steady breathers whose existence and stability are proved"
    about = {"gamma": gamma, "half_width": block, "chain_half_width": end, "bits": balls.BITS}
    return variables, {"title": title, **about}


def find(gamma: float, half_width: int, given: Mapping) -> tuple[Family, Chain, np.ndarray]:
    """Return a family, a chain, and its even state there, (component, site 0..M)."""
    (family,) = (one for one in FAMILIES if one.name == given["family"])
    chain = Chain(float(given["epsilon"]), gamma, float(given["omega"]), half_width)
    constants = Constants(epsilon=chain.epsilon, gamma=gamma, omega=chain.omega)
    problem, found = localised(family, constants, half_width)
    parts = found.parts(problem)[:, int(family.imaginary), half_width:]
    state = np.round(parts, DIGITS)
    return family, chain, existence.refined(chain, family.drive(gamma), state)


def prove(chain: Chain, family: Family, state: np.ndarray, infinite: bool = True) -> Proved:
    """Return what is proved of a true state near to the given one."""
    try:
        radius = existence.prove(chain, family.drive(chain.gamma), state, infinite)
    except existence.RefusedError as error:
        return Proved(state, np.inf, str(error))
    return Proved(state, radius, "")


def decide(chain: Chain, family: Family, found: Proved) -> Verdict:
    """Return what is proved of the spectrum of a state on a finite chain."""
    if not np.isfinite(found.radius):
        return Verdict.UNDECIDED
    return spectra.decide(chain, family, found.state, found.radius)
