"""The report's part on chaos: growth of small changes, evenness, ensembles, until when to trust."""

from typing import Any

import numpy as np

from pendula.datasets.registry import SOLVER_NAMES
from pendula.ledger.section import Ledger
from pendula.measures.growth import MANY
from pendula.numerics.elementary import exp
from pendula.problem import is_even
from pendula.report.page import Picture
from pendula.report.results import Results, Section
from pendula.report.words import (
    case_of,
    horizons_in_words,
    number,
    percent,
    span,
    with_error,
)

LYAPUNOV, TRUST = "checks/lyapunov", "checks/trust"
PRINTED = "truth/fig4_small"
"""The reference from the data as the paper prints them: it is of this case, whatever is run."""
ENSEMBLES, MEMBERS, LIVES = "checks/ensemble_runs", "checks/members", "checks/lifetimes"


def gather(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return a row for each case, what each solver leaves, and the ensembles in words."""
    growth, trust = results[LYAPUNOV], results[TRUST]
    rates = growth["exponent"].max("parity")
    chaotic = [str(case) for case in growth["case"].values[growth["chaotic"].values == 1]]
    solvers = [str(solver) for solver in trust["solver"].values]
    bands = [ensemble_of(results, case) for case in results[ENSEMBLES]["case"].values]
    return {
        "as_paper": not any(path.startswith("solvers.ode45.") for path in results.differs),
        "cases": results.quote(LYAPUNOV, growth.sizes["case"]),
        "chaotic": [case_of(growth.sel(case=case)) for case in chaotic],
        "count": results.quote(LYAPUNOV, len(chaotic)),
        "rates": results.say(LYAPUNOV, span(rates.sel(case=chaotic), 2) if chaotic else "none"),
        "limit": number(float(exp(MANY))),
        "visible": percent(float(trust["size"].sel(level="visible"))),
        "ends": results.say(TRUST, _from_to(trust["run_end"])),
        "proved": {
            "count": results.quote(TRUST, int(trust["proved_until"].count())),
            "until": results.say(TRUST, _from_to(trust["proved_until"])),
        },
        "head": ["case", "rate of even changes", "rate of odd changes",
                 *(f"{SOLVER_NAMES[name]} leaves at τ" for name in solvers), "uneven from τ"],
        "rows": [_row(results, str(case), solvers) for case in growth["case"].values],
        "lost": {name: lost_by(results, name) for name in solvers},
        "ensembles": bands,
        "even": all(band["even"] for band in bands),
        "all_even": all(is_even(str(data)) for data in growth["initial"].values),
        "widths": [widths_of(results, case) for case in results[ENSEMBLES]["case"].values],
        "lives": lives_of(results),
        "decimal": not_a_tenth(results),
        "pictures": _pictures(results),
        "members": results.quote(ENSEMBLES, results[ENSEMBLES].attrs["members"]),
        "size": results.quote(ENSEMBLES, results[ENSEMBLES].attrs["perturbation"]),
    }  # fmt: skip


def _from_to(times) -> str:
    """Return the first and the last of the times that are known, once where they agree."""
    ends = {float(edge(times)) for edge in (np.nanmin, np.nanmax)} if times.count() else {}
    return " to ".join(number(end, 4) for end in sorted(ends)) or "none"


def _row(results: Results, case: str, solvers: list[str]) -> list:
    growth = results[LYAPUNOV].sel(case=case)
    even, odd = (
        results.quote_error(LYAPUNOV, float(growth["exponent"].sel(parity=parity)),
                            float(growth["exponent_error"].sel(parity=parity)))
        for parity in ("even", "odd")
    )  # fmt: skip
    known = results[TRUST].sel(case=case, level=["visible"])
    lost = [results.say(TRUST, *horizons_in_words(known.sel(solver=s))) for s in solvers]
    uneven = float(results["checks/symmetry"]["rounded_time"].sel(case=case))
    return [case_of(growth), even, odd, *lost, results.quote_time("checks/symmetry", uneven)]


def lost_by(results: Results, solver: str) -> dict[str, Any]:
    """Return in how many cases a solver leaves the reference, and when; in how many it is kept.

    A run that goes on after its reference is kept to the end of that alone, `ended`; of a case
    without a reference nothing is known.
    """
    judged = results[TRUST].sel(solver=solver, level="visible")
    horizons, until = judged["horizon"].values, judged["known_until"].values
    known, ends = horizons[np.isfinite(horizons)], judged["run_end"].values
    counts = {
        "count": len(known),
        "kept": int((np.isinf(horizons) & (until >= ends)).sum()),
        "ended": int((np.isinf(horizons) & (until < ends)).sum()),
        "unknown": int(np.isnan(until).sum()),
    }
    return {
        "solver": SOLVER_NAMES[solver],
        "any": len(known) > 0,
        **{name: results.quote(TRUST, count) for name, count in counts.items()},
        "times": results.say(TRUST, span(known, 4) if len(known) else "no time"),
    }


def not_a_tenth(results: Results) -> dict[str, Any]:
    """Return when the reference from the double next to 0.1 leaves the one from a tenth."""
    digits, seen = results[TRUST]["decimal_horizon"].values
    return {
        "omega": number(float(results[PRINTED].attrs["omega"])),
        "digits": number(float(results[TRUST]["decimal_size"][0])),
        "first": results.quote_time(TRUST, float(digits)),
        "seen": results.quote_time(TRUST, float(seen)),
    }


def ensemble_of(results: Results, name: str) -> dict[str, Any]:
    """Return how wide the band of an ensemble is, and how long the paper's run is inside it."""
    case = results[ENSEMBLES].sel(case=name)
    return {
        "case": case_of(case),
        "even": is_even(str(case["initial"].values)),
        "of_paper": not results.apart(f"trajectories/{name}"),
        "share": results.say(ENSEMBLES, percent(float(case["band_share"]))),
        "width": results.say(ENSEMBLES, percent(float(case["band_width"]))),
        "middle": results.quote(ENSEMBLES, float(case["band_middle"])),
        "inside": results.say(ENSEMBLES, percent(float(case["run_inside"]))),
        "told": bool(np.isfinite(float(case["run_inside"]))),
    }


def widths_of(results: Results, name: str) -> dict[str, Any]:
    """Return by how much the band of even runs is wider than that of uneven ones."""
    case = results[MEMBERS].sel(case=name)
    low, high = (float(case[f"width_ratio_{end}"]) for end in ("low", "high"))
    return {
        "case": case_of(case),
        "ratio": results.quote(MEMBERS, float(case["width_ratio"])),
        "limits": results.say(MEMBERS, span([low, high], 3)),
    }


def lives_of(results: Results) -> dict[str, Any]:
    """Return how long each initial amplitude stays localised, and what other tolerances find."""
    lives = results[LIVES]
    end = float(lives["tau"].max())
    return {
        "members": results.quote(LIVES, lives.attrs["members"]),
        "settled": results.quote(LIVES, lives.attrs["settled"]),
        "end": results.quote(LIVES, end),
        "head": ["initial amplitude", "median life, τ", "its limits", "still localised at the end",
                 "first transition, τ", "transitions per unit of τ", "their limits",
                 "chance under a constant rate"],
        "rows": [_life(results, float(a0), end) for a0 in lives["start_amplitude"].values],
        "amplitude": results.quote(LIVES, float(lives["compared_amplitude"])),
        "choices_head": ["tolerance", "ensemble", "transitions per unit of τ", "their limits",
                         "largest error of the energy", "right-hand sides"],
        "choices": [_choice(results, k) for k in range(lives.sizes["choice"])],
    }  # fmt: skip


def _life(results: Results, a0: float, end: float) -> list:
    one = results[LIVES].sel(start_amplitude=a0)
    left = results.say(LIVES, percent(float(one["surviving"][-1])))
    times = [float(one[f"median{part}"]) for part in ("", "_low", "_high")]
    median, low, high = (_time(tau, end) for tau in times)
    limits = low if low == high else f"{low} to {high}"
    told = [results.say(LIVES, text) for text in (median, limits)]
    first = results.say(LIVES, _time(float(one["life"].min()), end))
    chance = results.quote(LIVES, float(one["rate_chance"]), 2) if one["rate"] > 0 else "none"
    return [number(a0), *told, left, first, *_rate(results, one, "rate"), chance]


def _time(tau: float, end: float) -> str:
    """Return a time in words; few members do not bound it from below, censored ones from above."""
    if tau == -np.inf:
        return "any time"
    return number(tau) if np.isfinite(tau) else f"over {number(end)}"


def _choice(results: Results, k: int) -> list:
    one = results[LIVES].isel(choice=k)
    names = ("choice_tolerance", "choice_drift", "choice_work")
    tolerance, drift, work = (results.quote(LIVES, float(one[name])) for name in names)
    kind = f"{one['choice_kind'].item()} in n"
    return [tolerance, kind, *_rate(results, one, "choice_rate"), drift, work]


def _rate(results: Results, one, name: str) -> list:
    """Return a rate and its limits, or none where no run outlasted the settled time."""
    if not np.isfinite(float(one[name])):
        return ["none", "none"]
    limits = (number(float(one[f"{name}_{end}"]), 2) for end in ("low", "high"))
    return [results.quote(LIVES, float(one[name]), 2), results.say(LIVES, " to ".join(limits))]


def _pictures(results: Results) -> dict[str, Picture]:
    """Return the five pictures by name."""
    lives = results[LIVES]
    amplitudes = span(lives["start_amplitude"].values, 3)
    growth, trust = results[LYAPUNOV].sel(parity="even"), results[TRUST]
    lost = [lost_by(results, str(name)) for name in trust["solver"].values]
    rates = [
        f"{case_of(case)}: {with_error(float(case['exponent']), float(case['exponent_error']))}"
        for case in (growth.sel(case=name) for name in growth["case"].values)
    ]
    uneven = results["checks/symmetry"]["rounded_time"].values
    bands = [ensemble_of(results, name) for name in results[ENSEMBLES]["case"].values]
    described = {
        "trust_horizons": "Errors of the norms against τ. "
        + "; ".join(f"{one['solver']} leaves {one['count']} cases"
                    + (f", at τ = {one['times']}" if one["any"] else "") for one in lost)
        + f". Proven bounds of {trust['proved_until'].count().item()} cases, to τ = "
        + _from_to(trust["proved_until"]),
        "lyapunov": f"Growth of small changes. Rates: {'; '.join(rates)}",
        "symmetry": "The odd part of even solutions against τ. By rounding alone it becomes "
        f"visible in {np.isfinite(uneven).sum()} of {len(uneven)} cases",
        "lifetimes": f"Share of runs that are still localised against τ, and median lives, for A_0 "
        f"of {amplitudes}. {int((lives['surviving'][:, -1] > 0).sum())} of "
        f"{lives.sizes['start_amplitude']} amplitudes have runs that stay localised to the end",
        "ensembles": "Bands of runs from almost equal data. "
        + "; ".join(f"{band['case']}: {band['share']} within {band['width']}" for band in bands),
    }  # fmt: skip
    return {name: results.picture(name, f"{alt}.") for name, alt in described.items()}


SECTIONS = (Section("chaos", "What can be trusted", gather),)
