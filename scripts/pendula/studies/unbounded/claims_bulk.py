"""The state behind the front: it is compared with the thermal state, and nothing is fitted.

Energy is the only integral, and a front that is pulled leaves none behind. So the equilibrium is
the thermal state of no energy, which `thermal` solves to many digits. Only the errors of the bulk
count. They are the limits of means over the members of an ensemble, by Student's t.
"""

from collections.abc import Callable

import numpy as np

from pendula.ledger.changes import put, roll, scale
from pendula.ledger.claim import CHANGE, CONSTANT, Control, claim, unbounded
from pendula.ledger.criterion import (
    Above,
    AllOf,
    AtLeast,
    AtMost,
    Finding,
    Near,
    UndecidableError,
    judge,
    undecided,
)
from pendula.ledger.cutoff import once
from pendula.measures.confidence import Limits, mean_limits
from pendula.numerics.elementary import interpolated

from . import bulk
from .claims import sure, times_of
from .measured import BULK, FRONT

SECTION = 5

slopes_of = once(bulk.slope_powers)


def ratios_of(limits: list[Limits], thermal, omegas: np.ndarray) -> list[Limits]:
    """Return limits of P at each Omega over the P of the thermal state there."""
    pairs = zip(limits, bulk.thermal_powers(thermal, omegas), strict=True)
    return [Limits(*(bound / expected for bound in one)) for one, expected in pairs]


def told_apart(omegas: np.ndarray, ratios: list[Limits], what: str) -> str:
    """Return the caveat that names each Omega where the limits do not hold the thermal state."""
    apart = [
        f"{omega:g} ({100.0 * (ratio.value - 1.0):+.1f} %)"
        for omega, ratio in zip(omegas, ratios, strict=True)
        if not ratio.low < 1.0 < ratio.high
    ]
    off = f"{what} differs from that of the thermal state at Omega = {', '.join(apart)}"
    return off if apart else ""


def at_energy(thermal, energy: float) -> dict[str, float]:
    """Return P, its rise with the energy, and the cubic term, each a site, of a thermal state.

    They are interpolated between the solved states.
    """
    solved = thermal["site_energy"].values
    if solved.size < 2 or not solved[0] <= energy <= solved[-1]:
        raise UndecidableError(f"no thermal state of energy {energy:.3g} per site was computed")
    powers, cubic = thermal["warm_power"].values, thermal["warm_terms"].sel(term="cubic").values
    below = max(int(np.searchsorted(solved, energy)) - 1, 0)
    return {
        "power": float(interpolated(energy, solved, powers)),
        "rise": float(np.diff(powers)[below] / np.diff(solved)[below]),
        "cubic": float(interpolated(energy, solved, cubic)),
    }


# --- Wrong cases ----------------------------------------------------------------------------------


def noise(run):
    """Return the run with noise for the power of its bulk, of the mean that it had."""
    powers = run["bulk_power"]
    drawn = np.random.default_rng(2017).exponential(float(powers.mean()), powers.shape)
    return run.assign(bulk_power=(powers.dims, drawn))


def on_every_second(run, value: float):
    """Return this number on the even members of a run, and that of the other sign on the rest."""
    return run["member"].copy(data=value * (1.0 - 2.0 * (np.arange(run.sizes["member"]) % 2)))


def as_of_waves(run):
    """Return the run with a power of its bulk that falls as 1 / tau."""
    return scale("bulk_power", run["piece_tau"][-1] / run["piece_tau"])(run)


def held_to_the_nearest(right, other):
    """Return another run as one at the nearest Omega of the right one: this has a thermal state."""
    nearest = int(np.abs(right["omega"].values - float(other["omega"][0])).argmin())
    return other.assign(omega=("variant", right["omega"].values[[nearest]]))


def behind_its_front(right, other):
    """Return another run as one at the Omega of the right one, behind a front of that speed."""
    names = ("omega", "predicted_speed", "predicted_delay")
    return other.assign({name: ("variant", right[name].values[:1]) for name in names})


def with_power(warm: bool) -> Callable:
    """Return a control that gives the bulk P of the thermal state of its energy, or of none.

    At every look P follows the energy, as far as it rises with it, and members are a little apart.
    """

    def change(run, thermal):
        energies = run["bulk_terms"].sum("term").transpose(*run["bulk_power"].dims)
        mean = float(bulk.mean_terms(run, BULK)[0].sum(axis=1).mean())
        state = at_energy(thermal, mean if warm else 0.0)
        follows = state["rise"] * (energies - mean) if warm else 0.0 * energies
        power = state["power"] + follows + on_every_second(run, SCATTER)
        return run.assign(bulk_power=power.transpose(*energies.dims))

    return change


SCATTER = 0.01
"""By how much P of made-up members is off: little, and enough for limits."""


NEXT_OMEGA = roll("power", {"omega": 1})
STILL = tuple(
    Control(
        f"the stable run {name}, compared with the thermal state at the nearest Omega",
        {"unbounded/omegas": (f"unbounded/{name}", held_to_the_nearest)},
    )
    for name in ("fig2_large", "fig3_small")
)


@claim(
    "Abstract; Introduction",
    "The process continues until a dynamical equilibrium is reached where each pendulum oscillates"
    " at a finite amplitude.",
    unbounded("omegas", "thermal"),
    (
        *STILL,
        Control("the thermal states of the next Omega", {"thermal": NEXT_OMEGA}),
        Control("a P that falls as 1 / tau, as for dispersing waves", {"omegas": as_of_waves}),
        Control("noise of the same mean in place of P", {"omegas": noise}),
    ),
    reading="infinite chain",
)
def unbounded_equilibrium(run, thermal) -> Finding:
    times_of(run)
    omegas, powers = run["omega"].values, bulk.bulk_powers(run, FRONT)
    limits = [mean_limits(one, sure(len(omegas))) for one in bulk.mean_powers(run, FRONT)]
    ratios = ratios_of(limits, thermal, omegas)
    third, last = bulk.late_means(powers, run, 2).mean(axis=2)
    change = last / third
    measured = {
        "least": min(one.value for one in ratios),
        "largest": max(one.value for one in ratios),
        "at_least": min(one.low for one in ratios),
        "at_most": max(one.high for one in ratios),
        "least_change": change.min(),
        "largest_change": change.max(),
    }
    criterion = AllOf(
        Near(1.0, CHANGE, "at_least", "at_most", says="confidence interval of P over thermal P"),
        Near(
            1.0,
            CHANGE,
            "least_change",
            "largest_change",
            says="P in the last quarter of the run over the third",
        ),
    )
    return judge(measured, criterion, told_apart(omegas, ratios, "P"))


@claim(
    "Beyond the paper",
    "At Omega = 0 l2^2 grows as 2 v P tau, where P is that of the thermal state and v the speed of"
    " linear spreading.",
    unbounded("fig4_small", "omegas", "thermal"),
    (
        Control("the thermal states of the next Omega", {"thermal": NEXT_OMEGA}),
        Control(
            "the stable run fig2_large, compared with the speed and the thermal state at Omega = 0",
            {"fig4_small": ("fig2_large", behind_its_front)},
        ),
        Control(
            "the large case at Omega = -4, compared with the speed and the thermal state at Omega "
            "= 0",
            {"fig4_small": ("fig3_large", behind_its_front)},
        ),
        Control("a speed that is 5 % too high", {"fig4_small": scale("predicted_speed", 1.05)}),
    ),
)
def unbounded_slope(run, band, thermal) -> Finding:
    times_of(run)
    slopes, omegas = slopes_of(run, sure()), band["omega"].values
    slope, centre = slopes[0], ratios_of(slopes, thermal, run["omega"].values)[0]
    behind = mean_limits(bulk.mean_powers(run, FRONT)[0], sure())
    ratios = ratios_of(slopes_of(band, sure(len(omegas))), thermal, omegas)
    measured = {
        "centre": centre.value,
        "centre_at_least": centre.low,
        "centre_at_most": centre.high,
        "power_of_slope": slope.value,
        "power_of_slope_error": slope.half,
        "power_of_bulk": behind.value,
        "power_of_bulk_error": behind.half,
        "thermal_power": bulk.thermal_powers(thermal, run["omega"].values)[0],
    } | {f"at_omega_{omega:g}": one.value for omega, one in zip(omegas, ratios, strict=True)}
    says = "confidence interval of the slope of l2^2 over 2 v P at Omega = 0"
    criterion = Near(1.0, CONSTANT, "centre_at_least", "centre_at_most", says=says)
    elsewhere = told_apart(omegas, ratios, "only near Omega = 0: elsewhere the slope")
    return judge(measured, criterion, elsewhere)


WARM, THERMAL = "unbounded/fig3_large", "unbounded/thermal"


@claim(
    "Beyond the paper",
    "At Omega = -4 the front leaves energy behind, and the bulk is in the thermal state of that"
    " energy.",
    unbounded("fig3_large", "thermal"),
    (
        Control("at Omega = 0", {WARM: "unbounded/fig4_small"}),
        Control("the stable run fig2_large", {WARM: "unbounded/fig2_large"}),
        Control(
            "energies of both signs",
            {WARM: lambda run: scale("bulk_terms", on_every_second(run, 1.0))(run)},
        ),
        Control("noise of the same mean in place of P", {WARM: noise}),
        Control(
            "the thermal state of zero energy at every energy",
            {THERMAL: lambda thermal: put("warm_power", at_energy(thermal, 0.0)["power"])(thermal)},
        ),
        Control("a bulk in the state of zero energy", {WARM: (THERMAL, with_power(warm=False))}),
        Control(
            "a bulk in the thermal state of its energy",
            {WARM: (THERMAL, with_power(warm=True))},
            confirms=True,
        ),
    ),
)
def unbounded_warm(run, thermal) -> Finding:
    """Compare P of the bulk with that of the thermal states of its energy and of no energy."""
    times_of(run)
    measured = bulk_with_energy(run, thermal)
    end = f"by tau = {run['tau'].values[-1]:.0f}"
    says = "confidence limit of P of the bulk less that of the thermal state of its energy"
    with_energy = AllOf(
        Above(0.0, "energy_at_least", says="lower confidence limit of the energy per site"),
        AtMost(0.0, "off_thermal_at_least", says=f"lower {says}"),
        AtLeast(0.0, "off_thermal_at_most", says=f"upper {says}"),
        Above(0.0, "states_apart", says="P of that state less that at zero energy"),
    )
    told = Above(
        0.0,
        "above_cold_at_least",
        says="lower confidence limit of P less that at zero energy",
    )
    power, cold = measured["power"], measured["thermal_power_without_energy"]
    warm, moved = measured["thermal_power"], measured["moved_at_most"]
    off = with_energy.failing(measured)
    if not off and not told.holds(measured):
        return undecided(
            measured, f"{end} P agrees with the states of its energy and of zero energy"
        )
    only_power = bool(off) and not {"energy_at_least", "states_apart"} & set(off)
    if only_power and abs(measured["off_thermal"]) <= moved:
        return undecided(
            measured,
            f"{end} P = {power:.2f} differs from the {warm:.2f} of the thermal state, but may "
            f"still be changing: in the last quarter of the run by up to {moved:.2f}",
        )
    error = measured["power_error"]
    agrees = "agrees with" if abs(power - cold) <= error else "differs also from"
    fails = (
        f"energy is left behind, but {end} the bulk is not yet in the thermal state of that "
        f"energy: P = {power:.2f} +- {error:.2f} {agrees} that of zero energy ({cold:.2f}) and "
        f"differs significantly from that of its energy ({warm:.2f})"
    )
    has_energy = measured["energy_at_least"] > 0.0 and measured["states_apart"] > 0.0
    return judge(measured, AllOf(*with_energy.criteria, told), fails=fails if has_energy else "")


def bulk_with_energy(run, thermal) -> dict[str, float]:
    """Return the energy and P of the bulk, beside P of the thermal states."""
    terms, powers = bulk.mean_terms(run, BULK)[0], bulk.mean_powers(run, BULK)[0]
    energies = terms.sum(axis=1)
    energy, power = mean_limits(energies, sure()), mean_limits(powers, sure())
    cubic = mean_limits(terms[:, bulk.TERMS.index("cubic")], sure())
    warm, cold = at_energy(thermal, float(energy.value)), at_energy(thermal, 0.0)
    off = powers - warm["power"] - warm["rise"] * (energies - energy.value)
    off = mean_limits(off, sure())
    # by how much P off its thermal state may have moved in the last quarter of the run
    now = run["bulk_terms"].sel(front_power=BULK).sum("term")
    now = now.transpose("variant", "member", "piece_tau").values[0]
    third, last = bulk.late_means(bulk.bulk_powers(run, BULK)[0] - warm["rise"] * now, run, 2)
    moved = mean_limits(last - third, sure())
    return {
        "energy": energy.value,
        "energy_error": energy.half,
        "energy_at_least": energy.low,
        "power": power.value,
        "power_error": power.half,
        "thermal_power": warm["power"],
        "thermal_power_without_energy": cold["power"],
        "over_thermal": power.value / warm["power"],
        "off_thermal_at_least": off.low,
        "off_thermal_at_most": off.high,
        "states_apart": warm["power"] - cold["power"],
        "above_cold_at_least": power.low - cold["power"],
        "cubic_over_thermal": cubic.value / warm["cubic"],
        "cubic_error": cubic.half / warm["cubic"],
        "off_thermal": off.value,
        "moved_at_most": max(abs(moved.low), abs(moved.high)),
    }
