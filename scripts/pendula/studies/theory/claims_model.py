"""Section 2: the equations, their symmetries, and their derivation from Newton's equations."""

import numpy as np
from latticode.measures.confidence import student
from latticode.measures.growth import PARTS

from pendula.ledger import changes
from pendula.ledger.claim import Control, Kind, checks, claim
from pendula.ledger.criterion import (
    Above,
    AllOf,
    AtLeast,
    AtMost,
    Finding,
    UndecidableError,
    judge,
    undecided,
)
from pendula.ledger.cutoff import Cutoff

SECTION = 2

# ASSUME: an order counts as a whole number if it is nearer to that than to another.
NEAR = Cutoff(0.5, "an order counts as the nearest whole number")
SIGNIFICANT = Cutoff(0.05, "the level that is customary in statistics, for all spectra together")


def proved(identities, *names: str) -> Finding:
    """Require that nothing is left of these statements, with any ends."""
    left = {f"terms_left_of_{name}": identities["terms"].sel(identity=name).max() for name in names}
    return judge(left, AtMost(0, *left, says="terms left of the identity"))


def twin(name: str, says: str) -> Control:
    """Return the control that has the wrong twin in the place of the statement of this name."""

    def wrong(identities):
        here = identities["identity"] == name
        terms = identities["terms"].where(~here, identities["twin_terms"])
        return identities.assign(terms=terms)

    return Control(says, {"checks/identities": wrong})


IDENTITIES = checks("identities")


@claim(
    "Section 2, (7) and (8)",
    "The equations are the Hamiltonian system of the energy H, which is conserved.",
    IDENTITIES,
    controls=(
        twin("(7)", "the energy of another Omega: its gradient"),
        twin("conservation of (8)", "the energy of another Omega: its rate"),
    ),
    kind=Kind.IDENTITY,
)
def hamiltonian(identities) -> Finding:
    return proved(identities, "(7)", "conservation of (8)")


@claim(
    "Abstract; Section 2",
    "The equations have no gauge symmetry, neither as (4) nor in the PT-symmetric form (10).",
    IDENTITIES,
    controls=(
        Control("gamma = 0, where both have gauge symmetry", changes.take(twin_terms="terms")),
    ),
    kind=Kind.IDENTITY,
)
def no_gauge(identities) -> Finding:
    """Turning all phases is a symmetry without the drive; with it terms must be left."""
    left = identities["twin_terms"].min("boundary")
    measured = {
        f"terms_left_of_{form}": left.sel(identity=f"phases of ({form}) without drive")
        for form in (4, 10)
    }
    return judge(measured, Above(0, *measured, says="terms left if all phases are turned"))


def without_drive(lyapunov):
    """Return the spectra with those of the shortest chain at gamma = 0 in their place."""
    if "exponents_undriven" not in lyapunov:
        raise UndecidableError("there are no spectra at gamma = 0")
    short = lyapunov.isel(spectrum_half_width=[0])
    along = {"spectrum_half_width": short["spectrum_half_width"].values}
    names = ("exponents", "exponents_error")
    return short.assign({name: short[f"{name}_undriven"].expand_dims(along) for name in names})


def with_another_pair(lyapunov):
    """Return the spectra with the pair of exponents that is second from zero at zero, exactly."""
    size = abs(lyapunov["exponents"])
    fourth = np.sort(size.transpose(..., "index"), axis=-1)[..., 3]  # NaN comes last
    beyond = size > size.isel(index=0, drop=True).copy(data=fourth)
    both = lyapunov[["exponents", "exponents_error"]].where(beyond | size.isnull(), 0.0)
    return lyapunov.assign(both)


@claim(
    "Introduction",
    "The energy is the only integral of motion.",
    checks("lyapunov"),
    controls=(
        Control("spectra at gamma = 0, where l2 is an integral too", without_drive),
        Control("spectra with an added second pair of zeros", with_another_pair),
    ),
)
def one_integral(lyapunov) -> Finding:
    size, error = abs(lyapunov["exponents"]), lyapunov["exponents_error"]
    along = ("spectrum_case", "spectrum_half_width")
    # With a second integral at least four exponents of a spectrum vanish, and one of these beyond
    # its limits is enough to hide it: Bonferroni's bound, over the four of every spectrum.
    spectra = int(np.prod([lyapunov.sizes[name] for name in along]))
    level = 1.0 - SIGNIFICANT.value / (4 * spectra)
    wider = student(PARTS - 1, level) / student(PARTS - 1)
    pairs = (0.5 * (size <= wider * error).sum("index")).stack(spectrum=along)
    # those that lie nearer to zero than exponents to each other
    between = 2.0 * size.max("index") / size.notnull().sum("index")
    told = 0.5 * (size + wider * error < between).sum("index")
    measured = {"fewest_pairs": pairs.min(), "most_pairs": pairs.max(), "wider_limits": wider}
    measured["most_resolved_pairs"] = told.max()
    measured |= {
        f"pairs_{case}_{half_width}": count
        for (case, half_width), count in zip(pairs["spectrum"].values, pairs.values, strict=True)
    }
    if measured["most_resolved_pairs"] <= 1.0 < measured["most_pairs"]:
        many = [f"{c}, M = {m}" for c, m in pairs["spectrum"].values[pairs.values > 1.0]]
        return undecided(
            measured,
            f"each integral makes a pair of Lyapunov exponents vanish, and in {len(many)} spectra "
            f"({'; '.join(many)}) the runs are too short to exclude that a second pair vanishes",
        )
    caveat = (
        "each integral makes a pair of Lyapunov exponents vanish, and on short chaotic chains "
        "exactly one pair does; this excludes another integral only where these runs went"
    )
    fails = "a second pair of Lyapunov exponents vanishes, or none does"
    says = "vanishing pairs of Lyapunov exponents in every spectrum"
    criterion = AllOf(AtLeast(1.0, "fewest_pairs", says=says), AtMost(1.0, "most_pairs", says=says))
    return judge(measured, criterion, caveat, fails)


@claim(
    "Section 2, (9) to (11)",
    "In the variables u, v the equations take the form (10), which is invariant under the action of"
    " P and T and Hamiltonian with a modified energy.",
    IDENTITIES,
    controls=(
        twin("(10)", "form (10) with half of the drive"),
        twin("(11)", "P without T"),
        twin("(11) by P and T together", "T without P"),
        twin("energy of (10)", "the energy with u and v as their own conjugate variables"),
    ),
    kind=Kind.IDENTITY,
)
def pt_form(identities) -> Finding:
    symmetry = ["(11)", "(11) by P and T together"]
    finding = proved(identities, "(10)", *symmetry, "energy of (10)")
    alone = identities["twin_terms"].sel(identity=symmetry).min()
    caveat = "the symmetry is that of P and T together; neither alone is one" if alone > 0 else ""
    return judge(finding.measured, finding.criterion, caveat, finding.because)


@claim(
    "Section 2, before (7)",
    "The equations are invariant under the exchange of A and B.",
    IDENTITIES,
    controls=(twin("exchange of A and B", "the exchange of A and iB"),),
    kind=Kind.IDENTITY,
)
def exchange(identities) -> Finding:
    return proved(identities, "exchange of A and B")


@claim(
    "Section 2, (5) and after (6)",
    "A = B is an invariant reduction on which the drive has no effect and gauge symmetry holds.",
    IDENTITIES,
    controls=(
        twin("A = B is kept", "A = B in place of which there is A = -B"),
        twin("(5) without drive", "A = -B, on which the drive acts"),
        twin("phases on A = B", "a gauge symmetry where A = -B"),
    ),
    kind=Kind.IDENTITY,
)
def synchronised(identities) -> Finding:
    return proved(identities, "A = B is kept", "(5) without drive", "phases on A = B")


@claim(
    "Section 2, (6)",
    "In Newton's equations a chain with x = y keeps x = y, and the drive does not affect it.",
    IDENTITIES,
    controls=(twin("x = y is kept", "x = -y, which is kept but driven"),),
    kind=Kind.IDENTITY,
)
def pendula_synchronised(identities) -> Finding:
    return proved(identities, "x = y is kept")


@claim(
    "Section 2, after (8)",
    "H is inherited from the energy of Newton's equations.",
    IDENTITIES,
    controls=(twin("H from the energy of (1)", "the energy of another Omega"),),
    kind=Kind.IDENTITY,
)
def inherited(identities) -> Finding:
    """In the frame that turns with the pendula, averaged over a turn, it is -H at mu^4."""
    return proved(identities, "H from the energy of (1)")


@claim(
    "Introduction; Section 6",
    "The drive acts at the 1:2 resonance with the frequency of each pendulum.",
    IDENTITIES,
    controls=(twin("1:2 resonance", "a drive at the frequency of the pendula"),),
    kind=Kind.IDENTITY,
)
def resonance(identities) -> Finding:
    return proved(identities, "1:2 resonance")


@claim(
    "Section 2, (2) to (4)",
    "The amplitudes of the expansion obey (4), where tau = mu^2 t / 2 and the drive D = 2 gamma"
    " mu^2 cos 2 omega t gives the term gamma (conj B - conj A).",
    IDENTITIES,
    controls=(
        twin("(4) from (1) by (3)", "the slow time mu^2 t"),
        twin("(4) from (1) by the drive (2)", "a drive of the opposite sign"),
    ),
    kind=Kind.IDENTITY,
)
def amplitude_equations(identities) -> Finding:
    """What (1) leaves of order mu^3 has no first harmonic, and only then with (4) and this tau."""
    return proved(identities, "(4) from (1) by (3)", "(4) from (1) by the drive (2)")
