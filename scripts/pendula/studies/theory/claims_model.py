"""Section 2: claims on the equations, their symmetries, and their derivation from (1)."""

from collections.abc import Callable, Mapping
from functools import wraps

import xarray as xr
from latticode.measures.confidence import student
from latticode.measures.growth import INTERVALS
from replication.ledger import changes
from replication.ledger.chances import RARE
from replication.ledger.claim import ClaimControl, Kind, claim
from replication.ledger.criterion import (
    Above,
    AllOf,
    AtLeast,
    AtMost,
    Finding,
    UndecidableError,
    judge,
    undecided,
)

from pendula.claims import checks

SECTION = 2

IDENTITIES = checks("identities")


def by_algebra(
    place: str,
    statement: str,
    twins: Mapping[str, str],
    kind: Kind = Kind.IDENTITY,
    caveat: str = "",
) -> Callable:
    """Return a decorator for a claim that holds if the statements in `twins` are proved.

    A statement is proved if its residual, a polynomial, has no terms. `twins` describes a wrong
    twin of each statement; a control replaces the statement by this twin. The decorated function
    names the claim, and its docstring gives the reason for these statements.
    """

    def declare(function: Callable) -> Callable:
        @wraps(function)
        def decide(identities: xr.Dataset) -> Finding:
            left = terms_left(identities, *twins)
            return judge(left, nothing_left(left), caveat)

        controls = tuple(twin(name, wrong) for name, wrong in twins.items())
        return claim(place, statement, IDENTITIES, controls, kind=kind)(decide)

    return declare


def terms_left(identities: xr.Dataset, *names: str) -> dict[str, float]:
    """Return the number of terms in the residual of each of these statements."""
    terms = identities["terms"]
    return {f"terms_left_of_{name}": terms.sel(identity=name).max() for name in names}


def nothing_left(left: Mapping[str, float]) -> AtMost:
    """Return the criterion that the residuals of these statements have no terms."""
    return AtMost(0, *left, label="terms left of the identity")


def twin(name: str, description: str) -> ClaimControl:
    """Return the control that replaces this statement by its wrong twin."""

    def wrong(identities: xr.Dataset) -> xr.Dataset:
        is_named = identities["identity"] == name
        terms = identities["terms"].where(~is_named, identities["twin_terms"])
        return identities.assign(terms=terms)

    return ClaimControl(description, {IDENTITIES[0]: wrong})


@by_algebra(
    "Section 2, (7) and (8)",
    "The equations are the Hamiltonian system of the energy H, which is conserved.",
    {
        "(7)": "the energy of another Omega: its gradient",
        "conservation of (8)": "the energy of another Omega: its rate",
    },
)
def hamiltonian() -> None:
    """The gradient of H gives the rates of (4), and H is constant on solutions of (4)."""


@claim(
    "Abstract; Section 2",
    "The equations have no gauge symmetry, neither as (4) nor in the PT-symmetric form (10).",
    IDENTITIES,
    controls=(
        ClaimControl("gamma = 0, where both have gauge symmetry", changes.take(twin_terms="terms")),
    ),
    kind=Kind.IDENTITY,
)
def no_gauge(identities: xr.Dataset) -> Finding:
    """Require that the drive breaks the symmetry under a shift of all phases."""
    left = identities["twin_terms"].min("boundary")
    measured = {
        f"terms_left_of_{form}": left.sel(identity=f"phases of ({form}) without drive")
        for form in (4, 10)
    }
    return judge(measured, Above(0, *measured, label="terms left if all phases are shifted"))


def without_drive(lyapunov: xr.Dataset) -> xr.Dataset:
    """Return, as a control, the spectra at gamma = 0 in place of the driven ones."""
    if "exponents_undriven" not in lyapunov:
        raise UndecidableError("there are no spectra at gamma = 0")
    names = ("exponents", "exponents_error")
    return changes.take(**{name: f"{name}_undriven" for name in names})(lyapunov)


@claim(
    "Introduction",
    "The energy is the only integral of motion.",
    checks("lyapunov"),
    controls=(ClaimControl("spectra at gamma = 0, where l2 is an integral too", without_drive),),
)
def one_integral(lyapunov: xr.Dataset) -> Finding:
    size, error = abs(lyapunov["exponents"]), lyapunov["exponents_error"]
    # A second integral makes at least four exponents of each spectrum vanish. It is missed if one
    # of their intervals excludes zero by chance. Bonferroni's bound makes this improbable.
    level = 1.0 - RARE.value / (4 * lyapunov.sizes["spectrum_case"])
    wider = student(INTERVALS - 1, level) / student(INTERVALS - 1)
    pairs = 0.5 * (size <= wider * error).sum("index")
    # pairs of exponents with |exponent| + error below the mean spacing; exponents range from -max
    # to max
    between = 2.0 * size.max("index") / size.sizes["index"]
    vanishing = 0.5 * (size + wider * error < between).sum("index")
    measured = {"fewest_pairs": pairs.min(), "most_pairs": pairs.max()}
    measured["most_resolved_pairs"] = vanishing.max()
    label = "vanishing pairs of Lyapunov exponents in every spectrum"
    one_pair = AtLeast(1.0, "fewest_pairs", label=label), AtMost(1.0, "most_pairs", label=label)
    if measured["most_resolved_pairs"] <= 1.0 < measured["most_pairs"]:
        many = ", ".join(map(str, pairs["spectrum_case"].values[pairs.values > 1.0]))
        return undecided(
            measured,
            "each integral makes a pair of Lyapunov exponents vanish, and on a short chain the runs"
            f" of {many} are too short to exclude a second vanishing pair",
            AllOf(one_pair[1], AtMost(1.0, "most_resolved_pairs", label="pairs close to zero")),
        )
    caveat = (
        "each integral makes a pair of Lyapunov exponents vanish, and on short chaotic chains "
        "exactly one pair does; this excludes another integral only in the region of these runs"
    )
    fails = "a second pair of Lyapunov exponents vanishes, or none does"
    return judge(measured, AllOf(*one_pair), caveat, fails)


@by_algebra(
    "Section 2, (9) to (11)",
    "In the variables u, v the equations take the form (10), which is invariant under the action of"
    " P and T and Hamiltonian with a modified energy.",
    {
        "(10)": "form (10) with half of the drive",
        "(11)": "P without T",
        "energy of (10)": "the energy with u and v as their own conjugate variables",
    },
    caveat="P and T together are a symmetry; P alone is not",
)
def pt_form() -> None:
    """The change (9) turns (4) into (10), and H / 8 is the energy of (10)."""


@by_algebra(
    "Section 2, before (7)",
    "The equations are invariant under the exchange of A and B.",
    {"exchange of A and B": "the exchange of A and iB"},
)
def exchange() -> None:
    """An exchange of A and B exchanges their rates."""


@by_algebra(
    "Section 2, (5) and after (6)",
    "A = B is an invariant reduction on which the drive has no effect and gauge symmetry holds.",
    {
        "exchange of A and B": "the exchange of A and iB",
        "(5) without drive": "A = -B, on which the drive acts",
        "phases on A = B": "a gauge symmetry where A = -B",
    },
)
def synchronised() -> None:
    """The exchange of A and B preserves A = B, where (4) is a scalar equation without a drive."""


@by_algebra(
    "Section 2, (6)",
    "In Newton's equations a chain with x = y keeps x = y, and the drive does not affect it.",
    {"x = y is kept": "x = -y, which is kept but driven"},
)
def pendula_synchronised() -> None:
    """If x = y both accelerations are equal and contain no drive."""


@by_algebra(
    "Section 2, after (8)",
    "H is inherited from the energy of Newton's equations.",
    {"H from the energy of (1)": "the energy of another Omega"},
)
def inherited() -> None:
    """The energy of (1), averaged over a period in the rotating frame, is -H at order mu^4."""


@by_algebra(
    "Introduction; Section 6",
    "The drive acts at the 1:2 resonance with the frequency of each pendulum.",
    {"1:2 resonance": "a drive at the frequency of the pendula"},
)
def resonance() -> None:
    """Only a drive at twice the frequency gives the terms of (4)."""


@by_algebra(
    "Section 2, (2) to (4)",
    "The amplitudes of the expansion obey (4), where tau = mu^2 t / 2 and the drive D = 2 gamma"
    " mu^2 cos 2 omega t gives the term gamma (conj B - conj A).",
    {"(4) from (1) by (3)": "the slow time mu^2 t"},
)
def amplitude_equations() -> None:
    """The residual of (1) at mu^3 has no first harmonic if and only if (4) holds with this tau."""
