"""Section 4: claims on Lemma 2, the inequalities, Theorems 1 to 3, and their proofs.

P is |A|^2 + |B|^2 in l2, and delta its initial value.
"""

from functools import partial

import numpy as np
import xarray as xr
from latticode.numerics.elementary import log
from replication.ledger.changes import exchange, put, scale, take
from replication.ledger.claim import ClaimControl, Kind, claim
from replication.ledger.criterion import (
    Above,
    AllOf,
    AtLeast,
    AtMost,
    Below,
    Finding,
    Near,
    judge,
    undecided,
)
from replication.ledger.cutoff import Cutoff

from pendula.claims import checks, number

from .claims_model import by_algebra, nothing_left, terms_left, twin

SECTION = 4

# ASSUME: a quantity "grows with N", as C_N does in proportion to N, if its exponent of N is
# nearer to one than to zero.
IN_PROPORTION = Cutoff(0.5, '"grows with N": the exponent of N is nearer to 1 than to 0')
SHARP = Cutoff(0.9, '"sharp": at least 90 % of the bound is reached', ideal=1.0)
ROUNDING_OF_H = Cutoff(-1e-12, "rounding of the energy")
ONE_SOLUTION = Cutoff(1e-9, "a thousand times the tolerance of the second solver")
RESOLVED_ORDER = Cutoff(0.05, "orders are measured to one decimal")


@by_algebra(
    "Proof of Lemma 2, (16)",
    "Solutions exist locally, by Picard's method on the integral equations.",
    {name: f"{name} with 3/4 of the right side" for name in ("(17)", "(18)")},
    kind=Kind.THEOREM,
)
def local_existence() -> None:
    """Picard's method requires Lipschitz rates: (17) bounds linear terms, and (18) cubic terms."""


DISTANCE, GROWTH = "distance of two solutions", "(19)"
"""Names of two bounds proved by algebra: on the rate of a distance, and on the rate of P."""
of_lemma_2 = partial(claim, "Lemma 2", needs=checks("identities", "well_posed"), kind=Kind.THEOREM)
HALF_OF_THE_RATE = twin(DISTANCE, "a rate for half of the drive")


def of_a_neighbour(well_posed: xr.Dataset) -> xr.Dataset:
    """Return, as a control, a perturbed solution's distance as the distance between solvers."""
    near = well_posed.sel(perturbation_size=well_posed["perturbation_size"].min(), drop=True)
    return well_posed.assign(
        between_solvers=float(well_posed["perturbation_size"].min())
        * near["distance_ratio"].min("direction")
    )


def of_one_distance(well_posed: xr.Dataset) -> xr.Dataset:
    """Return, as a control, distances that do not depend on the size of the perturbation."""
    sizes = well_posed["perturbation_size"]
    return well_posed.assign(distance_ratio=well_posed["distance_ratio"] * sizes.max() / sizes)


def beyond_runs(well_posed: xr.Dataset, time: str) -> str:
    """Return the caveat that runs cover limited data, and times up to the attribute `time`."""
    largest, end = well_posed["initial_power"].max(), well_posed.attrs[time]
    return (
        f"computed from random initial conditions with P up to {largest:g} and for |tau| up to"
        f" {end:g}; beyond these it relies on the proof"
    )


@of_lemma_2(
    "For every initial condition in l2 the solution exists at all times.",
    controls=(
        twin(GROWTH, "the bound exp(2 |gamma tau|)"),
        ClaimControl(
            "runs under twice the drive of the bound",
            {"well_posed": take(steepest="steepest_of_twice_the_drive")},
        ),
    ),
)
def global_existence(identities: xr.Dataset, well_posed: xr.Dataset) -> Finding:
    """By (19) no norm becomes infinite at a finite time, so the local solution continues."""
    left = terms_left(identities, GROWTH)
    measured = {name: well_posed[name].max(skipna=False) for name in ("from_start", "steepest")}
    criterion = AllOf(
        nothing_left(left),
        AtMost(1.0, "from_start", label="largest P of a run over the bound (19)"),
        AtMost(1.0, "steepest", label="largest change of log P over 4 gamma times its duration"),
    )
    caveat = f"{beyond_runs(well_posed, 'end_time')}, where (19) keeps P finite"
    return judge(left | measured, criterion, caveat)


@of_lemma_2(
    "The solution is unique.",
    controls=(
        HALF_OF_THE_RATE,
        ClaimControl(
            "a solution from a perturbed initial condition in place of the second solver's",
            {"well_posed": of_a_neighbour},
        ),
    ),
)
def uniqueness(identities: xr.Dataset, well_posed: xr.Dataset) -> Finding:
    """The distance d of two solutions obeys d' <= (2 |gamma| + M^2 / 2) d, so d = 0 persists.

    M is the largest amplitude on the straight line between the two states. The rates of the states
    differ by the integral of the rates' derivative along this line. The identity bounds this
    derivative. Two solvers must also find the same solution.
    """
    left = terms_left(identities, DISTANCE)
    measured = {
        "rate": well_posed["rate"].max(skipna=False),
        "between_solvers": well_posed["between_solvers"].max(skipna=False),
    }
    criterion = AllOf(
        nothing_left(left),
        AtMost(1.0, "rate", label=RATE),
        Below(ONE_SOLUTION, "between_solvers", label="distance between two solvers' solutions"),
    )
    caveat = f"{beyond_runs(well_posed, 'close_time')}, where M is finite"
    return judge(left | measured, criterion, caveat)


RATE = "largest growth of the log of a distance, divided by (2 gamma + M^2 / 2) tau"


@of_lemma_2(
    "The solution depends continuously on the initial data.",
    controls=(
        HALF_OF_THE_RATE,
        ClaimControl("the same distance for every perturbation", {"well_posed": of_one_distance}),
    ),
)
def continuous_dependence(identities: xr.Dataset, well_posed: xr.Dataset) -> Finding:
    """By the rate in `uniqueness` a later distance is at most a multiple of the initial distance.

    A later distance therefore shrinks with the initial distance. It is proportional to a small
    initial distance, because the rates are smooth.
    """
    left, near = terms_left(identities, DISTANCE), well_posed.sortby("perturbation_size")
    logs = (
        log(near["perturbation_size"].values),
        log(near["distance_ratio"].transpose(..., "perturbation_size").values),
    )
    order = 1.0 + np.diff(logs[1]) / np.diff(logs[0])
    measured = {
        "rate": well_posed["rate"].max(skipna=False),
        "least_order": order.min(),
        "largest_order": order.max(),
    }
    orders = Near(
        1.0,
        RESOLVED_ORDER,
        "least_order",
        "largest_order",
        label="order of a distance in the initial one",
    )
    criterion = AllOf(nothing_left(left), AtMost(1.0, "rate", label=RATE), orders)
    caveat = f"{beyond_runs(well_posed, 'close_time')}, where the rate bounds the distance"
    return judge(left | measured, criterion, caveat)


@by_algebra(
    "Lemma 2, (19)",
    "The squared l2 norm grows at most as exp(4 |gamma tau|).",
    {"(19)": "the bound exp(2 |gamma tau|)"},
    kind=Kind.THEOREM,
)
def growth_bound() -> None:
    """The rate of P is at most 4 |gamma| P, in both directions of time."""


@by_algebra(
    "Proof of Lemma 2",
    "The l2 norm obeys the balance equation.",
    {"balance of P": "the balance equation with twice the drive"},
)
def balance() -> None:
    """The rate of P by (4) is the right side of the balance equation."""


@by_algebra(
    "Section 4, before Theorem 1",
    "It suffices to consider gamma > 0.",
    {"sign of gamma": "(A, B) -> (-A, -B) in place of (iA, iB)"},
)
def sign_of_gamma() -> None:
    """Multiplying all amplitudes by i changes the sign of gamma."""


@by_algebra(
    "Section 4, (17), (18), (22) and (27)",
    "For sequences, the sum of |a_(n+1) - a_n|^2 is at most 4 times the squared l2 norm; the l2 "
    "norm of a product is at most the product of the l2 norms; the l4 norm is at most the l2 "
    "norm, which on N sites is at most N^(1/4) times the l4 norm.",
    {name: f"{name} with 3/4 of the right side" for name in ("(17)", "(18)", "(22)", "(27)")},
)
def norm_inequalities() -> None:
    """The right side minus the left side is a sum of squares."""


HALF_OF_THE_DRIVE = "a bound of the energy with half of the drive"


@by_algebra(
    "Section 4, (21) and (25)",
    "If Omega > 2 gamma + 4 epsilon, H >= (Omega - 2 gamma - 4 epsilon) P. If Omega < -2 gamma,"
    " -H >= (|Omega| - 2 gamma) P - P^2 / 4. The energy of a sequence in l2 is finite, and of the"
    " order of P where P is small.",
    dict.fromkeys(("(21)", "(25)", "size of H"), HALF_OF_THE_DRIVE),
)
def energy_bounds() -> None:
    """H minus its lower bound, and its upper bound minus H, are sums of squares."""


CONSERVED = {"conservation of (8)": "the energy of another Omega"}


@by_algebra(
    "Theorem 1",
    "For Omega > 2 gamma + 4 epsilon the l2 norm is bounded for all initial conditions.",
    {**CONSERVED, "(21)": HALF_OF_THE_DRIVE},
    kind=Kind.THEOREM,
)
def theorem_1() -> None:
    """H is conserved, and by (21) it is at least a multiple of P."""


@by_algebra(
    "Theorem 2",
    "For Omega < -2 gamma the l2 norm is bounded for small initial conditions.",
    {**CONSERVED, "(25)": HALF_OF_THE_DRIVE},
    kind=Kind.THEOREM,
)
def theorem_2() -> None:
    """P starts below the barrier of (25), and no state of small energy has P at the barrier."""


@by_algebra(
    "Proof of Theorem 2",
    "-H > 0 for small initial conditions.",
    {"(25)": HALF_OF_THE_DRIVE},
    kind=Kind.THEOREM,
)
def positive_depth() -> None:
    """By (25) -H / P is at least a - P / 4 with a = |Omega| - 2 gamma > 0."""


@claim(
    "Proof of Theorem 2",
    "The lower bound (25) yields the upper bound (24).",
    checks("errata"),
    controls=(
        ClaimControl(
            "only states below the barrier, which continuity in time ensures",
            take(largest_power="largest_power_below"),
            confirms=True,
        ),
    ),
    kind=Kind.THEOREM,
)
def bootstrap(check: xr.Dataset) -> Finding:
    measured = {name: number(check, name) for name in ("largest_power", "allowed_power")}
    largest, allowed = measured.values()
    fails = (
        f"a state with P = {largest:.3g} satisfies (25) at an energy for which (24) allows only "
        f"{allowed:.3g}: the proof assumes the bound P <= C_0 delta that it is to prove; the "
        "theorem holds, because P is continuous in time and starts below the barrier"
    )
    label = "largest P that the proof's inequalities allow"
    return judge(measured, AtMost(allowed, "largest_power", label=label), fails=fails)


@by_algebra(
    "Theorem 3",
    "On N sites the l2 norm is bounded for all parameters and initial conditions.",
    {**CONSERVED, "lower bound for Theorem 3": HALF_OF_THE_DRIVE},
    kind=Kind.THEOREM,
)
def theorem_3() -> None:
    """H is conserved. By its lower bound and (27) H is at least P^2 / (8 N) - const P."""


@claim(
    "Proof of Theorem 3",
    "The quadratic part of H is at least -(|Omega| + gamma + 4 epsilon) P.",
    checks("errata"),
    controls=(ClaimControl("2 gamma in place of gamma", take(printed="corrected"), confirms=True),),
    kind=Kind.THEOREM,
)
def theorem_3_proof(check: xr.Dataset) -> Finding:
    measured = {name: check[name].min() for name in ("printed", "corrected")}
    measured["smallest_chain"] = smallest = number(check, "smallest")
    fails = (
        f"A = -B = x (-1)^n violates it on {smallest:.0f} or more sites; with 2 gamma in place of "
        "gamma it holds"
    )
    return judge(
        measured, AtLeast(ROUNDING_OF_H, "printed", label="H minus the bound"), fails=fails
    )


ABOVE_THE_BAND = exchange("omega", 0.0, 8.0)


@claim(
    "Theorem 3",
    "The bound C_N grows without bound with N, and must do so.",
    checks("chain_growth"),
    controls=(ClaimControl("Omega = 8, where Theorem 1 bounds P on any chain", ABOVE_THE_BAND),),
)
def bound_grows(check: xr.Dataset) -> Finding:
    """Require that both C_N and the largest P at a fixed energy grow with N."""
    measured = {
        name: number(check, name, omega=0.0) for name in ("constant_exponent", "shell_exponent")
    }
    caveat = "it must grow at Omega = 0; above the band Theorem 1 gives one bound for all N"
    criterion = AllOf(
        Above(IN_PROPORTION, "constant_exponent", label="exponent of N in C_N"),
        Above(
            IN_PROPORTION, "shell_exponent", label="exponent of N in the largest P at one energy"
        ),
    )
    return judge(measured, criterion, caveat)


@claim(
    "Section 5, before Fig 4",
    "At Omega = 0 the energy does not control large solutions.",
    checks("chain_growth"),
    controls=(ClaimControl("Omega = 8, where the energy bounds P", ABOVE_THE_BAND),),
)
def energy_not_useful(check: xr.Dataset) -> Finding:
    measured = {"shell_exponent": number(check, "shell_exponent", omega=0.0)}
    label = "exponent of N in the largest P at one energy"
    return judge(measured, Above(IN_PROPORTION, "shell_exponent", label=label))


SIZES = ("theorem_1", "theorem_2")
"""The theorems with bounds proportional to P(0) for small data."""


@claim(
    "Section 6; Theorems 1 and 2",
    "The bounds on the l2 norm are sharp in terms of the parameters and of the size of the initial"
    " condition.",
    checks("sharpness"),
    controls=(
        ClaimControl(
            "the least constants in place of the proofs'",
            take(proof_constant="least_constant"),
            confirms=True,
        ),
        ClaimControl("initial conditions from which P does not grow", put("least_constant", 1.0)),
        ClaimControl("bounds in terms of H that are 25 % too large", scale("reached", 0.8)),
    ),
)
def sharp_theorems(check: xr.Dataset) -> Finding:
    """Compare the bounds P <= C delta for small data with the largest growth of P.

    The paper prints no constants C. They may be the least possible constants, or the larger ones
    that follow from its proofs. If only bounds with the larger constants are not attained, the
    claim is undecided.
    """
    measured = {}
    for theorem in SIZES:
        proof, least = (number(check, f"{name}_constant", theorem=theorem) for name in FORMS)
        measured |= {f"proof_constant_{theorem}": proof, f"least_constant_{theorem}": least}
        measured[f"share_{theorem}"] = least / proof
    measured |= {
        f"by_energy_{form}": number(check, "reached", form=form) for form in check["form"].values
    }
    shares = [f"share_{theorem}" for theorem in SIZES]
    growths = Above(
        1.0, *(f"least_constant_{theorem_name}" for theorem_name in SIZES), label="growth of P"
    )
    by_energy = Above(
        SHARP,
        *(name for name in measured if name.startswith("by_energy")),
        label="attained share of the bound in terms of H",
    )
    by_size = Above(SHARP, *shares, label="attained share of the bound in terms of delta")
    sharp = AllOf(growths, by_energy, by_size)
    if set(sharp.failing(measured)) == set(shares):
        return undecided(measured, _by_energy_alone(measured), sharp)
    return judge(measured, sharp)


FORMS = ("proof", "least")


def _by_energy_alone(measured: dict[str, float]) -> str:
    first, second = (
        {form: measured[f"{form}_constant_{theorem}"] for form in FORMS} for theorem in SIZES
    )
    reached = min(value for name, value in measured.items() if name.startswith("by_energy"))
    return (
        "the paper prints no constants: for small initial conditions with P(0) = delta the"
        f" inequalities of its proofs give P <= {first['proof']:.3g} delta at Omega = 8 and"
        f" {second['proof']:.3g} delta at Omega = -4, but {first['least']:.3g} delta and"
        f" {second['least']:.3g} delta are enough; at least"
        f" {np.floor(1e4 * reached) / 100:g}% of each bound in terms of H is attained"
    )
