"""One sweep of one's own: its figure, its norms by half-width, and the bounds of the theorems."""

from pathlib import Path
from typing import Any

import numpy as np

from pendula.datasets.netcdf import read
from pendula.report.numbers import Quote, number
from pendula.report.pictures import Picture, picture
from pendula.studies.paper.section_sweeps import NORMS, STATISTICS

from .words import exact, parameters


def gather(name: str, case: str, folder: Path, trusted: dict[str, float]) -> dict[str, Any]:
    """Return what the page shows of the sweep.

    `trusted` holds, by case, the tau at which two runs of it part, NaN if they never do.
    """
    link, drawn_link = f"own/sweeps/{name}.checks.nc", f"own/sweeps/{name}.nc"
    swept, drawn, checks = (read(folder / at) for at in (f"sweeps/{name}.nc", drawn_link, link))
    panel = drawn.isel(panel=0)
    read_as = list(zip(panel["statistic"].values, panel["window"].values, strict=True))
    windows = [(STATISTICS[how], window) for how, window in read_as]
    return {
        "name": name,
        "case": case,
        "is_own": case in trusted,
        "divergence_time": trusted.get(case, np.nan),
        "parts": bool(trusted.get(case, np.nan) < swept.attrs["end_time"]),
        "data": f"sweeps/{name}.nc",
        "checks": link,
        "parameters": parameters(swept.attrs),
        "picture": _picture(name, panel, windows, folder),
        "windows": windows,
        "excess": Quote(number(checks["excess"]), link),
        "bound_holds": bool(checks["excess"] <= 1.0 + 1e-6),
        "columns": ["M", *_columns(read_as), "P over bound"],
        "rows": _rows(panel, checks, drawn_link, link),
    }


def _columns(windows: list[tuple[str, str]]) -> list[str]:
    return [f"{word} {how} {window}" for word in NORMS.values() for how, window in windows]


def _rows(panel, checks, drawn_link: str, link: str) -> list[list]:
    rows = []
    for width in panel["half_width"].values:
        at = panel.sel(half_width=width)
        bound = checks.isel(sweep=0).sel(half_width=width)
        values = [value for norm in NORMS for value in at[norm].values]
        ratio = Quote(number(bound["observed"] / bound["best"]), link)
        rows.append([exact(width), *(Quote(number(v), drawn_link) for v in values), ratio])
    return rows


def _picture(name: str, panel, windows: list[tuple[str, str]], folder: Path) -> Picture:
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
