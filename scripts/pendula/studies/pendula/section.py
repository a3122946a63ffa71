"""The report's part on the pendula: threshold, expansion, phases, passages over the top, films."""

import base64
from typing import Any

import numpy as np

from pendula.ledger.claim import SETTLED
from pendula.ledger.section import Ledger
from pendula.numerics.elementary import cos, sin
from pendula.report.results import Film, Results, Section, Table
from pendula.report.words import (
    case_in_words,
    measured,
    number,
    percent,
    symbols,
    told,
    with_error,
)

from .claims_phases import late_levels, thermal_beside
from .claims_remainder import common_end

THRESHOLD, REMAINDER = "pendula/threshold", "pendula/remainder"
PHASES, SEA, TOP, FILM = "pendula/phases", "pendula/sea", "pendula/over_the_top", "pendula/film"
NOT_KNOWN = "not known"
STRONG_DRIVE = (
    ". A strong drive makes pendula over the top ever faster, so that no run can follow them for "
    "long: norms and angles are not known from then on"
)
DIGITS = 12
"""Digits of a threshold, which is known to double precision."""


def gather(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return tables and figures by topic, and a film of each case."""
    return {
        "Lemma 1 for the pendula": threshold(results),
        "How far the expansion (3) holds": remainder(results),
        "The cases of Figs 2 to 4 as pendula": phases(results),
        "Films of the pendula": films(results),
    }


def threshold(results: Results) -> dict[str, Any]:
    """Return the thresholds of the drive at each Omega outside of the band, and their figure."""
    data = results[THRESHOLD]
    mus = [number(float(mu)) for mu in data["mu"].values]
    outside = [float(one) for one in data["omega"].values[(data["gamma_0_lemma"] > 0).values]]
    at = {omega: data.sel(omega=omega) for omega in outside}
    more = (data["gamma_0_finite"] - data["gamma_0"]).sel(omega=outside).max()
    return {
        "thresholds": Table(
            "Threshold γ₀(μ) of the drive for the infinite chain of pendula",
            ["Ω", "γ₀ of Lemma 1", *(f"μ = {mu}" for mu in mus)],
            [[number(omega), results.quote(THRESHOLD, float(one["gamma_0_lemma"])),
              *(results.say(THRESHOLD, measured(v, DIGITS)) for v in one["gamma_0"].values)]
             for omega, one in at.items()],
        ),
        "picture": results.figure("pendula_threshold", told(
            "The threshold of the pendula beside Lemma 1 (a); its distance from Lemma 1 against "
            "the first order of this distance, on the line where they are equal (b); growth rate "
            "of the wave nearest to the resonance below the band (c) and above it (d). For large μ "
            "far below the band some waves have the frequency of the drive, and γ₀(μ) is zero. The "
            "threshold of a chain of {sites} sites is larger by at most {more}.",
            sites=results.quote(THRESHOLD, float(data.attrs["sites"])),
            more=results.quote(THRESHOLD, float(more)),
        )),
    }  # fmt: skip


def remainder(results: Results) -> dict[str, Any]:
    """Return the orders in mu of the expansion, and when its error becomes visible."""
    data = results[REMAINDER]
    mus, wrong = [number(float(mu)) for mu in data["mu"].values], data["wrong_order"]
    pairs = [(case, one) for case in data["case"].values for one in data["expansion"].values]
    return {
        "orders": Table(
            "Orders in μ of the largest error of an angle up to τ = "
            f"{number(common_end(data))}, and this error over the power of μ at the smallest μ; "
            "the corrected expansion has a third harmonic and terms of the order μ² more",
            ["case", "Ω", "order", "error / μ³, rad", "order, corrected", "error / μ⁵, rad"],
            [_orders(results, str(case)) for case in data["case"].values],
        ),
        "wrong": Table(
            "Orders of expansions that are wrong on purpose, over the cases",
            ["expansion", "least order", "largest order"],
            [[symbols(str(name)), *(results.quote(REMAINDER, float(pick(wrong.sel(
                wrong_expansion=name)))) for pick in (np.nanmin, np.nanmax))]
             for name in data["wrong_expansion"].values],
        ),
        "horizons": Table(
            "τ at which the error of an angle reaches "
            f"{percent(data.attrs['visible_part'])} of the largest angle",
            ["case", "expansion", *(f"μ = {mu}" for mu in mus)],
            [[str(case), str(one), *(
                results.say(REMAINDER, number(t) if np.isfinite(t) else "beyond the run")
                for t in data["visible_from"].sel(case=case, expansion=one).values)]
             for case, one in pairs],
        ),
        "picture": results.figure("pendula_remainder", (
            "The largest error of an angle against μ (a); the error of (3) over μ³ against time "
            "for the four smallest μ, thicker for smaller ones (b); the time at which the error "
            "becomes visible (c)."
        )),
    }  # fmt: skip


def _orders(results: Results, case: str) -> list:
    data = results[REMAINDER].sel(case=case, end=common_end(results[REMAINDER]))
    cells = []
    for expansion in data["expansion"].values:
        one = data.sel(expansion=expansion)
        order, off = float(one["order"]), float(one["order_uncertainty"])
        said = "unknown" if np.isnan(order) else with_error(order, off)
        cells += [results.say(REMAINDER, said),
                  results.quote(REMAINDER, float(one["error_constant"]))]  # fmt: skip
    return [case, number(float(data["omega"])), *cells]


def phases(results: Results) -> dict[str, Any]:
    """Return norms by case and mu, the power of the chaotic state, and first passages."""
    top = results[TOP]
    members, end, settled = (number(float(one)) for one in (
        top.sizes["member"], top["tau"][-1], top.attrs["settled"]))  # fmt: skip
    return {
        "norms": _norms(results),
        "pendula_phases": results.figure("pendula_phases", (
            "Norms against time (left), and the larger amplitude of each pair over sites and time, "
            "by the amplitude equations and by the pendula at each μ. In the green parts pendula "
            "have gone over the top, and an amplitude has no meaning."
        )),
        "powers": _powers(results),
        "passages": Table(
            f"First passages over the top by τ = {end} among {members} runs, with confidence "
            f"intervals; a rate starts at τ = {settled} and counts the runs without an earlier "
            "passage; the largest angle is a mean over the runs",
            ["μ", "gone over the top", "median τ", "rate per unit of τ", "largest angle, turns"],
            [_passages(results, top.isel(tau=-1).sel(mu=mu)) for mu in top["mu"].values],
        ),
        "pendula_over_the_top": results.figure("pendula_over_the_top", (
            "Spectrum (a) and distribution (b) of the chaotic state of pendula and of amplitudes, "
            "beside the thermal state; the share of runs that have gone over the top (c), with "
            "confidence intervals at the end; the largest angle so far, mean over the runs (d)."
        )),
    }  # fmt: skip


def _name(mu: float) -> str:
    return f"μ = {number(mu)}" if mu else "amplitudes (4)"


def _norms(results: Results) -> Table:
    """Return late norms of each case; there are none where the runs end before the first window."""
    data, rows = results[PHASES], []
    late = float(data["tau"][-1]) > SETTLED
    l2, linf = (late_levels(data, norm) for norm in ("l2", "linf")) if late else (None, None)
    for case in data["case"].values if late else ():
        one = data.sel(case=case)
        pairs = zip(l2.sel(case=case).values, linf.sel(case=case).values, strict=True)
        cells = [results.say(PHASES, NOT_KNOWN if np.isnan(a) else f"{number(a)}, {number(b)}")
                 for a, b in pairs]  # fmt: skip
        rows.append([case_in_words(float(one["omega"]), str(one["initial"].values)), *cells])
    lost = any("comment" in results[name].attrs for name in (PHASES, TOP))
    return Table(
        "Norms of the pair (ℓ², then ℓ∞), means over τ from the paper's first window on; they have "
        f"no meaning where pendula have gone over the top{STRONG_DRIVE if lost else ''}",
        ["case", *(_name(float(mu)) for mu in data["mu"].values)], rows,
    )  # fmt: skip


def _powers(results: Results) -> Table:
    """Return the mean power of a site in the chaotic state, and that of the thermal chain."""
    data = results[SEA]
    power = data["site_power"]
    errors = (power.std("member", ddof=1) / np.sqrt(power.sizes["member"])).values
    thermal = float(thermal_beside(data, results["unbounded/thermal"], "power")["power"])
    rows = [[_name(float(mu)), results.say(SEA, with_error(float(mean), float(error)))]
            for mu, mean, error in zip(data["mu"].values, power.mean("member").values, errors,
                                       strict=True)]  # fmt: skip
    if np.isfinite(thermal):
        rows.append(["thermal infinite chain", results.quote("unbounded/thermal", thermal)])
    return Table(
        f"Mean power of a site at Ω = {number(float(data.attrs['omega']))} over τ in "
        f"{data.attrs['window']}, with its standard error over {data.sizes['member']} runs",
        ["model", "power"], rows,
    )  # fmt: skip


def _passages(results: Results, one) -> list:
    share, low, high = (percent(float(one[f"passed{end}"])) for end in ("", "_low", "_high"))
    rate, *ends = (number(float(one[f"passage_rate{end}"]), 2) for end in ("", "_low", "_high"))
    known, median = np.isfinite(one["passage_rate"]), float(one["passage_median"])
    turns = float(one["angle_so_far"].mean("member", skipna=False)) / (2.0 * np.pi)
    return [
        number(float(one["mu"]), 4),
        results.say(TOP, f"{share} ({low} to {high})"),
        results.say(TOP, number(median) if np.isfinite(median) else "not by then"),
        results.say(TOP, f"{rate} ({ends[0]} to {ends[1]})" if known else "all passed before"),
        results.say(TOP, NOT_KNOWN if np.isnan(turns) else number(turns)),
    ]


# --- Films ----------------------------------------------------------------------------------------


def films(results: Results) -> dict[str, Film]:
    """Return the film of each case as the page's script reads it."""
    data = results[FILM]
    return {str(case): _film(results, data.sel(case=case)) for case in data["case"].values}


def _film(results: Results, one) -> Film:
    steps = one["angle_step"].transpose("picture", "component", "site").values
    tau, half_turn = one["period"].values * float(one["tau_of_period"]), one.attrs["half_turn"]
    caption = told(
        "{case}, to τ = {end}: pendula x<sub>n</sub> (red, above) and y<sub>n</sub> (blue, below) "
        "of the sites {first} to {last} at μ = {mu}, drawn as if they swung in the plane of the "
        "page. The bar at the left is the drive D(t), upwards where it is positive. The largest "
        "angle in the last period is {largest}°.",
        case=case_in_words(float(one["omega"]), str(one["initial"].values)),
        end=results.quote(FILM, float(tau[-1])),
        first=int(one["site"][0]),
        last=int(one["site"][-1]),
        mu=number(float(one.attrs["mu"])),
        largest=results.say(
            FILM, f"{180.0 * np.abs(steps[-one.attrs['per_period'] :]).max() / half_turn:.0f}"
        ),
    )
    hanging = [_hanging(row, np.pi / half_turn * angles) for row, angles in enumerate(steps[-1])]
    frames = base64.b64encode(steps.astype(np.int8).tobytes()).decode()
    return Film(frames, *steps.shape[::2], float(tau[1]), int(one.attrs["per_period"]), hanging,
                caption)  # fmt: skip


def _hanging(row: int, angles: np.ndarray) -> list[dict[str, float]]:
    """Return where each pendulum of a row hangs in the still picture, and where its bob is."""
    hook, places = 65.0 + 120.0 * row, 20.0 * (np.arange(len(angles)) + 3.5)
    return [
        {
            "from": place,
            "hook": hook,
            "x": round(place + 48.0 * float(sin(angle)), 1),
            "y": round(hook + 48.0 * float(cos(angle)), 1),
        }
        for place, angle in zip(places.tolist(), angles, strict=True)
    ]


SECTIONS = (Section("pendula", "The pendula themselves", gather),)
