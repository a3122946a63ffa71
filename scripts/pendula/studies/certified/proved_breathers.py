"""The dataset of steady breathers with their proofs: existence and stability."""

from collections.abc import Mapping, Sequence

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


def breathers_contents(
    gamma: float, half_widths: Mapping[str, int], proofs: Sequence[Mapping],
    wrong: Sequence[float],
) -> Contents:  # fmt: skip
    """Return the proofs of the given `family`, `omega` and `epsilon`, and radii of wrong states.

    `half_widths` has that of the `block` of the infinite chain and that of the finite `chain`.
    The first state is tested at the Omegas of `wrong` too.
    """
    block, end = half_widths["block"], half_widths["chain"]
    states, radii, refusals, chain_radii, stable = [], [], [], [], []
    for one in proofs:
        family, chain, state = find(gamma, block, one)
        radius, refusal = prove(chain, family, state)
        states.append(state)
        radii.append(radius)
        refusals.append(refusal)
        chain = chain._replace(half_width=end)
        state = existence.refined(chain, family.drive(gamma), state[:, : end + 1])
        radius, _ = prove(chain, family, state, infinite=False)
        chain_radii.append(radius)
        proved = np.isfinite(radius)
        stable.append(spectra.decide(chain, family, state, radius) if proved else Verdict.UNDECIDED)
    family, chain, state = find(gamma, block, proofs[0])
    refused = [prove(chain._replace(omega=one), family, state)[0] for one in wrong]
    of = ("proof",)
    amplitude = f"{NAMES['amplitude']}; divided by i in the imaginary families"
    variables = {
        "component": COMPONENTS,
        "site": Variable(("site",), np.arange(block + 1)),
        "family": Variable(of, [one["family"] for one in proofs], "family of states"),
        "omega": Variable(of, [float(one["omega"]) for one in proofs]),
        "epsilon": Variable(of, [float(one["epsilon"]) for one in proofs]),
        "amplitude": Variable((*of, "component", "site"),
                              np.array(states), amplitude),
        "radius": Variable(
            of, radii,
            "one true state lies within this l-infinity distance, infinite where none is proved"),
        "proof_refusal": Variable(of, refusals, "why nothing is proved"),
        "chain_radius": Variable(of, chain_radii,
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


def prove(
    chain: Chain, family: Family, state: np.ndarray, infinite: bool = True
) -> tuple[float, str]:
    """Return within which radius one true state is proved, or infinity and why nothing is."""
    try:
        return existence.prove(chain, family.drive(chain.gamma), state, infinite), ""
    except existence.RefusedError as error:
        return np.inf, str(error)
