"""The dataset of steady breathers with the proofs that they exist."""

from collections.abc import Mapping, Sequence

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.registry import NAMES
from latticode.datasets.trajectories import Contents
from replication.variables import PROVEN, REGULAR

from pendula.many_cases import COMPONENTS
from pendula.models.pairs import FAMILIES, Family
from pendula.models.steady import localised
from pendula.problem import Constants

from . import existence
from .existence import ProofChain

DIGITS = 10
"""Decimals of a state as LAPACK finds it, which are the same on every machine."""


def breathers_contents(
    gamma: float, half_width: int, proofs: Sequence[Mapping], wrong: Sequence[float]
) -> Contents:
    """Return the proofs of the given `family`, `omega` and `epsilon`, and radii of wrong states.

    The states are kept on a block of the infinite chain of the given `half_width`. The first state
    is tested at the Omegas of `wrong` too.
    """
    found = [find(gamma, half_width, one) for one in proofs]
    radii, refusals = zip(*(prove(*one) for one in found), strict=True)
    family, chain, state = found[0]
    refused = [prove(family, chain._replace(omega=one), state)[0] for one in wrong]
    of = ("proof",)
    amplitude = f"{NAMES['amplitude']}; divided by i in the imaginary families"
    variables = {
        "component": COMPONENTS,
        "site": Variable(("site",), np.arange(half_width + 1)),
        "family": Variable(of, [one["family"] for one in proofs], "family of states"),
        "omega": Variable(of, [float(one["omega"]) for one in proofs]),
        "epsilon": Variable(of, [float(one["epsilon"]) for one in proofs]),
        "amplitude": Variable(
            (*of, "component", "site"), np.array([state for _, _, state in found]), amplitude
        ),
        "radius": Variable(
            of,
            radii,
            "one true state lies within this l-infinity distance, infinite where none is proved",
            attributes=PROVEN,
        ),
        "proof_refusal": Variable(of, refusals, "why nothing is proved"),
        "wrong_radius": Variable(
            ("wrong_proof",),
            refused,
            "radius that is proved of the wrong state, infinite if it is refused",
            attributes=PROVEN,
        ),
    }
    title = "Steady breathers whose existence is proved"
    about = {"gamma": gamma, "half_width": half_width, "bits": existence.BITS, **REGULAR}
    return variables, {"title": title, **about}


def find(gamma: float, half_width: int, given: Mapping) -> tuple[Family, ProofChain, np.ndarray]:
    """Return a family, a chain, and its even state there, (component, site 0..M)."""
    (family,) = (one for one in FAMILIES if one.name == given["family"])
    chain = ProofChain(float(given["epsilon"]), gamma, float(given["omega"]), half_width)
    constants = Constants(epsilon=chain.epsilon, gamma=gamma, omega=chain.omega)
    problem, found = localised(family, constants, half_width)
    parts = found.parts(problem)[:, int(family.imaginary), half_width:]
    state = np.round(parts, DIGITS)
    return family, chain, existence.refined(chain, family.drive(gamma), state)


def prove(family: Family, chain: ProofChain, state: np.ndarray) -> tuple[float, str]:
    """Return within which radius one true state is proved, or infinity and why nothing is."""
    try:
        return existence.prove(chain, family.drive(chain.gamma), state), ""
    except existence.ProofFailedError as error:
        return np.inf, str(error)
