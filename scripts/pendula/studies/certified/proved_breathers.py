"""The dataset of steady breathers with their proofs: existence, uniqueness, and stability."""

from collections.abc import Mapping, Sequence

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.registry import NAMES
from pendula.datasets.trajectories import COMPONENTS, Contents
from pendula.models.pairs import FAMILIES

from . import balls, existence, spectra
from .states import Chain, Verdict, find_state

PROVED = {
    "radius": "a true state lies within this l-infinity distance, infinite where none is proved",
    "unique_radius": "no other true state lies within this distance",
    "contraction": "bound of 1 - A DF: below one, A is as good as an inverse",
    "tail_factor": "bound of the decay from site to site beyond the sites that are kept",
}
"""What `existence.Proof` holds, in its order; rounded to the safe side."""
REFUSED = existence.Proof(radius=np.inf, unique=0.0, contraction=np.inf, decay=np.inf)
FLAGS = {
    "flag_values": np.array([int(one) for one in Verdict], np.int8),
    "flag_meanings": " ".join(one.name.lower() for one in Verdict),
}


def breathers_contents(
    gamma: float, half_widths: Mapping[str, int], proofs: Sequence[Mapping],
    wrong: Sequence[Mapping],
) -> Contents:  # fmt: skip
    """Return the proofs of the given `family`, `omega` and `epsilon`, and refusals of wrong states.

    `half_widths` has that of the `block` of the infinite chain and that of the finite `chain`.
    States of `wrong` are found at `omega` and tested at `tested_at`. What is refused has
    an infinite radius.
    """
    kept, chain = half_widths["block"], half_widths["chain"]
    found = [_proved(gamma, half_widths, one) for one in proofs]
    refused = [_proved(gamma, {"block": kept}, one) for one in wrong]
    of, of_wrong = ("proof",), ("wrong_proof",)

    def numbers(names: Mapping[str, str]) -> dict[str, Variable]:
        """Return a variable for each number that is proved; `names` has their long names."""
        return {
            name: Variable(of, [one[name] for one in found], words) for name, words in names.items()
        }

    variables = {
        "component": COMPONENTS,
        "site": Variable(("site",), np.arange(kept + 1)),
        "chain_site": Variable(("chain_site",), np.arange(chain + 1), "site of the finite chain"),
        **_labels(of, proofs, ""),
        **numbers(PROVED | {"chain_radius": "the same radius on the finite chain"}),
        "stable": Variable(
            of, np.array([one["stable"] for one in found], np.int8),
            "whether the state on the finite chain is proved stable or unstable", attributes=FLAGS,
        ),
        **numbers({
            "growth_low": "lower bound of the fastest rate of growth",
            "growth_high": "upper bound of the fastest rate of growth",
        }),
        **{
            f"{prefix}amplitude": Variable(
                (*of, "component", f"{prefix}site"),
                np.array([one[f"{prefix}amplitude"] for one in found]),
                f"{NAMES['amplitude']}, {place}; divided by i in the imaginary families",
            )
            for prefix, place in (("", "infinite chain"), ("chain_", "finite chain"))
        },
        "proof_refusal": Variable(of, [one["refusal"] for one in found], "why nothing is proved"),
        **_labels(of_wrong, wrong, "wrong_"),
        "tested_omega": Variable(
            of_wrong, [float(one["tested_at"]) for one in wrong],
            "detuning Omega at which the wrong state is tested",
        ),
        "wrong_radius": Variable(
            of_wrong, [one["radius"] for one in refused],
            "radius that is proved of the wrong state, infinite if it is refused",
        ),
        "wrong_refusal": Variable(
            of_wrong, [one["refusal"] for one in refused], "why the wrong state is refused"
        ),
    }  # fmt: skip
    title = "Steady breathers whose existence and stability are proved"
    about = {"gamma": gamma, "half_width": kept, "chain_half_width": chain, "bits": balls.BITS}
    return variables, {"title": title, **about}


def _labels(of: tuple[str], proofs: Sequence[Mapping], prefix: str) -> dict[str, Variable]:
    """Return which state each proof is of."""
    return {
        f"{prefix}family": Variable(of, [str(one["family"]) for one in proofs], "family of states"),
        f"{prefix}omega": Variable(of, [float(one["omega"]) for one in proofs], NAMES["omega"]),
        f"{prefix}epsilon": Variable(
            of, [float(one["epsilon"]) for one in proofs], NAMES["epsilon"]
        ),
    }


def _proved(gamma: float, half_widths: Mapping[str, int], given: Mapping) -> dict:
    """Return what is proved of one state, by the names of the dataset."""
    (family,) = (one for one in FAMILIES if one.name == given["family"])
    s = family.drive(gamma)
    found = {"stable": Verdict.UNDECIDED, "growth_low": 0.0, "growth_high": np.inf}
    for name, prefix in (("block", ""), ("chain", "chain_")):
        if name not in half_widths:
            continue
        chain = Chain(float(given["epsilon"]), gamma, float(given["omega"]), half_widths[name])
        state = find_state(chain, family)
        tested = chain._replace(omega=float(given.get("tested_at", chain.omega)))
        try:
            proof, why = existence.prove(tested, s, state, infinite=name == "block"), ""
        except existence.RefusedError as error:
            proof, why = REFUSED, str(error)
        found |= {f"{prefix}{key}": value for key, value in zip(PROVED, proof, strict=True)}
        found[f"{prefix}refusal"] = why
        found[f"{prefix}amplitude"] = state
        if name == "chain" and np.isfinite(proof.radius):
            spectrum = spectra.decide(tested, family, state, proof.radius)
            found |= zip(("stable", "growth_low", "growth_high"), spectrum, strict=True)
    return found
