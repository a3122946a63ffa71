"""Claims about breathers: the paper's conclusion, and its large case at Omega = -4."""

import xarray as xr
from replication.ledger.changes import exchange, put, scale
from replication.ledger.claim import ClaimControl, Origin, claim
from replication.ledger.criterion import (
    Above,
    AllOf,
    AtLeast,
    AtMost,
    Below,
    Finding,
    UndecidableError,
    judge,
)
from replication.ledger.cutoff import Cutoff

from pendula.claims import FAR_AS_NEAR, MAJORITY, SENSITIVITY

SECTION = 7
PLACE = "Section 6, breathers"

STEADY, PERIODIC = "breathers/steady", "breathers/periodic"
MAP = "breathers/fates"

ALL_SPREAD = put(("share", "share_low", "share_high"), 1.0)
OF_FIG_2, OF_FIG_3, OF_FIG_4 = 8.0, -4.0, 0.0
"""Omega of the paper's figures."""
DATA_POWER = 26.0
"""P of the paper's large initial condition, A_0 = 5 and B_0 = 1."""
FAR_FROM_THE_WAVES = -3.5
"""At lower frequencies solitons are wide and have small P, and waves reflected by the ends disturb
them."""
SAME_GROWTH = Cutoff(1e-3, "a rate that adds less than 10 % by the end of the paper's runs")


def at_omega(dataset: xr.Dataset, omega: float) -> xr.Dataset:
    """Return a dataset at one detuning. Raises UndecidableError if the dataset lacks it."""
    if omega not in dataset["omega"].values:
        raise UndecidableError(f"the dataset has no Omega = {omega:g}")
    return dataset.sel(omega=omega)


@claim(
    PLACE,
    "At the detuning of Fig 3 no computed steady state that is localised on one pair is stable.",
    (STEADY,),
    (
        ClaimControl(
            "the growth rates at Omega = -13", exchange("omega", -4.0, -13.0, names="growth")
        ),
    ),
    origin=Origin.OPEN,
)
def steady_unstable(steady: xr.Dataset) -> Finding:
    """Require a growing perturbation of each family of steady states."""
    states = at_omega(steady, OF_FIG_3)
    if states[["power", "growth"]].isnull().to_dataarray().any():
        raise UndecidableError("a state without known growth rates may be stable")
    measured = {
        "families": states.sizes["family"],
        "least_growth": states["growth"].min(),
        "least_power": states["power"].min(),
        "largest_power": states["power"].max(),
    }
    criterion = AllOf(AtLeast(1, "families"), Above(0.0, "least_growth", label="least growth rate"))
    return judge(measured, criterion)


def breathers_of_fig3(periodic: xr.Dataset) -> xr.Dataset:
    """Return the breathers at Omega of Fig 3. Raises UndecidableError if some are unknown."""
    breathers = at_omega(periodic, OF_FIG_3)
    if breathers[["power", "growth"]].isnull().to_dataarray().any():
        raise UndecidableError("some breathers, or their growth rates, are unknown")
    return breathers


@claim(
    PLACE,
    "At the detuning of Fig 3 there are stable breathers above the frequencies of linear waves: "
    "those in which A swings more than B, and those with A = -B.",
    (PERIODIC,),
    (
        ClaimControl(
            "breathers with A = B in place of A alone", exchange("family", "A only", "A = B")
        ),
    ),
    origin=Origin.OPEN,
)
def periodic_stable(periodic: xr.Dataset) -> Finding:
    """Decide by the two families with A != B."""
    breathers = breathers_of_fig3(periodic).sel(family=["A only", "A = -B"])
    measured = {
        "breathers": breathers["growth"].size,
        "lowest_frequency": breathers["frequency"].min(),
        "highest_frequency": breathers["frequency"].max(),
        "largest_growth": breathers["growth"].max(),
    }
    criterion = AllOf(
        AtLeast(1, "breathers"),
        Above(
            float(breathers["highest_wave"]), "lowest_frequency", label="lowest frequency of any"
        ),
        AtMost(0.0, "largest_growth", label="largest growth rate"),
    )
    return judge(measured, criterion, f"tested at {breathers.sizes['frequency']} frequencies")


@claim(
    PLACE,
    "At the detuning of Fig 3 solitons with A = B and frequencies from -3.5 to -1 are breathers of "
    "less P than the large initial condition, and unstable.",
    (PERIODIC,),
    (ClaimControl("solitons that no perturbation leaves", put("soliton_growth", 0.0)),),
    origin=Origin.OPEN,
)
def solitons_unstable(periodic: xr.Dataset) -> Finding:
    """Decide by the growth rate on the longer chain: near Omega the rate depends on the length."""
    away = periodic.where(periodic["soliton_frequency"] >= FAR_FROM_THE_WAVES, drop=True)
    short, long = (away["soliton_growth"].isel(soliton_half_width=i) for i in (0, -1))
    measured = {
        "solitons": away.sizes["soliton_frequency"],
        "lowest_frequency": away["soliton_frequency"].min(),
        "highest_frequency": away["soliton_frequency"].max(),
        "least_power": away["soliton_power"].min(),
        "largest_power": away["soliton_power"].max(),
        "least_growth": long.min(),
        "change_with_length": abs(long - short).max(),
    }
    criterion = AllOf(
        AtLeast(1, "solitons"),
        Below(DATA_POWER, "largest_power", label="largest P"),
        Above(0.0, "least_growth", label="least growth rate"),
        Below(
            SAME_GROWTH, "change_with_length", label="change of a growth rate on the longer chain"
        ),
    )
    return judge(measured, criterion)


@claim(
    PLACE,
    "The large initial condition of Fig 3 has less P than any computed stable breather above the "
    "frequencies of linear waves at Omega = -4 ever has.",
    (PERIODIC,),
    (
        ClaimControl("breathers at Omega = 8", exchange("omega", OF_FIG_3, OF_FIG_2)),
        ClaimControl("a family with half of its P", scale("least_power", 0.5, family="A only")),
    ),
    origin=Origin.OPEN,
)
def data_below_breathers(periodic: xr.Dataset) -> Finding:
    """Compare P of the large data with the least P of a stable breather.

    Data with less P cannot become one of these breathers unless the drive adds P.
    """
    breathers = breathers_of_fig3(periodic)
    stable = breathers["least_power"].where(breathers["growth"] == 0.0)
    measured = {"least_of_a_period": stable.min(), "data": DATA_POWER}
    label = "least P of a stable breather within a period, over all frequencies and families"
    return judge(measured, Above(DATA_POWER, "least_of_a_period", label=label))


@claim(
    "Beyond the paper, Fig 3 lower and Fig 6 right",
    "At Omega = -4 the large initial condition spreads over the chain, but most "
    "initial conditions perturbed by 1 % do not.",
    (SENSITIVITY,),
    (FAR_AS_NEAR, ClaimControl("runs that all spread", ALL_SPREAD)),
    on=("fig3_large",),
    origin=Origin.OWN,
)
def spreading_is_an_accident(sensitivity: xr.Dataset) -> Finding:
    """Require that most runs perturbed by up to 1e-6 spread, and most with 1e-2 or more do not."""
    sizes = sensitivity["size"].values
    small, large = sizes <= 1e-6, sizes >= 1e-2
    if not (small.any() and large.any()):
        raise UndecidableError("the perturbations do not include sizes up to 1e-6 and from 1e-2 on")
    measured = {
        "small_at_least": sensitivity["share_low"].values[small].min(),
        "large_at_most": sensitivity["share_high"].values[large].max(),
        "of_large": sensitivity["share"].values[large].max(),
        "members": float(sensitivity.attrs["members"]),
    }
    label = "confidence limit of the share that spreads"
    criterion = AllOf(
        Above(MAJORITY, "small_at_least", label=f"lower {label}, perturbed by up to 1e-6"),
        Below(MAJORITY, "large_at_most", label=f"upper {label}, perturbed by 1e-2 and more"),
    )
    spread = measured["of_large"]
    some = f"{100 * spread:.2g} % of the runs perturbed by 1e-2 and more spread too"
    return judge(measured, criterion, some if spread > 0 else "")


def with_dispersing_point(fates: xr.Dataset) -> xr.Dataset:
    """Return the maps, with the most unequal data at Omega = 0 set to disperse, as a control."""
    return put("fate", 0, omega=OF_FIG_4, a0=fates["a0"][-1], b0=fates["b0"][0])(fates)


@claim(
    "Beyond the paper, Figs 2 and 4",
    "The detuning decides whether initial conditions of the map spread: with A_0 and B_0 unequal, "
    "all spread at Omega = 0, and none at Omega = 8.",
    (MAP,),
    (
        ClaimControl("the maps at both detunings exchanged", exchange("omega", OF_FIG_2, OF_FIG_4)),
        ClaimControl("one initial condition at Omega = 0 that disperses", with_dispersing_point),
    ),
    origin=Origin.OWN,
)
def detuning_decides(fates: xr.Dataset) -> Finding:
    """Count fates on the map without the diagonal A = B, which conserves P and has no area."""
    spreads = fates["fate"].attrs["flag_meanings"].split().index("spreads")
    unequal = (fates["fate"] == spreads).astype(float).where(fates["a0"] != fates["b0"])
    measured = {
        "points": at_omega(unequal, OF_FIG_2).count(),
        "spread_at_8": at_omega(unequal, OF_FIG_2).mean(),
        "spread_at_0": at_omega(unequal, OF_FIG_4).mean(),
    }
    criterion = AllOf(
        AtLeast(1.0, "spread_at_0", label="share that spreads at Omega = 0"),
        AtMost(0.0, "spread_at_8", label="share that spreads at Omega = 8"),
    )
    return judge(measured, criterion)
