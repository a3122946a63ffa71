"""What breathers say of the paper's conclusion and of its large case at Omega = -4."""

import numpy as np

from pendula.configuration.paper import MAPS
from pendula.ledger.changes import exchange, put, roll, scale
from pendula.ledger.chaos import FAR_AS_NEAR, MAJORITY, SENSITIVITY
from pendula.ledger.claim import CHANGE, FACTOR, Control, claim
from pendula.ledger.criterion import (
    Above,
    AllOf,
    AtLeast,
    AtMost,
    Below,
    Finding,
    UndecidableError,
    judge,
)  # fmt: skip
from pendula.ledger.cutoff import Cutoff, once
from pendula.models.pairs import FAMILIES

SECTION = 7
PLACE = "Section 6, breathers"

STEADY, PERIODIC = "breathers/steady", "breathers/periodic"
GROWTH, MAP = "breathers/growth", "breathers/fates"

RATES = ("growth", "growth_half")
NEXT_FAMILY = roll("growth_half", {"family": 1})
OTHER_ORDER = roll("case_distance", {"family": 1})
NEXT_FREQUENCY = roll("measured_growth", {"frequency": 1})
ALL_SPREAD = put(("share", "share_low", "share_high"), 1.0)
OF_FIG_2, OF_FIG_3, OF_FIG_4 = 8.0, -4.0, 0.0
"""Omega of the paper's figures."""
DATA_POWER = 26.0
"""P of the paper's large data, A_0 = 5 and B_0 = 1."""
AS_FLOQUET = Cutoff(1e-3, "perturbations stay below 1e-4, so that quadratic terms are smaller")
FIRST_ORDER = Cutoff(0.1, "a law of first order in gamma is off by about gamma, up to 0.1")


def at_omega(dataset, omega: float):
    """Return a dataset at one detuning; raise UndecidableError if it has none."""
    if omega not in dataset["omega"].values:
        raise UndecidableError(f"no breathers were computed at Omega = {omega:g}")
    return dataset.sel(omega=omega)


@claim(
    PLACE,
    "At the detuning of Fig 3 no steady state that is localised on one pair is stable.",
    (STEADY,),
    (
        Control("the growth rates at Omega = -13", exchange("omega", -4.0, -13.0, names=RATES)),
        Control(
            "all families but one unknown",
            put("power", np.nan, family=[family.name for family in FAMILIES[1:]]),
            undecided=True,
        ),
    ),
)
def steady_unstable(steady) -> Finding:
    """Require a growing perturbation of each family, on a chain and on twice its half-width."""
    here = at_omega(steady, OF_FIG_3)
    if here[["power", "growth", "growth_half"]].isnull().to_dataarray().any():
        raise UndecidableError("a state without known growth rates may be stable")
    measured = {
        "families": here.sizes["family"],
        "residual_below": steady.attrs["residual"],
        "least_growth": here["growth"].min(),
        "least_growth_half": here["growth_half"].min(),
    }
    criterion = AllOf(
        AtLeast(1, "families"),
        Above(0.0, "least_growth", "least_growth_half", says="least growth rate on two chains"),
    )
    return judge(measured, criterion)


@once
def known(periodic):
    """Return breathers; raise UndecidableError if a family has a gap above its first frequency."""
    found = periodic["power"].notnull().all("component")
    for name in RATES:
        found = found & periodic[name].notnull()
    if ((found.cumsum("frequency") > 0) & ~found).any():
        raise UndecidableError("some breathers, or their growth rates, are unknown")
    return periodic


@claim(
    PLACE,
    "At the detuning of Fig 3 there are stable breathers, above the frequencies of linear waves.",
    (PERIODIC,),
    (Control("breathers with A = B in place of A alone", exchange("family", "A only", "A = B")),),
)
def periodic_stable(periodic) -> Finding:
    """Decide by the family in which A oscillates and B follows by the drive."""
    here = at_omega(known(periodic), OF_FIG_3).sel(family="A only")
    found = here["power"].notnull().all("component")
    measured = {
        "breathers": found.sum(),
        "lowest_frequency": here["frequency"].where(found).min(),
        "highest_frequency": here["frequency"].where(found).max(),
        "largest_growth": here["growth"].max(),
        "largest_growth_half": here["growth_half"].max(),
    }
    criterion = AllOf(
        AtLeast(1, "breathers"),
        AtMost(0.0, "largest_growth", "largest_growth_half", says="growth rate on two chains"),
    )
    return judge(measured, criterion, f"tested at {int(found.sum())} frequencies")


def verdicts_that_differ(dataset) -> int:
    """Return how many states are stable on one chain and unstable on another one."""
    differ = (dataset["growth"] > 0.0) != (dataset["growth_half"] > 0.0)
    return int((differ & np.isfinite(dataset["growth"])).sum())


@claim(
    PLACE,
    "The stability of a breather does not depend on the length of the chain.",
    (STEADY, PERIODIC),
    (
        Control("steady states with the growth rates of another family", {STEADY: NEXT_FAMILY}),
        Control("periodic ones with the growth rates of another family", {PERIODIC: NEXT_FAMILY}),
    ),
)
def stable_on_any_chain(steady, periodic) -> Finding:
    """Compare verdicts with those on half of the half-width, above the frequencies of waves.

    Within them the waves of a finite chain are few, and its multipliers leave the unit circle by
    four at values that change with its length.
    """
    above = known(periodic)["frequency"] > periodic["highest_wave"]
    outside = periodic[["growth", "growth_half"]].where(above)
    measured = {
        "steady": verdicts_that_differ(steady),
        "periodic": verdicts_that_differ(outside),
        "compared": np.isfinite(steady["growth"]).sum() + np.isfinite(outside["growth"]).sum(),
        "known_steady": np.isfinite(steady["growth"]).mean(),
    }
    criterion = AllOf(
        AtLeast(1, "compared"),
        Above(MAJORITY, "known_steady", says="share of steady states that are known"),
        AtMost(0, "steady", "periodic", says="states of different stability on two chains"),
    )
    within = periodic[["growing", "growing_half"]].where(~above)
    if not np.isfinite(within["growing"]).any():
        return judge(measured, criterion)
    longer, shorter = (int(within[name].max()) for name in ("growing", "growing_half"))
    caveat = (
        "not at frequencies of linear waves, where resonance with the waves of a finite chain gives"
        f" {longer} growing multipliers, and {shorter} on a chain half as long"
    )
    return judge(measured, criterion, caveat)


@claim(
    PLACE,
    "Where a family of breathers becomes unstable, multipliers of opposite signatures collide.",
    (PERIODIC,),
    (Control("multipliers of equal signatures", put("collision_signature", 1)),),
)
def opposite_signatures_collide(periodic) -> Finding:
    """Decide by the product of the two Krein signatures beside each collision."""
    met = np.isfinite(known(periodic)["collision_frequency"])
    if not met.any():
        raise UndecidableError("no family becomes unstable at these frequencies")
    product = periodic["collision_signature"].astype(float).prod("colliding").where(met)
    quartets = met & (periodic["collision_multiplier"].sel(part="im") > 0.0)
    measured = {"collisions": met.sum(), "quartets": quartets.sum()}
    measured["largest_product"] = product.max()
    criterion = Below(0.0, "largest_product", says="product of the two Krein signatures")
    return judge(measured, criterion)


@claim(
    PLACE,
    "In the nonlinear flow perturbations of unstable breathers grow at the Floquet rates.",
    (PERIODIC,),
    (Control("the growth rates of the flow at the next frequency", NEXT_FREQUENCY),),
)
def grows_as_floquet_says(periodic) -> Finding:
    """Compare the rates of even and of odd perturbations, above the frequencies of waves."""
    rates = known(periodic)["measured_growth"]
    off = abs(rates / periodic["parity_growth"].where(np.isfinite(rates)) - 1.0)
    measured = {"compared": np.isfinite(rates).sum(), "largest_difference": off.max()}
    if not measured["compared"]:
        raise UndecidableError("no breather is unstable above the frequencies of waves")
    says = "largest relative difference of the growth rates"
    return judge(measured, Below(AS_FLOQUET, "largest_difference", says=says))


@claim(
    PLACE,
    "The large initial condition of Fig 3 has less P than any periodic breather at Omega = -4 "
    "ever has.",
    (PERIODIC,),
    (
        Control("breathers at Omega = 8", exchange("omega", OF_FIG_3, OF_FIG_2)),
        Control("another family with half of its P", scale("least_power", 0.5, family="A = B")),
    ),
)
def data_below_breathers(periodic) -> Finding:
    """So they cannot end as one unless the drive feeds them."""
    least = at_omega(known(periodic), OF_FIG_3)["least_power"].min("family")
    largest_instant, least_instant = least.values
    measured = {"largest_of_a_period": largest_instant, "least_of_a_period": least_instant}
    says = "least P within a period, over all frequencies and families"
    return judge(measured | {"data": DATA_POWER}, Above(DATA_POWER, "least_of_a_period", says=says))


@claim(
    PLACE,
    "A localised motion with a frequency in the band of linear waves gains P from a weak drive, as"
    " perturbation theory predicts, until its frequency leaves the band.",
    (GROWTH,),
    (
        Control("half of the predicted rate", scale("predicted_gain", 0.5)),
        Control("predictions for other drives", exchange("gamma", names="predicted_gain")),
    ),
)
def grows_by_drive(growth) -> Finding:
    """Compare what runs with gamma of a tenth or less gain with the law, while it predicts gain."""
    weak = growth.sel(gamma=growth["gamma"] <= 0.1)
    if not weak.sizes["gamma"]:
        raise UndecidableError("no run has a weak drive")
    most = float(weak["predicted_gain"].max())
    middle = (weak["predicted_gain"] > 0.25 * most) & (weak["predicted_gain"] < 0.75 * most)
    off = abs(weak["gained"] - weak["predicted_gain"]).where(middle) / most
    strong = growth.sel(gamma=growth["gamma"].max())
    measured = {
        "largest_difference": off.max(),
        "drives": weak.sizes["gamma"],
        "ends_at": (weak["gained"].isel(output=-1) / most).max(),
        "strongest": growth["gamma"].max(),
        "passed_by": float(strong["time"].where(strong["gained"] > most).min()),
    }
    criterion = AllOf(
        Below(
            FIRST_ORDER,
            "largest_difference",
            says="largest error of the prediction, over the gain",
        ),
        Below(FACTOR, "ends_at", says="gain at the end over the predicted one"),
    )
    return judge(measured, criterion)


@claim(
    "Beyond the paper, Fig 3 lower and Fig 6 right",
    "At Omega = -4 the large initial condition spreads over the chain, but most of those "
    "perturbed by 1 % do not.",
    (SENSITIVITY,),
    (FAR_AS_NEAR, Control("runs that all spread", ALL_SPREAD)),
    on=("fig3_large",),
)
def spreading_is_an_accident(sensitivity) -> Finding:
    """Require that most runs spread from data within 1e-6, and most do not from 1e-2 on."""
    sizes = sensitivity["size"].values
    small, large = sizes <= 1e-6, sizes >= 1e-2
    if not (small.any() and large.any()):
        raise UndecidableError("the perturbations do not include sizes up to 1e-6 and from 1e-2 on")
    measured = {
        "small_at_least": sensitivity["share_low"].values[small].min(),
        "large_at_most": sensitivity["share_high"].values[large].max(),
        "of_large": sensitivity["share"].values[large].max(),
        "scanned": sensitivity.sizes["initial"],
        "of_the_scan": sensitivity["spread"].mean(),
        "members": float(sensitivity.attrs["members"]),
    }
    said = "confidence limit of the share that spreads"
    criterion = AllOf(
        Above(MAJORITY, "small_at_least", says=f"lower {said}, perturbed by up to 1e-6"),
        Below(MAJORITY, "large_at_most", says=f"upper {said}, perturbed by 1e-2 and more"),
    )
    spread = measured["of_large"]
    some = f"{100 * spread:.2g} % of the runs perturbed by 1e-2 and more spread too"
    return judge(measured, criterion, some if spread > 0 else "")


@claim(
    "Section 6, breathers, Fig 2 lower",
    "The large case at Omega = 8 ends as a breather near the stable family in which B is driven "
    "by A.",
    (MAP, PERIODIC),
    (
        Control(
            "the large case at Omega = -4",
            {MAP: exchange("case", "fig2_large", "fig3_large")},
            on=("fig3_large",),
        ),
        Control("distances from other families", {MAP: OTHER_ORDER}),
        Control("distances twenty times as large", {MAP: scale("case_distance", 20.0)}),
    ),
    on=("fig2_large",),
)
def ends_near_stable(fates, periodic) -> Finding:
    """Require an end near this family and far from others, where this one is stable."""
    if "fig2_large" not in fates["case"].values:
        raise UndecidableError("the large case at Omega = 8 was not run")
    end = fates.sel(case="fig2_large")
    apart = end["case_distance"].set_index(family="family")
    own, others = float(apart.sel(family="A only")), apart.drop_sel(family="A only")
    frequency = float(end["case_breather_frequency"])
    if np.isnan(frequency):
        own = np.inf  # no breather, no family
    family = at_omega(known(periodic), OF_FIG_2).sel(family="A only").sortby("frequency")
    above = int(np.searchsorted(family["frequency"].values, frequency))
    beside = family["growth"].isel(frequency=slice(max(above - 1, 0), above + 1))
    measured = {
        "frequency": frequency,
        "distance": own,
        "times_nearer": others.min(skipna=False) / own if np.isfinite(own) else 0.0,
        "largest_growth": beside.max(),
    }
    criterion = AllOf(
        Below(CHANGE, "distance", says="distance from the family over the size of the breather"),
        AtLeast(FACTOR, "times_nearer", says="distance from the next family over this one"),
        AtMost(0.0, "largest_growth"),
    )
    return judge(measured, criterion)


def one_that_disperses(fates):
    """Return the maps with another fate of the most unequal data at Omega = 0."""
    return put("fate", 0, omega=OF_FIG_4, a0=fates["a0"][-1], b0=fates["b0"][0])(fates)


@claim(
    "Beyond the paper, Figs 2 and 4",
    "The detuning decides whether the initial conditions of the map with A_0 other than B_0 "
    "spread: at Omega = 0 all do, at Omega = 8 none does.",
    (MAP,),
    (
        Control("the maps of both detunings exchanged", exchange("omega", OF_FIG_2, OF_FIG_4)),
        Control("one initial condition at Omega = 0 that disperses", one_that_disperses),
    ),
    on=(MAPS,),
)
def detuning_decides(fates) -> Finding:
    """Count fates on both maps; A = B conserves P, has no area, and is left out."""
    spreads = fates["fate"].attrs["flag_meanings"].split().index("spreads")
    turned, all_of_them = (
        (fates[name] == spreads).astype(float) for name in ("turned_fate", "fate")
    )
    unequal = all_of_them.where(fates["a0"] != fates["b0"])
    measured = {
        "points": at_omega(unequal, OF_FIG_2).count() + at_omega(turned, OF_FIG_2).count(),
        "spread_at_8": at_omega(unequal, OF_FIG_2).mean(),
        "spread_at_0": at_omega(unequal, OF_FIG_4).mean(),
        "turned_at_8": at_omega(turned, OF_FIG_2).mean(),
        "turned_at_0": at_omega(turned, OF_FIG_4).mean(),
    }
    criterion = AllOf(
        AtLeast(1.0, "spread_at_0", "turned_at_0", says="least share that spreads at Omega = 0"),
        AtMost(0.0, "spread_at_8", "turned_at_8", says="largest share that spreads at Omega = 8"),
    )
    return judge(measured, criterion)
