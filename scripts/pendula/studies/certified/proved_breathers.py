"""The dataset of steady breathers with their proofs: existence, uniqueness, and stability."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.registry import NAMES
from latticode.datasets.trajectories import Contents

from pendula.many_cases import COMPONENTS
from pendula.models.pairs import FAMILIES, Family

from . import balls, existence, spectra
from .states import Chain, Verdict, find_state

REFUSED = existence.Proof(radius=np.inf, unique=0.0, contraction=np.inf, decay=np.inf)
UNDECIDED = spectra.Spectrum(Verdict.UNDECIDED, 0.0, np.inf)
FLAGS = {
    "flag_values": np.array([int(one) for one in Verdict], np.int8),
    "flag_meanings": " ".join(one.name.lower() for one in Verdict),
}


class Proved(NamedTuple):
    """What is proved near a computed state."""

    chain: Chain  # on which it is proved
    family: Family
    state: np.ndarray  # (component, site 0..M)
    proof: existence.Proof
    refusal: str  # why nothing is proved


def breathers_contents(
    gamma: float, half_widths: Mapping[str, int], proofs: Sequence[Mapping],
    wrong: Sequence[Mapping],
) -> Contents:  # fmt: skip
    """Return the proofs of the given `family`, `omega` and `epsilon`, and refusals of wrong states.

    `half_widths` has that of the `block` of the infinite chain and that of the finite `chain`.
    States of `wrong` are found at `omega` and tested at `tested_at`. What is refused has
    an infinite radius.
    """
    block, chain = half_widths["block"], half_widths["chain"]
    infinite = [prove(gamma, block, one, infinite=True) for one in proofs]
    finite = [prove(gamma, chain, one, infinite=False) for one in proofs]
    refused = [prove(gamma, block, one, infinite=True) for one in wrong]
    stability = [decide(one) for one in finite]
    of, of_wrong = ("proof",), ("wrong_proof",)
    amplitude = f"{NAMES['amplitude']}; divided by i in the imaginary families"
    variables = {
        "component": COMPONENTS,
        "site": Variable(("site",), np.arange(block + 1)),
        "family": Variable(of, [one.family.name for one in infinite], "family of states"),
        "omega": Variable(of, [one.chain.omega for one in infinite]),
        "epsilon": Variable(of, [one.chain.epsilon for one in infinite]),
        "amplitude": Variable((*of, "component", "site"),
                              np.array([one.state for one in infinite]), amplitude),
        "radius": Variable(
            of, [one.proof.radius for one in infinite],
            "a true state lies within this l-infinity distance, infinite where none is proved"),
        "unique_radius": Variable(of, [one.proof.unique for one in infinite],
                                  "no other true state lies within this distance"),
        "contraction": Variable(of, [one.proof.contraction for one in infinite],
                                "contraction bound of 1 - A DF: below 1, A is nearly an inverse"),
        "tail_factor": Variable(
            of, [one.proof.decay for one in infinite],
            "bound of the decay from site to site beyond the sites that are kept"),
        "proof_refusal": Variable(of, [one.refusal for one in infinite], "why nothing is proved"),
        "chain_radius": Variable(of, [one.proof.radius for one in finite],
                                 "the same radius on the finite chain"),
        "stable": Variable(
            of, np.array([one.verdict for one in stability], np.int8),
            "whether the state on the finite chain is proved stable or unstable", attributes=FLAGS),
        "growth_low": Variable(of, [one.growth_low for one in stability],
                               "lower bound of the fastest rate of growth"),
        "growth_high": Variable(of, [one.growth_high for one in stability],
                                "upper bound of the fastest rate of growth"),
        "wrong_radius": Variable(
            of_wrong, [one.proof.radius for one in refused],
            "radius that is proved of the wrong state, infinite if it is refused"),
        "wrong_refusal": Variable(of_wrong, [one.refusal for one in refused],
                                  "why the wrong state is refused"),
    }  # fmt: skip
    title = "Steady breathers whose existence and stability are proved"
    about = {"gamma": gamma, "half_width": block, "chain_half_width": chain, "bits": balls.BITS}
    return variables, {"title": title, **about}


def prove(gamma: float, half_width: int, given: Mapping, infinite: bool) -> Proved:
    """Return what is proved near the state that is found at `omega`, where it is to be tested."""
    (family,) = (one for one in FAMILIES if one.name == given["family"])
    chain = Chain(float(given["epsilon"]), gamma, float(given["omega"]), half_width)
    state = find_state(chain, family)
    tested = chain._replace(omega=float(given.get("tested_at", chain.omega)))
    try:
        proof, why = existence.prove(tested, family.drive(gamma), state, infinite), ""
    except existence.RefusedError as error:
        proof, why = REFUSED, str(error)
    return Proved(tested, family, state, proof, why)


def decide(found: Proved) -> spectra.Spectrum:
    """Return what is proved of the spectrum of a state on a finite chain."""
    if not np.isfinite(found.proof.radius):
        return UNDECIDED
    return spectra.decide(found.chain, found.family, found.state, found.proof.radius)
