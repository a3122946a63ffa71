"""What this project says beyond the paper about chaos and trust; the same rules hold for it."""

import numpy as np

from pendula.ledger.chaotic import chaotic
from pendula.ledger.claim import CHANGE, FACTOR, cases_reversed, checks, claim, wrong_check
from pendula.ledger.criterion import (
    Above,
    AllOf,
    AtLeast,
    AtMost,
    Below,
    Finding,
    UndecidableError,
    judge,
    undecided,
)
from pendula.ledger.cutoff import Cutoff
from pendula.measures.confidence import CONFIDENCE, Limits, student
from pendula.measures.growth import PARTS
from pendula.numerics.elementary import exp, log

from .claims import LATER, SEEN

SECTION = 7
PLACE = "Beyond the paper"

SAME = Cutoff(3.0, "two measured numbers are the same up to three standard errors of both")


def chaotic_cases(lyapunov) -> np.ndarray:
    """Return the names of the chaotic cases; without any, a claim on them cannot be decided."""
    found = lyapunov["case"].values[chaotic(lyapunov).values]
    if not len(found):
        raise UndecidableError("no case is chaotic")
    return found


def with_even_exponents_shifted(lyapunov):
    """Return the exponents with those of even perturbations from the next case."""
    shifted = lyapunov["exponent"].roll(case=1, roll_coords=False)
    even = lyapunov["parity"] == "even"
    return lyapunov.assign(exponent=lyapunov["exponent"].where(~even, shifted))


@claim(
    PLACE,
    "Perturbations that are odd in n grow as fast as even ones.",
    checks("lyapunov"),
    controls=(
        wrong_check("odd and even exponents of two cases", lyapunov=with_even_exponents_shifted),
    ),
)
def odd_as_even(lyapunov) -> Finding:
    """Ask by how much they differ in the mean over the chaotic cases.

    A single case has an error from a few parts of one run, and chance decides which part is large.
    """
    chosen = lyapunov.sel(case=chaotic_cases(lyapunov))
    even, odd = (chosen["exponent"].sel(parity=parity) for parity in ("even", "odd"))
    mean = chosen["exponent"].mean("parity")
    off = float((abs(odd - even) / mean).mean())
    errors = (chosen["exponent_error"] / mean).values
    limit = student(PARTS - 1) * np.sqrt(np.sum(errors**2)) / chosen.sizes["case"]
    measured = {
        "difference": np.abs(even - odd).max(),
        "mean_difference": off,
        "at_least": max(0.0, off - limit),
        "at_most": off + limit,
    }
    says = "upper limit of the mean relative difference of the exponents"
    criterion = Below(CHANGE, "at_most", says=says)
    if measured["at_least"] < CHANGE.value <= measured["at_most"]:
        return undecided(measured, "the runs are too short to tell the exponents apart, or not")
    return judge(measured, criterion, fails=f"they differ by {100 * off:.2g} % in the mean")


@claim(
    PLACE,
    "Where sums depend on the side, rounding alone makes the chaotic solutions visibly uneven.",
    checks("symmetry", "lyapunov"),
    controls=(
        wrong_check(
            "the odd parts of the cases in reverse order",
            symmetry=cases_reversed,
        ),
    ),
)
def evenness_lost(symmetry, lyapunov) -> Finding:
    grown = symmetry["case"].isin(chaotic_cases(lyapunov))
    times = symmetry["rounded_time"]
    measured = {
        "first": times.where(grown).min(),
        "chaotic_that_stay_even": (grown & ~np.isfinite(times)).sum(),
        "regular_that_turn_uneven": (~grown & np.isfinite(times)).sum(),
    }
    return judge(measured, AtMost(0, "chaotic_that_stay_even", "regular_that_turn_uneven"))


@claim(
    PLACE,
    "Every solver leaves the true trajectory of every chaotic case.",
    checks("trust", "lyapunov"),
    controls=(
        wrong_check(
            "the horizons of the cases in reverse order",
            trust=cases_reversed,
        ),
    ),
)
def no_solver_stays(trust, lyapunov) -> Finding:
    horizon = trust["horizon"].sel(level="visible", case=chaotic_cases(lyapunov))
    if np.isnan(horizon.values).any():
        raise UndecidableError("no reference of these cases tells the errors")
    measured = {"first": horizon.min(), "last": horizon.max(), "runs": horizon.size}
    largest = trust["difference"].sel(case=horizon["case"]).max("tau")
    measured["staying"] = (largest <= SEEN.value).sum()
    return judge(measured, AllOf(AtMost(0, "staying"), AtLeast(1, "runs")))


def with_kinds_exchanged(members):
    """Return the members with the widths of even ensembles as those of uneven ones."""
    inverse = {
        "width_ratio": 1.0 / members["width_ratio"],
        "width_ratio_low": 1.0 / members["width_ratio_high"],
        "width_ratio_high": 1.0 / members["width_ratio_low"],
    }
    return members.assign(inverse)


@claim(
    PLACE,
    "Bands of ensembles that are even in n are wider by the root of two than those of uneven ones.",
    checks("members", "lyapunov"),
    controls=(wrong_check("the two kinds exchanged", members=with_kinds_exchanged),),
)
def even_bands_wider(members, lyapunov) -> Finding:
    if members["window"].values[-1] != LATER:
        raise UndecidableError(f"the bands are not those on {LATER}")
    chosen = members.sel(case=chaotic_cases(lyapunov))
    # One case alone does not resolve the root of two: its 32 members leave 10 to 25 % on the ratio.
    ratio = log(chosen["width_ratio"].values)
    limits = [log(chosen[f"width_ratio_{end}"].values) for end in ("low", "high")]
    quantile = student(members.sizes["member"] - 1)
    errors = 0.5 * (limits[1] - limits[0]) / quantile
    error = np.sqrt(np.square(errors).sum()) / errors.size
    measured = {
        f"ratio_{case}": chosen["width_ratio"].sel(case=case) for case in chosen["case"].values
    }
    measured["mean_ratio"] = exp(ratio.mean())
    measured["lower_limit"] = exp(ratio.mean() - quantile * error)
    measured["off"] = abs(ratio.mean() - 0.5 * log(2.0)) / error
    criterion = AllOf(
        Above(1.0, "lower_limit", says="lower limit of the mean ratio of widths"),
        Below(SAME, "off", says="distance of the mean from the root of two over its error"),
    )
    return judge(measured, criterion)


def own_choice(lifetimes):
    """Return the compared ensemble that has the tolerance and the evenness of all the others."""
    even = lifetimes["choice_kind"] == "even"
    return (lifetimes["choice_tolerance"] == lifetimes.attrs["solver_rtol"]) & even


def rates_of(choices) -> list[Limits]:
    """Return the rate of transitions of each compared ensemble, with its limits."""
    names = ("choice_rate", "choice_rate_low", "choice_rate_high")
    return [
        Limits(*(float(one) for one in row))
        for row in zip(*(choices[name].values for name in names), strict=True)
    ]


def ratios_to_mean(rates: list[Limits]) -> list[Limits]:
    """Return each rate over the geometric mean of all, with limits that hold together.

    On a logarithmic scale the limits of a rate are those of a normal number, so that errors of
    independent rates add in squares. The limits of all ratios are as sure as those of one
    (Bonferroni).
    """
    logs = log(np.array([rate.value for rate in rates]))
    halves = log(np.array([rate.high / rate.low for rate in rates])) / 2.0
    count = len(rates)
    wider = student(np.inf, 1.0 - (1.0 - CONFIDENCE) / count) / student(np.inf)
    own, others = (1.0 - 1.0 / count) * halves, np.sum(halves**2) - halves**2
    off = wider * np.sqrt(own**2 + others / count**2)
    mean = logs - logs.mean()
    return [
        Limits(*(float(exp(one)) for one in row))
        for row in zip(mean, mean - off, mean + off, strict=True)
    ]


def with_coarse_rates(lifetimes):
    """Return the lives with the rates of the coarsest tolerance as those of their own."""
    own, coarse = own_choice(lifetimes), int(lifetimes["choice_tolerance"].values.argmax())
    names = [f"choice_rate{end}" for end in ("", "_low", "_high")]
    return lifetimes.assign(
        {name: lifetimes[name].where(~own, lifetimes[name][coarse]) for name in names}
    )


@claim(
    PLACE,
    "Neither a finer tolerance nor evenness changes how fast localised centres change over by a"
    " factor of two.",
    checks("lifetimes"),
    controls=(wrong_check("the rate by the coarsest tolerance", lifetimes=with_coarse_rates),),
)
def rate_is_resolved(lifetimes) -> Finding:
    own = own_choice(lifetimes)
    finer = lifetimes["choice_tolerance"] <= lifetimes.attrs["solver_rtol"]
    others = lifetimes.isel(choice=(finer & ~own).values)
    if not own.any() or not others.sizes["choice"]:
        raise UndecidableError("no other ensemble is as fine")
    rates = rates_of(lifetimes.isel(choice=(own | finer).values))
    if not all(rate.low for rate in rates):
        raise UndecidableError("too few transitions bound the rate")
    ratios = ratios_to_mean(rates)
    nearest = max(max(1.0 / ratio.high, ratio.low) for ratio in ratios)
    measured = {
        "rate": rates_of(lifetimes.isel(choice=own.values))[0].value,
        "least_ratio": min(ratio.value for ratio in ratios),
        "largest_ratio": max(ratio.value for ratio in ratios),
        "at_least": nearest,
        "resolution": max(max(1.0 / ratio.low, ratio.high) for ratio in ratios),
    }
    says = "largest factor between a rate and the mean of all, limits included"
    criterion = Below(FACTOR, "resolution", says=says)
    caveat = f"the limits of these rates allow a factor of {measured['resolution']:.2g}"
    if nearest < FACTOR.value <= measured["resolution"]:
        return undecided(measured, caveat)
    return judge(measured, criterion, caveat)


def with_growth_of(case: str):
    """Return a function of horizons and exponents: the horizons if changes grew as in `case`."""

    def change(trust, lyapunov):
        rates = lyapunov["exponent"].sel(parity="even")
        slower = float(rates.sel(case="fig4_small")) / abs(float(rates.sel(case=case)))
        return trust.assign(decimal_horizon=trust["decimal_horizon"] * slower)

    return change


@claim(
    PLACE,
    "Data rounded to doubles lead away from the data as printed, such as 0.1.",
    checks("trust"),
    controls=(
        wrong_check(
            "small changes that grow as slowly as in the small data at Omega = 8",
            on=("fig2_small", "fig4_small"),
            trust=("lyapunov", with_growth_of("fig2_small")),
        ),
    ),
    on=("fig4_small",),
)
def decimal_data(trust) -> Finding:
    times, end = trust["decimal_horizon"].values, float(trust["tau"][-1])
    if np.isnan(times).any():
        raise UndecidableError("no reference of these cases tells the errors")
    measured = {"first_seen": times[0], "visible": times[-1]}
    says = "tau at which the difference is visible"
    return judge(measured, AtMost(end, "visible", says=says))
