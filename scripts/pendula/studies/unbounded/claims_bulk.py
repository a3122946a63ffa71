"""The state behind the front: it is compared with the thermal state, and nothing is fitted.

Energy is the only integral, and a front that is pulled leaves none behind. So the equilibrium is
the thermal state of no energy, which `thermal` solves to many digits; only the bulk has errors to
speak of. They are the limits of means over the members of an ensemble, by Student's t.
"""

import numpy as np

from pendula.ledger.claim import CHANGE, CONSTANT, Control, claim, unbounded
from pendula.ledger.criterion import Above, AllOf, Finding, Near, UndecidableError, judge
from pendula.measures.confidence import Limits, mean_limits

from .bulk import (
    TERMS,
    bulk_powers,
    late_means,
    mean_powers,
    mean_terms,
    slope_powers,
    thermal_powers,
)
from .claims import SURE, times_of
from .front import BULK, FRONT

SECTION = 5


def ratios_of(limits: list[Limits], expected: np.ndarray) -> list[Limits]:
    """Return each of some limits over what is expected."""
    return [
        Limits(*(bound / value for bound in one))
        for one, value in zip(limits, expected, strict=True)
    ]


def summary(ratios: list[Limits]) -> dict[str, float]:
    """Return the least and the largest ratio, and the lowest and the highest limit of one."""
    values = [one.value for one in ratios]
    lowest, highest = min(one.low for one in ratios), max(one.high for one in ratios)
    return {"least": min(values), "largest": max(values), "at_least": lowest, "at_most": highest}


def told_apart(omegas: np.ndarray, ratios: list[Limits], what: str) -> str:
    """Return the caveat that names each Omega where the limits do not hold the thermal state."""
    apart = [
        f"{omega:g} ({ratio.value - 1.0:+.1%})".replace("%", " %")
        for omega, ratio in zip(omegas, ratios, strict=True)
        if not ratio.low < 1.0 < ratio.high
    ]
    if not apart:
        return ""
    return f"{what} is off the thermal state by more than its limits at Omega = {', '.join(apart)}"


def at_energy(thermal, energy: float) -> dict[str, float]:
    """Return P and the cubic term a site of the thermal state of an energy, between solved ones."""
    solved = thermal["site_energy"].values
    if not solved[0] <= energy <= solved[-1]:
        raise UndecidableError(f"no thermal state with the energy {energy:.3g} a site was solved")
    cubic = thermal["warm_terms"].sel(term="cubic").values
    return {
        "power": float(np.interp(energy, solved, thermal["warm_power"].values)),
        "cubic": float(np.interp(energy, solved, cubic)),
    }


# --- Wrong cases ----------------------------------------------------------------------------------


def of_next_omega(thermal):
    """Return the thermal states with the power of the next Omega at each."""
    return thermal.assign(power=thermal["power"].roll(omega=1))


def dispersing(run):
    """Return the run with a bulk whose power falls as 1 / tau, as that of dispersing waves."""
    fall = run["piece_tau"][-1] / run["piece_tau"]
    return run.assign(bulk_power=(run["bulk_power"] * fall).transpose(*run["bulk_power"].dims))


def noise(run):
    """Return the run with noise for the power of its bulk, of the mean that it had."""
    powers = run["bulk_power"]
    drawn = np.random.default_rng(2017).exponential(float(powers.mean()), powers.shape)
    return run.assign(bulk_power=(powers.dims, drawn))


def faster(run):
    """Return the run with a front that is said to be faster by a twentieth."""
    return run.assign(predicted_speed=1.05 * run["predicted_speed"])


def without_energy(run):
    """Return the run with as much energy of the other sign on every second member."""
    sign = 1.0 - 2.0 * (np.arange(run.sizes["member"]) % 2)
    return run.assign(bulk_terms=run["bulk_terms"] * run["member"].copy(data=sign))


STILL = tuple(
    Control(f"the stable run {name}", {"unbounded/omegas": f"unbounded/{name}"})
    for name in ("fig2_large", "fig3_small")
)


@claim(
    "Introduction",
    "A dynamical equilibrium is reached where each pendulum oscillates at a finite amplitude.",
    unbounded("omegas", "thermal"),
    (
        *STILL,
        Control("the thermal states of the next Omega", {"unbounded/thermal": of_next_omega}),
        Control("P falls as 1 / tau, as that of waves", {"unbounded/omegas": dispersing}),
        Control("noise of the same mean for P", {"unbounded/omegas": noise}),
    ),
)
def unbounded_equilibrium(run, thermal) -> Finding:
    times_of(run)
    omegas, powers = run["omega"].values, bulk_powers(run, FRONT)
    sure = 1.0 - (1.0 - SURE.value) / len(omegas)  # of all Omega together (Bonferroni)
    limits = [mean_limits(one, sure) for one in mean_powers(run, FRONT)]
    ratios = ratios_of(limits, thermal_powers(thermal, omegas))
    third, last = late_means(powers, run, 2).mean(axis=2)
    change = last / third
    measured = summary(ratios) | {"least_change": change.min(), "largest_change": change.max()}
    criterion = AllOf(
        Near(1.0, CHANGE, "at_least", "at_most", says="limits of P over the thermal one"),
        Near(1.0, CHANGE, "least_change", "largest_change", says="its last quarter over the third"),
    )
    return judge(measured, criterion, told_apart(omegas, ratios, "P"))


@claim(
    "Beyond the paper",
    "l2^2 grows as 2 v P tau: P is that of the thermal state, v the speed of linear spreading.",
    unbounded("fig4_small", "omegas", "thermal"),
    (
        Control("the thermal states of the next Omega", {"unbounded/thermal": of_next_omega}),
        Control("the stable run fig2_large", {"unbounded/fig4_small": "unbounded/fig2_large"}),
        Control("large data at Omega = -4", {"unbounded/fig4_small": "unbounded/fig3_large"}),
        Control("a speed that is 5 % too high", {"unbounded/fig4_small": faster}),
    ),
)
def unbounded_slope(run, band, thermal) -> Finding:
    times_of(run)
    expected = thermal_powers(thermal, run["omega"].values)
    slope = slope_powers(run, SURE.value)[0]
    bulk = mean_limits(mean_powers(run, FRONT)[0], SURE.value)
    centre = ratios_of([slope], expected)[0]
    omegas = band["omega"].values
    sure = 1.0 - (1.0 - SURE.value) / len(omegas)
    ratios = ratios_of(slope_powers(band, sure), thermal_powers(thermal, omegas))
    measured = {
        "centre": centre.value,
        "centre_at_least": centre.low,
        "centre_at_most": centre.high,
        "power_of_slope": slope.value,
        "power_of_slope_error": slope.half,
        "power_of_bulk": bulk.value,
        "power_of_bulk_error": bulk.half,
        "thermal_power": expected[0],
    } | summary(ratios)
    criterion = AllOf(
        Near(
            1.0,
            CONSTANT,
            "centre_at_least",
            "centre_at_most",
            says="limits of the slope of l2^2 over 2 v P at Omega = 0",
        ),
        Near(1.0, CHANGE, "at_least", "at_most", says="the same in the whole band"),
    )
    return judge(measured, criterion, told_apart(omegas, ratios, "the slope"))


@claim(
    "Beyond the paper",
    "At Omega = -4 the front leaves energy behind, and the bulk is thermal at that energy.",
    unbounded("fig3_large", "thermal"),
    (
        Control("at Omega = 0", {"unbounded/fig3_large": "unbounded/fig4_small"}),
        Control("the stable run fig2_large", {"unbounded/fig3_large": "unbounded/fig2_large"}),
        Control("energy of either sign", {"unbounded/fig3_large": without_energy}),
        Control("noise of the same mean for P", {"unbounded/fig3_large": noise}),
    ),
)
def unbounded_warm(run, thermal) -> Finding:
    times_of(run)
    terms = mean_terms(run, BULK)[0]
    energy = mean_limits(terms.sum(axis=1), SURE.value)
    power = mean_limits(mean_powers(run, BULK)[0], SURE.value)
    cubic = mean_limits(terms[:, TERMS.index("cubic")], SURE.value)
    warm = at_energy(thermal, float(energy.value))
    cold = at_energy(thermal, 0.0)
    measured = {
        "energy": energy.value,
        "energy_error": energy.half,
        "energy_at_least": energy.low,
        "power": power.value,
        "power_error": power.half,
        "thermal_power": warm["power"],
        "thermal_power_without_energy": cold["power"],
        "over_thermal": power.value / warm["power"],
        "cubic_over_thermal": cubic.value / warm["cubic"],
        "cubic_error": cubic.half / warm["cubic"],
    }
    criterion = AllOf(
        Above(0.0, "energy_at_least", says="lower limit of the energy a site of the bulk"),
        Near(1.0, CONSTANT, "over_thermal", says="P of the bulk over that of its thermal state"),
    )
    caveat = ""
    if abs(power.value - warm["power"]) > power.half:
        caveat = f"P is {power.value / warm['power'] - 1.0:+.1%}".replace("%", " %")
        caveat += f" off the thermal one by tau = {run['tau'].values[-1]:.0f}, beyond its limits"
    return judge(measured, criterion, caveat)
