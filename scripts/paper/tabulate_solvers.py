"""The paper's two solvers in numbers: conservation of the energy, and agreement."""

import math
from pathlib import Path

import xarray
from pendula.datasets.files import complete_or_absent
from pendula.datasets.netcdf import read


def compare_solvers(
    energy: str, agreement: str, first: list[str], second: list[str], sweeps: list[str], table: str
) -> None:
    """Write the tables; `first` and `second` are the sweeps by the one solver and the other."""
    pairs = {
        name: (read(one), read(other))
        for name, one, other in zip(sweeps, first, second, strict=True)
    }
    sections = [
        *energy_section(read(energy)),
        *agreement_section(read(agreement)),
        *sweep_section(pairs),
    ]
    with complete_or_absent(table) as partial:
        Path(partial).write_text("\n".join(sections) + "\n", encoding="utf-8")


def row(*cells: object) -> str:
    return "| " + " | ".join(map(str, cells)) + " |"


def head(*cells: str) -> list[str]:
    return [row(*cells), row(*("---" for _ in cells))]


def energy_section(data: xarray.Dataset) -> list[str]:
    """Return the largest drift by tau = 10 and by the end, beside the paper's claim."""
    end = float(data["tau"].max())
    lines = [
        "# The two solvers of the paper",
        "",
        "## Conservation of the energy",
        "",
        f"Largest drift of H by tau = {min(10.0, end):g} / by tau = {end:g}, beside the order that",
        "the paper states. A claim holds where the drift stays below twice that order.",
        "",
        *head("case", "paper", *(str(s) for s in data["solver"].values), "ode45 as claimed"),
    ]
    for case in data["case"].values:
        drift = data["drift"].sel(case=case)
        early, late = drift.sel(tau=slice(0, 10)).max("tau"), drift.max("tau")
        claim = float(data["claim"].sel(case=case))
        verdicts = [
            word if float(reached.sel(solver="ode45")) < 2 * claim else f"not {word}"
            for reached, word in ((early, "early"), (late, "to the end"))
        ]
        cells = [
            f"{float(early.sel(solver=s)):.1e} / {float(late.sel(solver=s)):.1e}"
            for s in data["solver"].values
        ]
        lines.append(row(case, f"{claim:.0e}", *cells, ", ".join(verdicts)))
    return lines


def agreement_section(data: xarray.Dataset) -> list[str]:
    """Return the divergence time of each pair of solvers in each case."""
    visible = float(data["visible"])
    lines = [
        "",
        "## Agreement of the trajectories",
        "",
        f"The first tau at which the norms of two solvers differ by {visible:.0%} of full scale,",
        "and the largest difference. Once a pair has diverged in a chaotic case, it stays so: the",
        "curves are then two different solutions of the same kind.",
        "",
        *head("case", *(str(pair) for pair in data["pair"].values)),
    ]
    for case in data["case"].values:
        cells = []
        for pair in data["pair"].values:
            time = float(data["divergence_time"].sel(case=case, pair=pair))
            largest = float(data["difference"].sel(case=case, pair=pair).max())
            cells.append(
                f"never ({largest:.0e})" if time == math.inf else f"{time:.1f} ({largest:.0e})"
            )
        lines.append(row(case, *cells))
    return lines


def sweep_section(pairs: dict) -> list[str]:
    """Return how far the swept l2 norms of the pair differ between the paper's two solvers."""
    lines = [
        "",
        "## Agreement of the sweeps",
        "",
        "Largest and median difference of the pair's l2 norm between the two solvers over all",
        "half-widths, relative to the first solver's value.",
        "",
        *head("sweep", "window", "maximum: largest / median", "mean: largest / median"),
    ]
    for name, (one, other) in pairs.items():
        difference = abs(other["l2"] / one["l2"] - 1).sel(quantity="pair")
        for window in one["window"].values:
            cells = [
                f"{float(d.max()):.1e} / {float(d.median()):.1e}"
                for d in (difference.sel(window=window, statistic=s) for s in ("max", "mean"))
            ]
            lines.append(row(name, window, *cells))
    return lines


if __name__ == "__main__":
    from job import run

    run(compare_solvers, snakemake)  # noqa: F821
