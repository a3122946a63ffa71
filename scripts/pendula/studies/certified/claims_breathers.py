"""What is proved of steady breathers, and of the constants of the paper's theorems."""

import numpy as np

from pendula.ledger.claim import Control, claim
from pendula.ledger.criterion import (
    AllOf,
    AtLeast,
    AtMost,
    Below,
    Finding,
    UndecidableError,
    judge,
)
from pendula.ledger.cutoff import Cutoff

from .states import Verdict

SECTION = 7
PLACE = "Section 6, breathers"

PROVED, STEADY, CONSTANTS = "certified/breathers", "breathers/steady", "certified/constants"

NEAR = Cutoff(1e-12, "a state is told to twelve digits")
DIGITS = Cutoff(1e-12, "doubles of sixteen digits, four left for rounding and differences")
RATE_DIGITS = Cutoff(1e-6, "rates of growth are stored with seven digits")


def wrong_state(index: int):
    """Return what puts the radius of a wrong state in the place of all others."""

    def changed(proved):
        return proved.assign(radius=proved["radius"] * 0.0 + proved["wrong_radius"][index])

    return changed


@claim(
    PLACE,
    "Steady breathers exist on the infinite chain: a theorem for each of the states computed.",
    (PROVED,),
    (
        Control("a state tested inside the band of waves", {PROVED: wrong_state(0)}),
        Control("a state tested at an Omega beside its own", {PROVED: wrong_state(1)}),
    ),
)
def breathers_exist(proved) -> Finding:
    """Ask for a radius of each state within which a true one lies, and for no other one near."""
    measured = {
        "proofs": proved.sizes["proof"],
        "largest_radius": proved["radius"].max(skipna=False),
        "largest_contraction": proved["contraction"].max(skipna=False),
        "least_unique_radius": proved["unique_radius"].min(skipna=False),
        "largest_tail_factor": proved["tail_factor"].max(skipna=False),
    }
    criterion = AllOf(
        AtLeast(1, "proofs"),
        Below(NEAR, "largest_radius", says="largest distance to the true state"),
        Below(1.0, "largest_tail_factor", says="decay from site to site"),
    )
    return judge(measured, criterion)


def with_verdicts(verdict: Verdict):
    """Return what gives all states one verdict."""
    return lambda proved: proved.assign(stable=proved["stable"] * 0 + int(verdict))


@claim(
    PLACE,
    "Some steady breathers on a finite chain are stable and others are not, as theorems.",
    (PROVED,),
    tuple(
        Control(f"spectra that are all {verdict.name.lower()}", {PROVED: with_verdicts(verdict)})
        for verdict in Verdict
    ),
)
def breathers_stable_or_not(proved) -> Finding:
    """Count what enclosed spectra prove; a spectrum that proves nothing is no verdict."""
    count = {one: (proved["stable"] == int(one)).sum() for one in Verdict}
    measured = {
        "proved_stable": count[Verdict.STABLE],
        "proved_unstable": count[Verdict.UNSTABLE],
        "undecided": count[Verdict.UNDECIDED],
        "largest_radius": proved["chain_radius"].max(skipna=False),
    }
    criterion = AllOf(
        AtLeast(1, "proved_stable", "proved_unstable"),
        Below(NEAR, "largest_radius", says="largest distance to the true state of the chain"),
    )
    open_ones = int(count[Verdict.UNDECIDED])
    return judge(measured, criterion, f"{open_ones} spectra leave it open" if open_ones else "")


def of_half_rate(steady):
    """Return rates of growth that are half as large."""
    return steady.assign(growth_half=0.5 * steady["growth_half"])


def known_stable(steady):
    """Return the steady states as if none of them grew."""
    return steady.assign(growth_half=0.0 * steady["growth_half"])


@claim(
    PLACE,
    "The rates of growth of steady states, as computed, agree with the proved ones.",
    (PROVED, STEADY),
    (
        Control("half the rates", {STEADY: of_half_rate}),
        Control("no growth", {STEADY: known_stable}),
    ),
)
def growth_as_proved(proved, steady) -> Finding:
    """Compare the states that both studies have, on chains of one half-width."""
    if int(steady["chain_half_width"][0]) != int(proved.attrs["chain_half_width"]):
        raise UndecidableError("the two studies have chains of different lengths")
    if float(steady.attrs["gamma"]) != float(proved.attrs["gamma"]):
        raise UndecidableError("the two studies have different drives")
    off = []
    for i in range(proved.sizes["proof"]):
        one = proved.isel(proof=i)
        name, omega = str(one["family"].item()), float(one["omega"])
        if float(one["epsilon"]) != float(steady.attrs["epsilon"]) or (
            name not in steady["family"].values or omega not in steady["omega"].values
        ):
            continue
        rate = float(steady["growth_half"].sel(family=name, omega=omega))
        beyond = [rate - float(one["growth_high"]), float(one["growth_low"]) - rate, 0.0]
        off.append(np.max(beyond) / max(rate, 1.0))
    if not off:
        raise UndecidableError("no state is in both studies")
    measured = {"states": len(off), "largest_difference": np.max(off)}
    return judge(
        measured, AtMost(RATE_DIGITS, "largest_difference", says="distance from the enclosure")
    )


def of_next_constant(constants):
    """Return the constants with what was stored of the one before each."""
    return constants.assign(stored=("constant", np.roll(constants["stored"].values, 1)))


def with_other_digit(constants):
    """Return the constants as if their eleventh digits were off by one."""
    return constants.assign(stored=constants["stored"] * (1.0 + 1e-11))


@claim(
    "Lemma 1 and Theorems 1 to 3",
    "The constants of the theorems, as computed here in doubles, are right to twelve digits.",
    (CONSTANTS,),
    (
        Control("the constants in another order", {CONSTANTS: of_next_constant}),
        Control("constants with another eleventh digit", {CONSTANTS: with_other_digit}),
    ),
)
def constants_enclosed(constants) -> Finding:
    """Ask how far each stored number lies from the farther end of what encloses the true one."""
    lower, upper, stored = (constants[name] for name in ("lower", "upper", "stored"))
    size = np.maximum(1.0, np.minimum(abs(lower), abs(upper)))
    off = np.maximum(abs(upper - stored), abs(stored - lower)) / size
    measured = {
        "constants": constants.sizes["constant"],
        "largest_error": off.max(skipna=False),
        "inside": ((lower <= stored) & (stored <= upper)).mean(),
    }
    criterion = AllOf(
        AtLeast(1, "constants"),
        Below(DIGITS, "largest_error", says="largest error, relative above one"),
    )
    return judge(measured, criterion)
