"""Section 2: the equations, their symmetries, and their derivation from Newton's equations."""

import numpy as np

from pendula.ledger import changes
from pendula.ledger.claim import Control, checks, claim, number
from pendula.ledger.criterion import (
    Above,
    AllOf,
    AtLeast,
    AtMost,
    Below,
    Finding,
    Near,
    UndecidableError,
    judge,
    undecided,
    within_tolerance,
)
from pendula.ledger.cutoff import Cutoff
from pendula.measures.confidence import student
from pendula.measures.growth import PARTS

SECTION = 2

RIGHT, OPPOSITE = "mu^2 t / 2", "mu^2 t / 2, opposite drive"
"""Readings of the expansion: the paper's, and the one with a drive of the other sign."""
# ASSUME: an order in mu counts as a whole number if it is nearer to that than to another.
NEAR = Cutoff(0.5, "an order counts as the nearest whole number")
THIRD, SECOND = 3.0, 2.0
"""The orders in mu of the expansion's remainder, and of the energy's."""
# ASSUME: a symmetry is missing if it is missed by more than one part in a thousand.
MISSED = Cutoff(1e-3, "a symmetry is broken if its defect exceeds rounding and solver errors")
SIGNIFICANT = Cutoff(0.05, "the level that is customary in statistics, for all spectra together")
# ASSUME: a drive acts where growth is nearer to the 2 gamma of the resonance than to none.
ACTS = Cutoff(0.5, "the growth rate is nearer to 2 gamma, that at resonance, than to 0")


def wrong(name: str, check: str = "") -> dict[str, str]:
    """Return what feeds a check the wrong statement `check`, or the one of its own name."""
    return {name: f"checks/wrong/{check or name}"}


@claim(
    "Section 2, (7) and (8)",
    "The equations are the Hamiltonian system of the energy H, which is conserved.",
    checks("gradient", "conservation"),
    controls=(
        Control("the energy of another Omega: its gradient", wrong("gradient")),
        Control("the energy of another Omega: its drift", wrong("conservation")),
    ),
)
def hamiltonian(gradient, conservation) -> Finding:
    drift = conservation["energy_drift"].max(keep_attrs=True)
    return within_tolerance(gradient.assign(energy_drift=drift), "gradient_error", "energy_drift")


@claim(
    "Abstract; Section 2",
    "The equations have no gauge symmetry, neither as (4) nor in the PT-symmetric form (10).",
    checks("conservation", "pt_form"),
    controls=(
        Control("gamma = 0, where (4) has gauge symmetry", wrong("conservation", "no_drive")),
        Control("gamma = 0, where (10) has gauge symmetry", wrong("pt_form", "pt_no_drive")),
    ),
)
def no_gauge(conservation, pt) -> Finding:
    measured = {
        "gauge_defect": conservation["gauge_defect"].max(),
        "gauge_defect_pt": pt["gauge_defect"].max(),
    }
    says = "change of (4) and of (10) if all phases are turned"
    return judge(measured, Above(MISSED, *measured, says=says))


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
    measured["most_told_pairs"] = told.max()
    measured |= {
        f"pairs_{case}_{half_width}": count
        for (case, half_width), count in zip(pairs["spectrum"].values, pairs.values, strict=True)
    }
    if measured["most_told_pairs"] <= 1.0 < measured["most_pairs"]:
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
    checks("pt_form"),
    controls=(
        Control("form (10) with half of the drive", "checks/wrong/pt_form"),
        Control("P without T", changes.take(pt="p_alone")),
        Control("T without P", changes.take(pt="t_alone")),
    ),
)
def pt_form(check) -> Finding:
    finding = within_tolerance(check, "rates", "trajectory", "pt", "energy_gradient")
    alone = {name: float(check[name].max()) for name in ("p_alone", "t_alone")}
    caveat = ""
    if min(alone.values()) > MISSED.value:
        caveat = "the symmetry is that of P and T together; neither alone is one"
    return judge(finding.measured | alone, finding.criterion, caveat, finding.because)


@claim(
    "Section 2, before (7)",
    "The equations are invariant under the exchange of A and B.",
    checks("symmetries"),
    controls=(Control("the exchange of A and iB", "checks/wrong/symmetries"),),
)
def exchange(check) -> Finding:
    return within_tolerance(check, "exchange")


@claim(
    "Section 2, (5) and after (6)",
    "A = B is an invariant reduction on which the drive has no effect and gauge symmetry holds.",
    checks("symmetries", "conservation", "opposite"),
    controls=(
        Control("B = iA in place of A = B", wrong("symmetries")),
        Control("a gauge symmetry where B = iA", wrong("conservation", "phase_turned")),
    ),
)
def synchronised(symmetries, conservation, opposite) -> Finding:
    gauge = conservation["gauge_defect_alike"].max(keep_attrs=True)
    names = ("synchrony", "norm_drift", "scalar", "gauge_defect_alike")
    finding = within_tolerance(symmetries.assign(gauge_defect_alike=gauge), *names)
    departure = number(opposite, "departure")
    return finding._replace(measured=finding.measured | {"opposite_departure": departure})


@claim(
    "Section 2, (6)",
    "In Newton's equations a chain with x = y keeps x = y, and the drive does not affect it.",
    checks("pendula_synchrony"),
    controls=(Control("x = -y, which is kept but driven", "checks/wrong/pendula_synchrony"),),
)
def pendula_synchronised(check) -> Finding:
    return within_tolerance(check, "pendula_departure", "drive_effect")


@claim(
    "Section 2, after (8)",
    "H is inherited from the energy of Newton's equations.",
    checks("inherited_energy"),
    controls=(Control("the energy of another Omega", "checks/wrong/inherited_energy"),),
)
def inherited(check) -> Finding:
    static, along = check["energy_order"].values
    measured = {"averaged_order": static, "order_along_a_run": along}
    measured["smallest_difference"] = check["energy_missed"].min()
    says = "orders in mu of the difference between the averaged energy and H, and of its change"
    return judge(measured, Near(SECOND, NEAR, "averaged_order", "order_along_a_run", says=says))


@claim(
    "Introduction; Section 6",
    "The drive acts at the 1:2 resonance with the frequency of each pendulum.",
    checks("resonance"),
    controls=(
        Control(
            "a drive at the frequency of the pendula",
            lambda check: check.assign_coords(drive_ratio=2.0 * check["drive_ratio"]),
        ),
    ),
)
def resonance(check) -> Finding:
    rates = check["driven_rate"].isel(mu=-1)
    elsewhere = rates.where(rates["drive_ratio"] != 2.0).max()
    measured = {"at_1_to_2": rates.sel(drive_ratio=2.0), "elsewhere": elsewhere}
    criterion = AllOf(
        Above(ACTS, "at_1_to_2", says="growth rate over 2 gamma at 1:2"),
        Below(ACTS, "elsewhere", says="growth rate over 2 gamma at other ratios"),
    )
    return judge(measured, criterion)


@claim(
    "Section 2, (3) and after (4)",
    "The amplitudes in the expansion depend on time through tau = mu^2 t / 2.",
    checks("expansion"),
    controls=(
        Control("the slow time mu^2 t", changes.exchange("reading", RIGHT, "mu^2 t")),
        Control("the slow time mu t / 2", changes.exchange("reading", RIGHT, "mu t / 2")),
        Control(
            "a run at Omega = 0 so long that the instability ends the validity of the expansion",
            "checks/wrong/expansion",
        ),
    ),
    fact="order of the expansion",
)
def slow_time(expansion) -> Finding:
    """What is a function of mu^2 t / 2 is one of mu^2 t, and of no other power of mu times t."""
    order = expansion["order"]
    measured = {
        "order": order.sel(reading=RIGHT),
        "order_without_the_half": order.sel(reading="mu^2 t"),
        "order_by_another_power": order.sel(reading="mu t / 2"),
        "smallest_error": expansion["angle_error"].sel(reading=RIGHT)[-1],
    }
    return judge(measured, Near(THIRD, NEAR, "order", says="order in mu of the error"))


@claim(
    "Section 2, (2) and (4)",
    "The drive D = 2 gamma mu^2 cos 2 omega t gives the term gamma (conj B - conj A) of (4).",
    checks("expansion"),
    controls=(
        Control("a drive of the opposite sign", changes.exchange("reading", RIGHT, OPPOSITE)),
    ),
    fact="order of the expansion",
)
def drive_sign(expansion) -> Finding:
    order = expansion["order"].sel
    measured = {"order": order(reading=RIGHT), "order_opposite": order(reading=OPPOSITE)}
    here, there = (f"order in mu with the {sign} sign" for sign in ("printed", "opposite"))
    least = THIRD - NEAR.value
    criterion = AllOf(Above(least, "order", says=here), Below(least, "order_opposite", says=there))
    return judge(measured, criterion)
