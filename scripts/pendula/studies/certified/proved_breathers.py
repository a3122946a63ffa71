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
"""States computed with LAPACK are the same on every machine to this number of decimals."""


def prove_breathers(
    gamma: float, half_width: int, proofs: Sequence[Mapping], control_omegas: Sequence[float]
) -> Contents:
    """Return the dataset of steady breathers, each with the result of its proof.

    Each of `proofs` has the `family`, `omega` and `epsilon` of a breather. States are stored on the
    sites 0..half_width of the infinite chain. As controls, the first state is also tested at each
    of `control_omegas`, where the proof must fail.
    """
    candidates = [compute_state(gamma, half_width, proof) for proof in proofs]
    radii, refusals = zip(*(try_proof(*candidate) for candidate in candidates), strict=True)
    family, chain, state = candidates[0]
    control_radii = [
        try_proof(family, chain._replace(omega=control_omega), state)[0]
        for control_omega in control_omegas
    ]
    dimensions = ("proof",)
    amplitude = f"{NAMES['amplitude']}; divided by i in the imaginary families"
    variables = {
        "component": COMPONENTS,
        "site": Variable(("site",), np.arange(half_width + 1)),
        "family": Variable(dimensions, [proof["family"] for proof in proofs], "family of states"),
        "omega": Variable(dimensions, [float(proof["omega"]) for proof in proofs]),
        "epsilon": Variable(dimensions, [float(proof["epsilon"]) for proof in proofs]),
        "amplitude": Variable(
            (*dimensions, "component", "site"),
            np.array([state for _, _, state in candidates]),
            amplitude,
        ),
        "radius": Variable(
            dimensions,
            radii,
            "one true state lies within this l-infinity distance, infinite if none is proved",
            attributes=PROVEN,
        ),
        "proof_refusal": Variable(
            dimensions, refusals, "why the proof failed, empty if it did not"
        ),
        "wrong_radius": Variable(
            ("wrong_proof",),
            control_radii,
            "radius proved for the wrong state, infinite if the proof failed",
            attributes=PROVEN,
        ),
    }
    title = "Steady breathers whose existence is proved"
    attributes = {"gamma": gamma, "half_width": half_width, "bits": existence.BITS, **REGULAR}
    return variables, {"title": title, **attributes}


def compute_state(
    gamma: float, half_width: int, proof: Mapping
) -> tuple[Family, ProofChain, np.ndarray]:
    """Return the family, the chain and the even state (component, site 0..M) of a breather."""
    (family,) = (known for known in FAMILIES if known.name == proof["family"])
    chain = ProofChain(float(proof["epsilon"]), gamma, float(proof["omega"]), half_width)
    constants = Constants(epsilon=chain.epsilon, gamma=gamma, omega=chain.omega)
    problem, breather = localised(family, constants, half_width)
    components = breather.components(problem)[:, int(family.imaginary), half_width:]
    state = np.round(components, DIGITS)
    return family, chain, existence.refine(chain, family.drive(gamma), state)


def try_proof(family: Family, chain: ProofChain, state: np.ndarray) -> tuple[float, str]:
    """Return a radius within which one true state exists, and the reason if the proof fails.

    If it fails, the radius is infinite; else the reason is empty.
    """
    try:
        return existence.prove(chain, family.drive(chain.gamma), state), ""
    except existence.ProofFailedError as error:
        return np.inf, str(error)
