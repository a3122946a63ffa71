"""The report's part on chaos: growth rates, until when to trust a run, perturbed ensembles."""

from typing import Any

import numpy as np

from pendula.datasets.registry import SOLVER_NAMES
from pendula.ledger.section import Ledger
from pendula.measures.growth import MANY
from pendula.numerics.elementary import exp
from pendula.report.results import Results, Section, Table
from pendula.report.words import case_of, horizons_in_words, number, percent, told

LYAPUNOV, TRUST, SYMMETRY = "checks/lyapunov", "checks/trust", "checks/symmetry"
PRINTED = "truth/fig4_small"
"""The reference from the data as the paper prints them: it is of this case, whatever is run."""
ENSEMBLES, MEMBERS, LIVES = "checks/ensemble_runs", "checks/members", "checks/lifetimes"


def gather(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return rates and horizons by case, ensembles, and lives of the localised motion."""
    return {
        "rates": _rates(results),
        "trust_horizons": _trust_horizons(results),
        "lyapunov": results.figure("lyapunov", (
            "How fast small changes grow, even and odd in n at first; all exponents of short "
            "chains, with their confidence intervals (the lower half has the opposite signs); the "
            "divergence times of runs, predicted and measured."
        )),
        "symmetry": results.figure("symmetry", (
            "How symmetric solutions lose their symmetry: by rounding alone, where neighbours are "
            "summed from right to left, and from odd perturbations. Initial conditions without the "
            "symmetry have an odd part from the start."
        )),
        "ensembles": results.figure("ensembles", told(
            "{members} runs from initial conditions perturbed by {size}, against τ. Below, the "
            "swept maxima of Figs 5 and 6.",
            members=results.quote(ENSEMBLES, results[ENSEMBLES].attrs["members"]),
            size=results.quote(ENSEMBLES, results[ENSEMBLES].attrs["perturbation"]),
        )),
        "bands": Table(
            "Bands of the perturbed ensembles in the later half; symmetric runs have wider bands "
            "than others, by the root of two where the halves of a chain are independent",
            ["case", "runs in the band", "width / mean", "mean of ℓ²", "time that the run of the "
             "figure is in it", "width, symmetric / other runs", "its confidence interval"],
            [_band(results, str(name)) for name in results[ENSEMBLES]["case"].values],
        ),
        "How long a large amplitude stays localised": _lives(results),
    }  # fmt: skip


def _rates(results: Results) -> Table:
    """Return by case how fast changes grow, and when each solver leaves the reference."""
    growth, trust = results[LYAPUNOV], results[TRUST]
    visible = percent(float(trust["size"].sel(level="visible")))
    solvers, rows = [str(solver) for solver in trust["solver"].values], []
    for name in map(str, growth["case"].values):
        case, known = growth.sel(case=name), trust.sel(case=name, level=["visible"])
        rates = (results.quote_error(LYAPUNOV, *(float(case[key].sel(parity=parity))
                                     for key in ("exponent", "exponent_error")))
                 for parity in ("even", "odd"))  # fmt: skip
        lost = (horizons_in_words(known.sel(solver=solver))[0] for solver in solvers)
        uneven = float(results[SYMMETRY]["rounded_time"].sel(case=name))
        proved = float(trust["proved_until"].sel(case=name))
        rows.append([
            case_of(case), results.say(LYAPUNOV, "yes" if case["chaotic"] == 1 else "no"), *rates,
            *(results.say(TRUST, words) for words in lost),
            results.quote(TRUST, proved, 4), results.quote_time(SYMMETRY, uneven),
        ])  # fmt: skip
    head = ["case", "chaotic", "rate of even changes", "rate of odd changes",
            *(f"{SOLVER_NAMES[name]} leaves at τ" for name in solvers), "proved to τ",
            "visibly not symmetric from τ"]  # fmt: skip
    return Table(
        "Growth rates of small changes, per unit of τ; times at which a norm by a solver is off "
        f"its reference, verified in multiprecision, by {visible} of full scale; and the time from "
        "which rounding alone makes a symmetric solution visibly not symmetric. A case counts as "
        "chaotic where a small change grows, relative to the solution, by a factor of more than "
        f"{number(float(exp(MANY)))} in the second half of the run, by more than its error",
        head, rows,
    )  # fmt: skip


def _trust_horizons(results: Results):
    """Return the figure of errors, and when the double next to a tenth becomes visible."""
    trust = results[TRUST]
    digits, seen = trust["decimal_horizon"].values
    return results.figure("trust_horizons", told(
        "Errors of the norms of each solver against τ. A mark on the dashed line shows when a "
        "solver leaves its reference; otherwise it stands at the end of the curve, and a case "
        "without a reference has an empty panel. The proven bound is how far a curve of "
        "polynomials can be from the true solution. At Ω = {omega} the solution that starts from "
        "the double next to the printed tenth is off by {size} of full scale at τ = {first} and by "
        "{visible} at τ = {seen}.",
        omega=number(float(results[PRINTED].attrs["omega"])),
        size=number(float(trust["decimal_size"][0])),
        first=results.quote_time(TRUST, float(digits)),
        visible=percent(float(trust["size"].sel(level="visible"))),
        seen=results.quote_time(TRUST, float(seen)),
    ))  # fmt: skip


def _band(results: Results, name: str) -> list:
    """Return how wide the band of an ensemble is, and how long the run of the figure is in it."""
    case, widths = results[ENSEMBLES].sel(case=name), results[MEMBERS].sel(case=name)
    inside = float(case["run_inside"])
    ends = (number(float(widths[f"width_ratio_{end}"])) for end in ("low", "high"))
    return [
        case_of(case),
        *(
            results.say(ENSEMBLES, percent(float(case[key])))
            for key in ("band_share", "band_width")
        ),
        results.quote(ENSEMBLES, float(case["band_middle"])),
        results.say(ENSEMBLES, percent(inside) if np.isfinite(inside) else "unknown"),
        results.quote(MEMBERS, float(widths["width_ratio"])),
        results.say(MEMBERS, " to ".join(ends)),
    ]


def _lives(results: Results) -> dict[str, Any]:
    """Return how long each initial amplitude stays localised, and what other tolerances find."""
    lives = results[LIVES]
    end, members = float(lives["tau"].max()), number(lives.attrs["members"])
    settled = number(lives.attrs["settled"])
    return {
        "lives": Table(
            f"Lives of the localised motion, {members} runs each to τ = {number(end)}: they end "
            "when the central pair holds no more than its even share of P. A rate counts the "
            f"transitions after τ = {settled}; its chance is that of Kolmogorov's test for a "
            "constant rate",
            ["A₀", "median, τ", "confidence interval", "localised at the end",
             "first transition, τ", "transitions per unit of τ", "confidence interval",
             "chance of a constant rate"],
            [_life(results, float(a0), end) for a0 in lives["start_amplitude"].values],
        ),
        "lifetimes": results.figure("lifetimes", told(
            "Share of the runs that are still localised against τ, with confidence intervals, and "
            "how long the transition takes: medians, and means of the runs that are localised at "
            "τ = {settled}. A triangle is a lower bound.", settled=settled,
        )),
        "choices": Table(
            f"The runs from A₀ = {number(float(lives['compared_amplitude']))} with several "
            "tolerances, and from initial conditions that are not symmetric",
            ["tolerance", "ensemble", "transitions per unit of τ", "confidence interval",
             "largest error of the energy", "right-hand sides"],
            [_choice(results, k) for k in range(lives.sizes["choice"])],
        ),
    }  # fmt: skip


def _life(results: Results, a0: float, end: float) -> list:
    one = results[LIVES].sel(start_amplitude=a0)
    times = (float(one[f"median{part}"]) for part in ("", "_low", "_high"))
    median, low, high = (_time(tau, end) for tau in times)
    said = (
        median,
        low if low == high else f"{low} to {high}",
        percent(float(one["surviving"][-1])),
        _time(float(one["life"].min()), end),
    )
    chance = results.quote(LIVES, float(one["rate_chance"]), 2) if one["rate"] > 0 else "none"
    return [number(a0), *(results.say(LIVES, text) for text in said),
            *_rate(results, one, "rate"), chance]  # fmt: skip


def _time(tau: float, end: float) -> str:
    """Return a time in words; few members do not bound it from below, censored ones from above."""
    if tau == -np.inf:
        return "any time"
    return number(tau) if np.isfinite(tau) else f"over {number(end)}"


def _choice(results: Results, k: int) -> list:
    one = results[LIVES].isel(choice=k)
    names = ("choice_tolerance", "choice_drift", "choice_work")
    tolerance, drift, work = (results.quote(LIVES, float(one[name])) for name in names)
    symmetric = "symmetric" if one["choice_kind"].item() == "even" else "not symmetric"
    return [tolerance, symmetric, *_rate(results, one, "choice_rate"), drift, work]


def _rate(results: Results, one, name: str) -> list:
    """Return a rate and its interval, or none where no run outlasted the settled time."""
    if not np.isfinite(float(one[name])):
        return ["none", "none"]
    ends = (number(float(one[f"{name}_{end}"]), 2) for end in ("low", "high"))
    return [results.quote(LIVES, float(one[name]), 2), results.say(LIVES, " to ".join(ends))]


SECTIONS = (Section("chaos", "Chaos, and until when a run can be trusted", gather),)
