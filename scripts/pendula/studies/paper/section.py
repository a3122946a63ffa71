"""The report's part on the paper's figures: norms against time, and against the half-width."""

from typing import Any

import numpy as np
from markupsafe import Markup

from pendula.ledger.claim import CHANGE, CONSTANT
from pendula.ledger.criterion import Verdict
from pendula.ledger.section import CONFIRMED, Ledger, badge
from pendula.measures.difference import difference, divergence_time, is_of_same_case, known_until
from pendula.measures.levels import levelling
from pendula.problem import name_window
from pendula.report.results import Results, Section, Table
from pendula.report.words import (
    FIRM,
    NORMS,
    STATISTICS,
    case_in_words,
    horizon_in_words,
    measured,
    number,
    percent,
    span,
    told,
)

from .tables import gather_solvers

OF_TIME = {which: [f"fig{which}_{size}" for size in ("small", "large")] for which in (2, 3, 4)}
OF_WIDTH = {which: [f"fig{which}_{side}" for side in ("left", "right")] for which in (5, 6)}
DRAWN = {5: ("l2", "linf"), 6: ("l2",)}
"""The norms that the paper's figures of sweeps draw."""

ENSEMBLES, TRUST = "checks/ensembles", "checks/trust"


def gather_figures(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return a table of Figs 1 to 6 with their verdicts, and each with its numbers."""
    shown = {
        **{which: f"norms against time, Ω = {_omegas(results, 'trajectories', names)}"
           for which, names in OF_TIME.items()},
        **{which: f"norms against half-width, Ω = {_omegas(results, 'sweeps', names)}"
           for which, names in OF_WIDTH.items()},
    }  # fmt: skip
    chain = "A drawing of the chain: pairs of pendula on strings, coupled along and across"
    return {
        "overview": Table(
            "Each figure with its verdict, and the claims of the paper on it",
            ("figure", "verdict", "claims"),
            [_verdict(which, shown.get(which, "the chain"), ledger) for which in range(1, 7)],
        ),
        "Fig 1: the chain": {"fig1": results.figure("fig1", f"{chain}.")},
        **{f"Fig {which}: {shown[which]}": _norms(results, which) for which in OF_TIME},
        **{f"Fig {which}: {shown[which]}": _sweeps(results, which) for which in OF_WIDTH},
    }


def _omegas(results: Results, folder: str, names: list[str]) -> str:
    return " and ".join(
        dict.fromkeys(number(results[f"{folder}/{name}"].attrs["omega"]) for name in names)
    )


def _verdict(which: int, shown: str, ledger: Ledger) -> list:
    """Return a row: a figure, what it shows, and the verdicts on the claims about it."""
    rows = ledger.on(which)
    name = told('<a href="#figure_fig{n}">Fig {n}</a>, {shown}', n=which, shown=shown)
    verdicts = {verdict: [row["name"] for row in rows if row["verdict"] == verdict]
                for verdict in Verdict}  # fmt: skip
    counts = Markup(", ").join(
        told('<a href="#claim_{first}">{n} {verdict}</a>', first=of[0], n=len(of), verdict=one)
        for one, of in verdicts.items() if of
    )  # fmt: skip
    sound = sum(len(verdicts[one]) for one in CONFIRMED)
    if not rows:
        return [name, "a drawing", "none"]
    if verdicts[Verdict.NOT_APPLICABLE]:
        kind, text = Verdict.NOT_APPLICABLE, "not applicable"
    elif not sound:
        kind, text = Verdict.NOT_REPRODUCED, "not reproduced"
    elif sound < len(rows):
        kind, text = Verdict.CAVEAT, f"reproduced, except for {len(rows) - sound} of the claims"
    elif verdicts[Verdict.CAVEAT]:
        kind, text = Verdict.CAVEAT, "reproduced with a caveat"
    else:
        kind, text = Verdict.CONFIRMED, "reproduced"
    return [name, badge(kind, text), counts]


def _norms(results: Results, which: int) -> dict[str, Any]:
    visible = percent(float(results[TRUST]["size"].sel(level="visible")))
    caption = f"Norms of A (red) and of B (blue) against τ for Fig {which}, drawn as Fig 2."
    long_caption = told(
        "Norms of A (red) and of B (blue) against τ, ℓ∞ left and ℓ² right. A dashed line marks the "
        "time from which the run differs from its multiprecision reference by {visible} of full "
        "scale. The panels with such a line show the run, the reference, and the median of a "
        "perturbed ensemble with the band that contains {share} of its runs. In panels without a "
        "line, run and reference agree as far as both are known.",
        visible=visible,
        share=results.say(ENSEMBLES, percent(float(results[ENSEMBLES].attrs["band_share"]))),
    )
    head = ["case", "ℓ² of the pair", "its mean, second half", f"error {visible} at τ",
            "bounded by", "largest P over that bound", "steps"]  # fmt: skip
    return {
        "figure": results.figure(f"fig{which}", long_caption if which == 2 else caption),
        "numbers": Table(f"Fig {which}; P is the square of ℓ²", head,
                         [_run(results, name) for name in OF_TIME[which]]),
    }  # fmt: skip


def _run(results: Results, name: str) -> list:
    """Return the row of a run: its norm, when it leaves its reference, and its bound."""
    run, (known, judged) = f"trajectories/{name}", trusted(results, name)
    data, bound = results[run], results["checks/cases"].sel(case=name)
    l2 = np.sqrt((data["l2"].values ** 2).sum(axis=0))
    region = str(bound["region"].values)
    return [
        case_in_words(data.attrs["omega"], data.attrs["initial"]),
        results.say(run, span(l2)),
        results.say(run, measured(l2[len(l2) // 2 :].mean())),
        results.say(judged, known),
        results.say("checks/cases", "Theorem 3 only" if region == "none" else region.capitalize()),
        results.quote("checks/cases", float(bound["ratio"])),
        results.quote(run, data.attrs["steps"], 6),
    ]


def trusted(results: Results, case: str) -> tuple[str, str]:
    """Return the sentence on when a run leaves its reference, and the dataset with that time.

    A run by other controls than its solver's in checks/trust was not judged there, and is here.
    """
    source = f"trajectories/{case}"
    run, trust = results[source], results[TRUST].sel(case=case)
    solver, known = run.attrs["solver"], trust["solver"].values
    if solver in known and _controls(results[f"{source}.{solver}"]) == _controls(run):
        judged = trust.sel(solver=solver, level="visible")
        times = (float(judged[name]) for name in ("horizon", "known_until", "run_end"))
        return horizon_in_words(*times), TRUST
    reference, end = results[f"truth/{case}"], float(run["tau"][-1])
    if not is_of_same_case(run, reference):
        return horizon_in_words(np.nan, np.nan, end), source
    apart = difference(run, reference)
    return horizon_in_words(float(divergence_time(apart)), float(known_until(apart)), end), source


def _controls(run) -> dict[str, Any]:
    return {key: value for key, value in run.attrs.items() if key.startswith("solver")}


def _sweeps(results: Results, which: int) -> dict[str, Any]:
    caption = f"Norms of the pair against the half-width M for Fig {which}, drawn as Fig 5."
    long_caption = (
        "Norms of the pair against the half-width M. Filled marks are maxima, as in the text of "
        "the paper, and hollow marks averages, as in its caption. Bars are the mean and standard "
        "deviation of a perturbed ensemble of a chaotic case. Marks on chains whose ends the front "
        "does not reach come from the same motion, and are no independent samples. The table gives "
        "the half-width from which single runs are level; the claims use that of ensemble means."
    )
    rows = [_curve(results, name, statistic, norm)
            for name in OF_WIDTH[which] for norm in DRAWN[which]
            for statistic in STATISTICS]  # fmt: skip
    head = ["case", "norm", "at the smallest M", "largest", "at the largest M", "change",
            "level, by single runs"]  # fmt: skip
    return {
        "figure": results.figure(f"fig{which}", long_caption if which == 5 else caption),
        "numbers": Table(f"Fig {which}", head, rows),
    }


def _curve(results: Results, name: str, statistic: str, norm: str) -> list:
    """Return a row on one curve of a sweep."""
    source = f"sweeps/{name}"
    sweep = results[source].sortby("half_width")
    window = name_window(results.settings["sweeps"][name]["drawn"][statistic])
    at = {"quantity": "pair", "statistic": statistic, "window": window}
    widths, values = sweep["half_width"].values, sweep[norm].sel(at).values
    said = (
        *(measured(value) for value in (values[0], values.max(), values[-1])),
        f"{shape(widths, values)}, {percent(values[-1] / values[0] - 1.0)}",
        levelled(levelling(widths, values)),
    )
    return [
        case_in_words(sweep.attrs["omega"], sweep.attrs["initial"]),
        f"{NORMS[norm]}, {STATISTICS[statistic]} on {window.replace(' ', FIRM)}",
        *(results.say(source, text) for text in said),
    ]


def shape(widths: np.ndarray, values: np.ndarray) -> str:
    """Return in words how a curve goes, by the measures of the claims."""
    peak = int(values.argmax())
    if values[peak] > (1.0 + CHANGE.value) * max(values[0], values[-1]):
        return f"rises to {measured(values[peak])} at M = {widths[peak]} and falls again"
    change = values[-1] / values[0] - 1.0
    if abs(change) < CONSTANT.value:
        return "constant"
    return "grows" if change > 0 else "falls"


def levelled(level: float) -> str:
    """Return from which half-width a curve is level."""
    if not np.isfinite(level):
        return "not level by the end"
    return f"level from M{FIRM}={FIRM}{number(level)}"


# --- Space-time pictures --------------------------------------------------------------------------

MOVING = 0.5
"""Part of the largest modulus above which the table counts a site as moving."""


def gather_motion(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return the moduli over sites and time beside Figs 2 to 4."""
    visible = percent(float(results[TRUST]["size"].sel(level="visible")))
    caption = (
        "Moduli of A and B over sites and time, for the cases of Fig {which}. From the white "
        "dashed line on the run differs from its reference by {visible}; a case without a "
        "reference has no line."
    )
    rows = []
    for source in (f"trajectories/{name}" for names in OF_TIME.values() for name in names):
        run = results[source]
        last = run["modulus"].isel(snapshot=-1).max("component").values
        numbers = (int((last > MOVING * last.max()).sum()), len(last))
        rows.append([
            case_in_words(run.attrs["omega"], run.attrs["initial"]),
            *(results.quote(source, count, 6) for count in numbers),
            results.say(source, measured(float(last.max()))),
        ])  # fmt: skip
    head = ["case", "sites that move at over half the largest modulus", "of", "largest modulus"]
    return {
        **{
            f"fig{which}_spacetime": results.figure(
                f"fig{which}_spacetime", told(caption, which=which, visible=visible)
            )
            for which in OF_TIME
        },
        "moving": Table("The chain at the end of each run", head, rows),
    }


SECTIONS = (
    Section("figures", "The figures of the paper", gather_figures, opened=True),
    Section("motion", "Where the chain moves", gather_motion),
    Section("solvers", "The paper's solvers", gather_solvers),
)
