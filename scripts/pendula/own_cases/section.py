"""The report on a user's cases and sweeps: figures, checks and parameters, all from datasets."""

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
from pendula.report.page import Picture, picture, render
from pendula.report.sections import versions
from pendula.report.words import (
    MINUS,
    NORMS,
    STATISTICS,
    Quote,
    number,
    percent,
    with_error,
)

# ASSUME: a bound counts as broken where the norms exceed it by more than their own error, and by
# more than this.
SLACK = 1e-6
STEEPEST = 1.01
"""Growth of P that is steeper than its bound by more than this is seen in the digits shown."""
WEAKEST = 1e-6
"""A drive that lets P grow by less over a whole run cannot be told from rounding."""
EIGHT = 8.0
"""Outputs in a period of the pendula that show how they swing."""
FEW = 8
"""The data of more sites do not fit into the table."""
EQUATIONS = "Newton's equations (1) of the pendula"
_SIGNS = {"mu": "μ", "omega": "Ω", "gamma": "γ", "epsilon": "ε", "half_width": "half-width M"}


def write_report(html: str, cases: list[str], sweeps: dict[str, str], files: list[str]) -> None:
    """Write the page `html` on `cases`, and on `sweeps` with the case of each.

    Their `files` lie below its folder.
    """
    with complete_or_absent(html) as partial:
        Path(partial).write_text(write(cases, sweeps, Path(html).parent), encoding="utf-8")


def write(cases: list[str], sweeps: dict[str, str], folder: Path) -> str:
    """Return the page on `cases`, and on `sweeps` with their cases; `folder` holds the files."""
    return render("section.html.j2", Path(__file__).parent, **gather(cases, sweeps, folder))


def gather(cases: list[str], sweeps: dict[str, str], folder: Path) -> dict[str, Any]:
    """Return what the page shows: `cases` by name, `sweeps` with the case that each repeats.

    Links are seen from `folder`, where the page will lie.
    """
    shown = [_case(case, folder) for case in cases]
    trusted = {case["name"]: case["divergence_time"] for case in shown}
    return {
        "cases": shown,
        "sweeps": [_sweep(name, case, folder, trusted) for name, case in sweeps.items()],
        "versions": {"pendula": __version__, **versions()},
    }


def _case(name: str, folder: Path) -> dict[str, Any]:
    """Return what the page shows of the case: numbers as quotes, and what they decide."""
    run, link = read(folder / f"trajectories/{name}.nc"), f"own/cases/{name}.checks.nc"
    checks = read(folder / link)
    return {
        "name": name,
        "run": f"trajectories/{name}.nc",
        "checks": link,
        "parameters": parameters(run.attrs),
        "norms": _picture_of_norms(name, run, folder),
        "spacetime": _picture_of_moduli(name, run, folder),
        "second": solver(checks.attrs, "second"),
        "refusals": {
            key: str(checks.attrs.get(f"{key}_refusal", "")) for key in ("second", "sensitivity")
        },
        "level": percent(VISIBLE),
        "divergence_time": float(checks["divergence_time"]),
        "parts": bool(np.isfinite(checks["divergence_time"])),
        "pendula": _is_of_pendula(run.attrs),
        "said": _said(checks, link),
        **(_decided_of_pendula(run, checks) if _is_of_pendula(run.attrs) else _decided(checks)),
    }


def _is_of_pendula(attributes: Mapping[str, Any]) -> bool:
    return attributes.get("model") == PENDULA


def _decided_of_pendula(run, checks) -> dict[str, Any]:
    period = np.pi * checks.attrs["mu"] ** 2 / frequency(checks.attrs["omega"], checks.attrs["mu"])
    return {
        "at_rest": not bool(run["linf"].any()),
        "over": bool(np.isfinite(checks["over_the_top"])),
        "followed": bool(np.isfinite(checks["expansion_error"])),
        "too_rare": bool(checks.attrs["output_step"] > period / EIGHT),
    }


def _said(checks, link: str) -> dict[str, Quote]:
    said = quotes(checks, link)
    if "exponent" in checks:
        rate = with_error(float(checks["exponent"]), float(checks["exponent_error"]))
        said["exponent"] = Quote(rate, link)
    return said | {
        key: Quote(number(checks.attrs[key]), link)
        for key in ("end_time", "gamma", "epsilon", "half_width")
    } | {"sites": Quote(number(2 * checks.attrs["half_width"] + 1, 8), link)}  # fmt: skip


def _decided(checks) -> dict[str, Any]:
    driven = 4.0 * abs(checks.attrs["gamma"]) * checks.attrs["end_time"] > WEAKEST
    error = np.nan_to_num(float(checks["largest_difference"]))
    limit = 1.0 + max(SLACK, 4.0 * error)  # P is a square, and both its values may be off
    return {
        "at_rest": float(checks["start"]) == 0.0,
        "chaotic": bool(checks.get("chaotic", 0)),
        "lost": bool(np.isfinite(checks.get("divergence_rounding", np.nan))),
        "region": str(checks["region"].values),
        "driven": driven,
        "growth_holds": bool(checks["from_start"] <= limit),
        "too_steep": bool(driven and checks["steepest"] > STEEPEST),
        "bound_holds": bool(checks["ratio"] <= limit),
        "infinite_grows": bool(checks["infinite_rate"] > 0),
        "finite_grows": bool(checks["finite_rate"] > 0),
        "balanced": bool(np.isfinite(checks["balance_error"])),
        "other_sign": float(checks.attrs["epsilon"]) < 0,
    }


def _picture_of_norms(name: str, run, folder: Path) -> Picture:
    parts = []
    for norm, word in (("linf", "l-infinity"), ("l2", "l2")):
        for component in run["component"].values:
            curve = run[norm].sel(component=component)
            first, top, last = (number(x) for x in (curve[0], curve.max(), curve[-1]))
            when = number(curve["tau"][int(np.argmax(curve.values))])
            parts.append(
                f"{word} of {component} starts at {first}, has its largest value {top} at {when} "
                f"and ends at {last}"
            )
    end = number(run["tau"][-1])
    alt = f"Norms of {name} against tau from 0 to {end}: {'; '.join(parts)}."
    link = f"own/cases/{name}.png"
    return picture(folder / link, alt, link)


def _picture_of_moduli(name: str, run, folder: Path) -> Picture:
    modulus, sites = run["modulus"].max("component"), run["site"].values
    site, when = (int(i) for i in np.unravel_index(int(np.argmax(modulus.values)), modulus.shape))
    link = f"own/cases/{name}.spacetime.png"
    alt = (
        f"Moduli of {' and '.join(run['component'].values)} of {name} over sites "
        f"{sites[0]} to {sites[-1]} and tau from 0 to {number(run['tau'][-1])}: the largest, "
        f"{number(modulus.max())}, on site {sites[site]} at "
        f"{number(run['snapshot_tau'][when])}."
    )
    return picture(folder / link, alt, link)


def _sweep(name: str, case: str, folder: Path, trusted: dict[str, float]) -> dict[str, Any]:
    """Return what the page shows of the sweep.

    `trusted` holds the divergence time of two runs of each case, NaN if it is not known.
    """
    link, drawn_link = f"own/sweeps/{name}.checks.nc", f"own/sweeps/{name}.nc"
    swept, drawn, checks = (read(folder / at) for at in (f"sweeps/{name}.nc", drawn_link, link))
    panel = drawn.isel(panel=0)
    read_as = list(zip(panel["statistic"].values, panel["window"].values, strict=True))
    windows = [(STATISTICS[how], window) for how, window in read_as]
    of_pendula = _is_of_pendula(swept.attrs)
    return {
        "pendula": of_pendula,
        **(_went_over if of_pendula else _beside_bounds)(checks, link),
        "name": name,
        "case": case,
        "is_own": case in trusted,
        "divergence_time": trusted.get(case, np.nan),
        "parts": bool(trusted.get(case, np.nan) < swept.attrs["end_time"]),
        "data": f"sweeps/{name}.nc",
        "checks": link,
        "parameters": parameters(swept.attrs),
        "picture": _picture_of_sweep(name, panel, windows, folder),
        "windows": windows,
        "columns": [
            "M",
            *(f"{word} {how} {window}" for word in NORMS.values() for how, window in read_as),
            "largest angle" if of_pendula else "P over bound",
        ],
        "rows": _rows(panel, checks, drawn_link, link),
    }


def _beside_bounds(checks, link: str) -> dict[str, Any]:
    ratio = checks["swept_ratio"]
    return {"excess": Quote(number(ratio), link), "bound_holds": bool(ratio <= 1.0 + 1e-6)}


def _went_over(checks, link: str) -> dict[str, Any]:
    count = checks["swept_over"]
    return {"over": Quote(number(count), link), "any_over": bool(count > 0)}


def _rows(panel, checks, drawn_link: str, link: str) -> list[list]:
    rows = []
    for width in panel["half_width"].values:
        at = panel.sel(half_width=width)
        if "swept_angle" in checks:
            last = checks["swept_angle"].sel(half_width=width)
        else:
            bound = checks.isel(sweep=0).sel(half_width=width)
            last = bound["swept_observed"] / bound["best"]
        values = [value for norm in NORMS for value in at[norm].values]
        quoted = (Quote(number(v), drawn_link) for v in values)
        rows.append([exact(width), *quoted, Quote(number(last), link)])
    return rows


def _picture_of_sweep(name: str, panel, windows: list[tuple[str, str]], folder: Path) -> Picture:
    widths = panel["half_width"].values
    parts = [
        f"the {how} of {norm} on {window} goes from {number(values[0])} to {number(values[-1])}"
        for norm in NORMS
        for (how, window), values in zip(windows, panel[norm].values, strict=True)
    ]
    link = f"own/sweeps/{name}.png"
    alt = (
        f"Norms of {name} against the half-width, {exact(widths[0])} to {exact(widths[-1])}: "
        f"{'; '.join(parts)}."
    )
    return picture(folder / link, alt, link)


def exact(value: Any) -> str:
    """Return a number as a configuration has it, to the digits that a reader needs."""
    if isinstance(value, complex):
        return str(value).strip("()") if value.imag else number(value.real, 8)
    return number(value, 8) if isinstance(value, int | float | np.number) else str(value)


def parameters(attributes: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Return the parameters of a problem and of its solver as rows of a table."""
    rows = [("model", EQUATIONS)] if _is_of_pendula(attributes) else []
    rows += [(sign, exact(attributes[key])) for key, sign in _SIGNS.items() if key in attributes]
    at_rest = "x = y" if _is_of_pendula(attributes) else "A = B"
    rows.append(("ends of the chain", ends_of(attributes["boundary"]).words.format(at_rest)))
    rows += data(attributes)
    rows.append(("end time τ, output step", f"{exact(attributes['end_time'])}, "
                 f"{exact(attributes['output_step'])}"))  # fmt: skip
    rows.append(("solver", solver(attributes, "solver")))
    return rows


def data(attributes: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Return the sites that are not at rest at the start, each with its amplitudes, if few."""
    sites = read_initial(attributes["initial"])
    if len(sites) > FEW:
        return [("A, B at the start", f"on {len(sites)} sites, as the dataset's attributes say")]
    return [
        (f"A, B at site {site}".replace("-", MINUS), ", ".join(map(exact, pair)))
        for site, pair in sites.items()
    ]


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


def quotes(dataset, link: str) -> dict[str, Quote]:
    """Return every single number of a dataset, linked to it."""
    return {
        name: Quote(number(variable), link)
        for name, variable in dataset.data_vars.items()
        if variable.ndim == 0 and np.issubdtype(variable.dtype, np.number)
    }
