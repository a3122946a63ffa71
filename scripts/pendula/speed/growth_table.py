"""How cost grows, in words: over the chain and over time."""

import xarray as xr

from .growth import TOLERANCE

COMPARED = 1001, 100_001


def write_table(growth: xr.Dataset) -> str:
    """Return a page of Markdown."""
    return "\n".join(
        [
            "# How cost grows",
            "",
            *_over(
                growth, "sites", "seconds", f"Tolerance {TOLERANCE:.0e}, even noise on all sites"
            ),
            *_ratio(growth["seconds"]),
            "",
            *_over(growth, "end_time", "long_seconds", f"Tolerance {TOLERANCE:.0e}, one case"),
            "",
        ]
    )


def _over(growth: xr.Dataset, dim: str, name: str, words: str) -> list[str]:
    """Return the table of costs over sites or end times, a column a solver."""
    title, solvers = growth[dim].attrs["long_name"], growth["solver"].values
    lines = [
        f"## Time a site and unit of slow time, in µs, over the {title}",
        "",
        f"{words}, one core, medians.",
        "",
        f"| {title} | {' | '.join(solvers)} |",
        f"| --- |{' --- |' * len(solvers)}",
    ]
    for value in growth[dim].values:
        cells = [f"{1e6 * float(growth[name].sel({dim: value, 'solver': s})):.3g}" for s in solvers]
        lines.append(f"| {value:g} | {' | '.join(cells)} |")
    return lines


def _ratio(seconds: xr.DataArray) -> list[str]:
    """Return the last row of the table over sites, where it holds both chains compared."""
    if not set(COMPARED) <= set(seconds["sites"].values):
        return []
    short, long = (seconds.sel(sites=sites) for sites in COMPARED)
    cells = [f"{float(ratio):.3g}" for ratio in (long / short).values]
    return [f"| {COMPARED[1]} over {COMPARED[0]} | {' | '.join(cells)} |"]
