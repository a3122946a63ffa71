"""How cost grows, in words: over the chain, over time, and in batches of runs."""

import numpy as np
import xarray as xr

from .batching import END
from .batching import TOLERANCE as BATCH_TOLERANCE
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
            *_batches(growth),
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


def _batches(growth: xr.Dataset) -> list[str]:
    """Return the table of what batches save."""
    sizes = growth["batch"].values
    lines = [
        "## How many times cheaper a run is in a batch than alone",
        "",
        f"taylor at {BATCH_TOLERANCE:.0e} to tau = {END:g} from noise on all sites, one core; "
        "medians of runs in turns, with the least and the largest. Both give the same bits.",
        "",
        f"| number of sites N | alone, ms | {' | '.join(f'{size} runs' for size in sizes)} |",
        f"| --- | --- |{' --- |' * len(sizes)}",
    ]
    for sites in growth["short_sites"].values:
        row = growth.sel(short_sites=sites)
        alone = 1e3 * float(np.median(row["alone_seconds"]))
        gains = [
            f"{float(one['gain']):.3g} ({float(one['gain_least']):.3g} to "
            f"{float(one['gain_most']):.3g})"
            for one in (row.sel(batch=size) for size in sizes)
        ]
        lines.append(f"| {sites} | {alone:.3g} | {' | '.join(gains)} |")
    return lines
