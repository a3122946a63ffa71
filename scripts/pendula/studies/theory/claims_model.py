"""Section 2: the equations, their symmetries, and their derivation from Newton's equations."""

import numpy as np

from pendula.ledger.claim import number
from pendula.ledger.criterion import (
    Above,
    AllOf,
    AtLeast,
    AtMost,
    Below,
    Finding,
    Near,
    judge,
    tolerance,
    within_tolerance,
)
from pendula.ledger.cutoff import Cutoff

from .deciding import NEAR, changed, decides, wrong

SECTION = 2

THIRD, SECOND = 3.0, 2.0
"""The orders in mu of the expansion's remainder, and of the energy's."""
# ASSUME: a symmetry is missing if it is missed by more than one part in a thousand.
MISSED = Cutoff(1e-3, "a symmetry is missing if more than rounding and solvers could miss it")


@decides(
    "Section 2, (7) and (8)",
    "The equations are the Hamiltonian system of the energy H.",
    "gradient",
    controls=(wrong("the energy of another Omega", "gradient"),),
)
def hamiltonian(check) -> Finding:
    return within_tolerance(check, "gradient_error")


@decides(
    "Section 2, (8)",
    "The energy H is conserved.",
    "conservation",
    controls=(wrong("the energy of another Omega", "conservation"),),
)
def conserved(check) -> Finding:
    return within_tolerance(check, "energy_drift")


@decides(
    "Abstract; Section 2",
    "The equations have no gauge symmetry.",
    "conservation",
    controls=(
        wrong("gamma = 0, where there is gauge symmetry", "conservation", instead="no_drive"),
    ),
)
def no_gauge(conservation) -> Finding:
    defect = float(conservation["gauge_defect"].max())
    return judge({"gauge_defect": defect}, Above(MISSED, "gauge_defect"))


@decides(
    "Section 2, after (6)",
    "On A = B the equations are invariant under gauge transformations.",
    "conservation",
    controls=(wrong("B = iA in place of A = B", "conservation", instead="phase_turned"),),
)
def gauge_returns(conservation) -> Finding:
    return within_tolerance(conservation, "gauge_defect_alike")


def with_another_pair(lyapunov):
    """Return the spectra with the smallest pair of exponents that is not zero set to zero."""
    size = abs(lyapunov["exponents"])
    resolved = size.where(size > lyapunov["exponents_error"]).transpose(..., "index")
    second = np.sort(resolved, axis=-1)[..., 1]  # after the first of the pair; NaN comes last
    beyond = resolved > resolved.isel(index=0, drop=True).copy(data=second)
    return lyapunov.assign(exponents=lyapunov["exponents"].where(beyond, 0.0))


@decides(
    "Introduction",
    "The energy is the only integral of motion.",
    "lyapunov",
    controls=(
        changed("a second pair of zeros, as of a second integral", "lyapunov", with_another_pair),
    ),
)
def one_integral(lyapunov) -> Finding:
    size, error = abs(lyapunov["exponents"]), lyapunov["exponents_error"]
    pairs = 0.5 * (size <= error).sum("index")
    measured = {
        "fewest_pairs": pairs.min(),
        "most_pairs": pairs.max(),
        "smallest_of_the_others": size.where(size > error).min(),
    }
    caveat = (
        "every integral makes a pair of Lyapunov exponents vanish, and on a short chain in chaos"
        " only one pair cannot be told from zero; that excludes another integral where the run"
        " went, and proves nothing elsewhere"
    )
    fails = "more than one pair of Lyapunov exponents cannot be told from zero"
    says = "vanishing pairs of Lyapunov exponents"
    return judge(measured, AtMost(1.0, "fewest_pairs", says=says), caveat, fails)


@decides(
    "Section 2, (9) and (10)",
    "In the variables u, v the equations take the form (10).",
    "pt_form",
    controls=(wrong("form (10) with half of the drive", "pt_form"),),
)
def pt_form(check) -> Finding:
    return within_tolerance(check, "rates", "trajectory")


@decides(
    "Section 2, after (11)",
    "The PT-symmetric form is Hamiltonian with a modified energy.",
    "pt_form",
    controls=(wrong("form (10) with half of the drive", "pt_form"),),
)
def pt_energy(check) -> Finding:
    return within_tolerance(check, "energy_gradient")


def image(name: str):
    """Return a change that puts another action in the place of P and T together."""
    return lambda pt: pt.assign(pt=pt[name].assign_attrs(pt["pt"].attrs))


@decides(
    "Section 2, (11)",
    "The form (10) is invariant under the action of P and T.",
    "pt_form",
    controls=(
        changed("P without T", "pt_form", image("p_alone")),
        changed("T without P", "pt_form", image("t_alone")),
    ),
)
def pt_symmetry(pt) -> Finding:
    measured = {name: pt[name].max() for name in ("pt", "p_alone", "t_alone")}
    alone = min(measured["p_alone"], measured["t_alone"])
    caveat = ""
    if alone > MISSED.value:
        caveat = "P and T together are a symmetry; either alone misses by 2 gamma max(|u|, |v|)"
    return judge(measured, AtMost(tolerance(pt, "pt"), "pt"), caveat)


@decides(
    "Section 2, before (7)",
    "The equations are invariant under the exchange of A and B.",
    "symmetries",
    controls=(wrong("the exchange of A and iB", "symmetries"),),
)
def exchange(check) -> Finding:
    return within_tolerance(check, "exchange")


@decides(
    "Section 2, (5)",
    "A = B is an invariant reduction on which the drive has no effect.",
    "symmetries",
    "opposite",
    controls=(wrong("B = iA in place of A = B", "symmetries"),),
)
def synchronised(symmetries, opposite) -> Finding:
    finding = within_tolerance(symmetries, "synchrony", "norm_drift", "scalar")
    departure = number(opposite, "departure")
    return finding._replace(measured=finding.measured | {"opposite_departure": departure})


@decides(
    "Section 2, (6)",
    "In Newton's equations x = y stays, and the drive does not affect the chain.",
    "pendula_synchrony",
    controls=(wrong("x = -y, which stays and feels the drive", "pendula_synchrony"),),
)
def pendula_synchronised(check) -> Finding:
    return within_tolerance(check, "pendula_departure", "drive_effect")


@decides(
    "Section 2, after (8)",
    "H is inherited from the energy of Newton's equations.",
    "inherited_energy",
    controls=(wrong("the energy of another Omega", "inherited_energy"),),
)
def inherited(check) -> Finding:
    static, along = check["energy_order"].values
    measured = {"averaged_order": static, "order_along_a_run": along}
    measured["smallest_difference"] = check["energy_missed"].min()
    says = "orders in mu of the difference of the averaged energy to H, and of its change"
    return judge(measured, Near(SECOND, NEAR, "averaged_order", "order_along_a_run", says=says))


@decides(
    "Introduction; Section 6",
    "The drive acts at the 1:2 resonance with the frequency of each pendulum.",
    "resonance",
    controls=(
        changed(
            "a drive at the pendula's own frequency",
            "resonance",
            lambda check: check.assign_coords(drive_ratio=2.0 * check["drive_ratio"]),
        ),
    ),
)
def resonance(check) -> Finding:
    mu = float(check["mu"][-1])
    rates = check["driven_rate"].sel(mu=mu)
    at_two = rates.sel(drive_ratio=2.0)
    measured = {"at_1_to_2": at_two, "elsewhere": rates.where(rates["drive_ratio"] != 2.0).max()}
    criterion = AllOf(
        AtLeast(1.0 - mu, "at_1_to_2", says="growth over 2 gamma at 1:2"),
        AtMost(mu, "elsewhere", says="growth over 2 gamma at other ratios"),
    )
    return judge(measured, criterion)


def reading(name: str):
    """Return a change after which the paper's reading of the expansion has the numbers of another.

    The other one takes those of the paper's.
    """

    def swapped(expansion):
        here, there = "mu^2 t / 2", name
        names = {here: there, there: here}
        labels = [names.get(str(label), str(label)) for label in expansion["reading"].values]
        return expansion.assign_coords(reading=labels)

    return swapped


@decides(
    "Section 2, after (4)",
    "The amplitudes in the expansion move with tau = mu^2 t / 2.",
    "expansion",
    controls=(
        changed("the slow time mu^2 t", "expansion", reading("mu^2 t")),
        wrong("Omega = 0 for so long that instability destroys the expansion", "expansion"),
    ),
)
def slow_time(expansion) -> Finding:
    order = number(expansion, "order", reading="mu^2 t / 2")
    measured = {"order": order, "smallest_error": expansion["angle_error"].values[-1, 0]}
    return judge(measured, Near(THIRD, NEAR, "order", says="order in mu"))


@decides(
    "Section 2, (3)",
    "The amplitudes in the expansion are functions of mu^2 t.",
    "expansion",
    controls=(changed("the slow time mu^2 t / 2", "expansion", reading("mu^2 t"), confirms=True),),
)
def printed_time(expansion) -> Finding:
    order = number(expansion, "order", reading="mu^2 t")
    measured = {"order": order, "smallest_error": expansion["angle_error"].values[-1, 1]}
    fails = f"read so, the error falls only as mu^{order:.1f}, not as mu^3"
    return judge(measured, Near(THIRD, NEAR, "order", says="order in mu"), fails=fails)


@decides(
    "Section 2, (2) and (4)",
    "The drive D = 2 gamma mu^2 cos 2 omega t gives gamma (conj B - conj A).",
    "expansion",
    controls=(changed("the opposite drive", "expansion", reading("mu^2 t / 2, opposite drive")),),
)
def drive_sign(expansion) -> Finding:
    right = number(expansion, "order", reading="mu^2 t / 2")
    opposite = number(expansion, "order", reading="mu^2 t / 2, opposite drive")
    measured = {"order": right, "order_opposite": opposite}
    here, there = (f"order in mu with the {sign} sign" for sign in ("printed", "opposite"))
    least = THIRD - NEAR.value
    criterion = AllOf(Above(least, "order", says=here), Below(least, "order_opposite", says=there))
    return judge(measured, criterion)


@decides(
    "Section 2, before (4)",
    "The remainder of the expansion stays bounded as the system evolves.",
    "remainder",
    controls=(wrong("amplitudes that move with another Omega", "remainder"),),
)
def remainder_bounded(check) -> Finding:
    end, mu = float(check["tau"][-1]), float(check["mu"][-1])
    largest = check["remainder"].sel(mu=mu).max("tau").values
    lost, omegas = check["lost"].sel(mu=mu).values, check["omega"].values
    best, worst = int(largest.argmin()), int(largest.argmax())
    measured = {"least_order": check["remainder_order"].min(), "largest": largest.max()}
    measured |= {"least": largest.min(), "lost": lost.max()}
    caveat = (
        f"with a bound that depends on Omega: by tau = {end:g} the remainder has reached"
        f" {largest[best]:.3g} at Omega = {omegas[best]:g} and {largest[worst]:.4g} at"
        f" Omega = {omegas[worst]:g}, where mu = {mu:g} leaves angles wrong by"
        f" {lost[worst]:.0%} of the largest"
    )
    says = "least order in mu of the error of the angles"
    return judge(measured, Above(THIRD - NEAR.value, "least_order", says=says), caveat)
