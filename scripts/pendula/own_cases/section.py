"""The report on a user's cases and sweeps: figures, checks and parameters, all from datasets."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from pendula import __version__
from pendula.datasets import complete_or_absent
from pendula.datasets.netcdf import read
from pendula.datasets.registry import SOLVER_NAMES
from pendula.ends import ends_of
from pendula.measures.difference import VISIBLE
from pendula.models.pendula import frequency
from pendula.problem import PENDULA, read_initial
from pendula.report.page import picture, render
from pendula.report.results import Figure, Table
from pendula.report.sections import versions
from pendula.report.words import (
    MINUS,
    NORMS,
    STATISTICS,
    Quote,
    number,
    percent,
    symbols,
    told,
)

from .breathers import LOCALISED

# ASSUME: a bound counts as broken where the norms exceed it by more than their own error, and by
# more than this.
SLACK = 1e-6
STEEPEST = 1.01
"""Growth of P that is steeper than its bound by more than this is seen in the digits shown."""
WEAKEST = 1e-6
"""A drive that lets P grow by less over a whole run cannot be distinguished from rounding."""
EIGHT = 8.0
"""Outputs in a period of the pendula that show how they swing."""
FEW = 8
"""The initial conditions of more sites do not fit into the table."""
BREATHER = (
    "A localised state of these equations, continued from the site where the data are largest, "
    "left. Right its Floquet multipliers: it is unstable where one lies off the circle. Of a "
    "steady state they are exponents, and it is unstable where one lies to the right of zero."
)
EQUATIONS = "Newton's equations (1) of the pendula"
_SIGNS = {"mu": "μ", "omega": "Ω", "gamma": "γ", "epsilon": "ε", "half_width": "half-width M"}
TOO_LARGE = "broken: the errors of the run are too large"


def write_report(html: str, cases: list[str], sweeps: dict[str, str], files: list[str]) -> None:
    """Write the page `html` on `cases`, and on `sweeps` with the case of each.

    Their `files` lie below its folder.
    """
    with complete_or_absent(html) as partial:
        Path(partial).write_text(write(cases, sweeps, Path(html).parent), encoding="utf-8")


def write(cases: list[str], sweeps: dict[str, str], folder: Path) -> str:
    """Return the page on `cases`, and on `sweeps` with their cases; `folder` holds the files."""
    sections = {f"case {name}": _case(name, folder) for name in cases}
    sections |= {f"sweep {name}": _sweep(name, case, folder) for name, case in sweeps.items()}
    made_with = {"pendula": __version__, **versions()}
    return render("section.html.j2", Path(__file__).parent, sections=sections, versions=made_with)


# --- Cases ----------------------------------------------------------------------------------------


def _case(name: str, folder: Path) -> dict[str, Any]:
    """Return what the page shows of the case: parameters, figures, answers and numbers."""
    link, source = f"own/cases/{name}.checks.nc", f"trajectories/{name}.nc"
    run, checks = read(folder / source), read(folder / link)
    of_pendula, own = _is_of_pendula(run.attrs), _is_own(run.attrs)
    answer = _of_own_model if own else _of_pendula if of_pendula else _of_amplitudes
    answers = answer(checks, bool(run["linf"].any()))
    what = ("angles x (red) and y" if of_pendula else "A (red) and B") + " (blue)"
    if own:
        what = ", ".join(map(str, run["component"].values))
    caption = (
        f"Norms of {what} against τ, ℓ∞ left and ℓ² right. Where a run by another method "
        "differs visibly, a dashed line marks it and the other run is shown below."
    )
    if of_pendula and checks.attrs["output_step"] > _period(checks.attrs) / EIGHT:
        caption += (
            " There are fewer than eight outputs in a period of the pendula: use the upper edge of "
            "the curves, or give a shorter output_step."
        )
    moduli = (
        "Amplitudes √(x² + (dx/dt / ω)²) of the angles over sites and time, x<sub>n</sub> left and "
        "y<sub>n</sub> right." if of_pendula else f"Moduli of {what} over sites and time." if own
        else "Moduli over sites and time, |A<sub>n</sub>| left and |B<sub>n</sub>| right."
    )  # fmt: skip
    return {
        "parameters": Table(f"The case, from {source}", ("parameter", "value"),
                            parameters(run.attrs)),
        "norms": _figure(f"own/cases/{name}.png", caption, name, folder),
        "moduli": _figure(f"own/cases/{name}.spacetime.png", moduli, name, folder),
        **({"breather": _figure(f"own/cases/{name}.breather.png", BREATHER, name, folder)}
           if "breather" in checks else {}),
        "answers": Table("What the checks say", ("question", "answer"), answers),
        "numbers": Table(f"Their numbers, from {link}", ("quantity", "value"),
                         [[symbols(text), quote] for text, quote in quotes(checks, link)]),
    }  # fmt: skip


def _figure(link: str, caption: str, name: str, folder: Path) -> Figure:
    return Figure(picture(folder / link, f"{name}: {caption.partition('. ')[0]}", link),
                  told(caption))  # fmt: skip


def _is_own(attributes: Mapping[str, Any]) -> bool:
    """Return whether a dataset is of a model of the user's own."""
    return "model_text" in attributes


def _is_of_pendula(attributes: Mapping[str, Any]) -> bool:
    return attributes.get("model") == PENDULA


def _period(attributes: Mapping[str, Any]) -> float:
    """Return the period of the pendula in units of tau."""
    mu = attributes["mu"]
    return np.pi * mu**2 / frequency(attributes["omega"], mu)


def _trust(checks) -> list[str]:
    """Return a row: until when the run agrees with one by another method."""
    question = f"agrees with {solver(checks.attrs, 'second')}"
    if reason := checks.attrs.get("second_refusal"):
        return [question, f"unknown: that run was rejected, {reason}"]
    level, parted = percent(VISIBLE), float(checks["divergence_time"])
    if not np.isfinite(parted):
        worst = number(checks["largest_difference"])
        return [question, f"to the end, to {worst} of full scale"]
    if _is_of_pendula(checks.attrs):
        then = "each may show another motion of the same kind from there on"
    elif checks.get("chaotic", 0):
        then = "from there on it is one of many solutions of the same kind: use its statistics"
    else:
        then = "the motion is not chaotic, and a smaller tolerance or step moves this time on"
    return [question, f"to τ = {number(parted, 4)}, within {level} of full scale; {then}"]


def _of_pendula(checks, moves: bool) -> list[list[str]]:
    """Return questions and answers on a case of the pendula."""
    if not moves:
        return [["motion", "the chain is at rest and stays so"]]
    over, followed = (
        bool(np.isfinite(checks[name])) for name in ("over_the_top", "expansion_error")
    )
    top = "yes: from there on the expansion (3) and the amplitude equations (4) do not apply"
    return [
        _trust(checks),
        ["a pendulum has gone over the top", top if over else "no"],
        ["the expansion (3) could be followed", "yes" if followed else "no"],
    ]


def _of_own_model(checks, moves: bool) -> list[list[str]]:
    """Return questions and answers on a case of a model of the user's own."""
    if not moves:
        return [["motion", "the chain is at rest and stays so"]]
    drifts = checks.get("conserved_drift", [])
    return [
        _trust(checks),
        _chaotic(checks),
        _localised(checks),
        *([f"change of {one['conserved_quantity'].item()}, over its largest size", number(one)]
          for one in drifts),
    ]  # fmt: skip


def _localised(checks) -> list[str]:
    """Return a row: the localised state of a model of the user's own, and whether it is stable."""
    question = "a localised state"
    if reason := checks.attrs.get("breather_refusal"):
        return [question, f"none: {reason}"]
    frequency, growth = (float(checks[f"breather_{name}"]) for name in ("frequency", "growth"))
    what = f"turns at the frequency {number(frequency)}" if frequency else "is steady"
    if checks["breather_end"] > LOCALISED:
        return [question, f"{what}, but reaches the ends of the chain"]
    grows = f"a perturbation grows at the rate {number(growth)}"
    return [question, f"{what}; {grows if growth else 'no perturbation grows'}"]


def _chaotic(checks) -> list[str]:
    lost = checks.attrs.get("sensitivity_refusal", "")
    return ["chaotic", f"unknown: {lost}" if lost else "yes" if checks["chaotic"] else "no"]


def _of_amplitudes(checks, moves: bool) -> list[list[str]]:
    """Return questions and answers on a case of the amplitude equations."""
    decided = _decided(checks)
    stable = {True: "unstable", False: "no growing mode"}
    rows = [
        ["Lemma 1, infinite chain at rest", stable[bool(checks["infinite_rate"] > 0)]],
        ["Lemma 1, this chain at rest", stable[bool(checks["finite_rate"] > 0)]],
    ]
    if checks.attrs["epsilon"] < 0:
        rows.append(["ε < 0", "the statements are on the equivalent chain with −ε and Ω − 4ε, of "
                     "which every other site has the opposite sign"])  # fmt: skip
    if not moves:
        return [["motion", "the chain is at rest and stays so"], *rows]
    growth = "holds"
    if not decided["growth_holds"]:
        growth = TOO_LARGE
    elif decided["too_steep"]:
        growth = "holds from the start on, but not between outputs: the errors of the run are large"
    region = str(checks["region"].values)
    covered = (
        "only Theorem 3 covers them" if region == "none" else f"{region.capitalize()} covers them"
    )
    bound = "the smallest bound holds" if decided["bound_holds"] else f"the bound is {TOO_LARGE}"
    balance = "followed" if decided["balanced"] else "could not be followed by the second method"
    return [
        _trust(checks),
        _chaotic(checks),
        *rows,
        ["Lemma 2, growth of P" + ("" if decided["driven"] else " (not driven)"), growth],
        ["Lemma 2, balance of P", balance],
        ["Theorems 1 to 3, these initial conditions", f"{covered}; {bound}"],
    ]


def _decided(checks) -> dict[str, bool]:
    """Return which statements hold of a case of the amplitude equations."""
    driven = 4.0 * abs(checks.attrs["gamma"]) * checks.attrs["end_time"] > WEAKEST
    error = np.nan_to_num(float(checks["largest_difference"]))
    limit = 1.0 + max(SLACK, 4.0 * error)  # P is a square, and both its values may be off
    return {
        "driven": driven,
        "growth_holds": bool(checks["from_start"] <= limit),
        "too_steep": bool(driven and checks["steepest"] > STEEPEST),
        "bound_holds": bool(checks["ratio"] <= limit),
        "balanced": bool(np.isfinite(checks["balance_error"])),
    }


def quotes(dataset, link: str) -> list[tuple[str, Quote]]:
    """Return every single known number of a dataset with its long name, linked to it."""
    return [
        (variable.attrs["long_name"], Quote(number(variable), link))
        for variable in dataset.data_vars.values()
        if variable.ndim == 0
        and np.issubdtype(variable.dtype, np.number)
        and not np.isnan(variable)
    ]


# --- Sweeps ---------------------------------------------------------------------------------------


def _sweep(name: str, case: str, folder: Path) -> dict[str, Any]:
    """Return what the page shows of the sweep over half-widths of a case."""
    link, drawn = f"own/sweeps/{name}.checks.nc", f"own/sweeps/{name}.nc"
    swept, checks = read(folder / f"sweeps/{name}.nc"), read(folder / link)
    panel = read(folder / drawn).isel(panel=0)
    of_pendula, is_own = _is_of_pendula(swept.attrs), _is_own(swept.attrs)
    pair = "all fields" if is_own else f"the pair {'(x, y), in rad,' if of_pendula else '(A, B)'}"
    read_as = [f"{STATISTICS[how]} {window}" for how, window in
               zip(panel["statistic"].values, panel["window"].values, strict=True)]  # fmt: skip
    caption = (
        f"Norms of {pair} against the half-width M, ℓ∞ left and ℓ² right. "
        f"Full marks: {read_as[0]}; hollow marks: {read_as[1]}."
    )
    rows = []
    for width in panel["half_width"].values:
        at, last = panel.sel(half_width=width), []
        values = [value for norm in NORMS for value in at[norm].values]
        if not is_own:
            own = checks.sel(half_width=width)
            last = [own["swept_angle"] if of_pendula
                    else (own["swept_observed"] / own["best"]).squeeze()]  # fmt: skip
        rows.append([exact(width), *(Quote(number(v), drawn) for v in values),
                     *(Quote(number(one), link) for one in last)])  # fmt: skip
    answers, last_column = [], []
    if of_pendula:
        last_column = ["largest angle in rad"]
        answers.append(("chains on which a pendulum goes over the top", Quote(
            number(checks["swept_over"]), link)))  # fmt: skip
    elif not is_own:
        last_column = ["largest P over its bound"]
        holds = bool(checks["swept_ratio"] <= 1.0 + SLACK)
        answers.append(("Theorems 1 to 3", "hold" if holds else TOO_LARGE))
    head = ["M", *(f"{norm} {how}" for norm in NORMS.values() for how in read_as), *last_column]
    return {
        "parameters": Table(f"The sweep over the case {case}, from sweeps/{name}.nc",
                            ("parameter", "value"), parameters(swept.attrs)),
        "picture": _figure(f"own/sweeps/{name}.png", caption, name, folder),
        "answers": Table("What the checks say", ("question", "answer"), answers),
        "numbers": Table(f"Norms by half-width; after two runs of the case differ, those of "
                         f"samples, from {drawn}", head, rows),
    }  # fmt: skip


# --- Parameters -----------------------------------------------------------------------------------


def exact(value: Any) -> str:
    """Return a number as a configuration has it, to the digits that a reader needs."""
    if isinstance(value, list):
        return f"{len(value)} values, in the dataset"
    if isinstance(value, complex):
        return str(value).strip("()") if value.imag else number(value.real, 8)
    return number(value, 8) if isinstance(value, int | float | np.number) else str(value)


def parameters(attributes: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Return the parameters of a problem and of its solver as rows of a table."""
    rows = [("model", EQUATIONS)] if _is_of_pendula(attributes) else []
    names, at_rest = "A, B", "x = y" if _is_of_pendula(attributes) else "A = B"
    if _is_own(attributes):
        names, at_rest = "fields", "every field"
        rows = [("model", attributes["model"])]
        rows += [(key, exact(one)) for key, one in json.loads(attributes["parameters"]).items()]
    rows += [(sign, exact(attributes[key])) for key, sign in _SIGNS.items() if key in attributes]
    rows.append(("ends of the chain", ends_of(attributes["boundary"]).words.format(at_rest)))
    sites = read_initial(attributes["initial"])
    if len(sites) > FEW:
        rows.append(
            (f"{names} at the start", f"on {len(sites)} sites, in the dataset's attributes")
        )
    else:
        rows += [(f"{names} at site {site}".replace("-", MINUS), ", ".join(map(exact, pair)))
                 for site, pair in sites.items()]  # fmt: skip
    times = (exact(attributes["end_time"]), exact(attributes["output_step"]))
    rows.append(("end time τ, output step", ", ".join(times)))
    rows.append(("solver", solver(attributes, "solver")))
    return rows


def solver(attributes: Mapping[str, Any], key: str) -> str:
    """Return a solver and its controls, which the attributes carry as `key`, `key`_rtol and so on.

    For a second run the name itself stands under second_name.
    """
    name = str(attributes[key if key in attributes else f"{key}_name"])
    controls = {
        at.removeprefix(f"{key}_"): value
        for at, value in attributes.items()
        if at.startswith(f"{key}_") and at not in (f"{key}_name", f"{key}_refusal")
    }
    said = ", ".join(f"{at.replace('_', ' ')} {exact(value)}" for at, value in controls.items())
    return f"{SOLVER_NAMES.get(name, name)} ({said})" if said else SOLVER_NAMES.get(name, name)
