"""Draw speed against error in each regime, and how the cost grows."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save

from benchmarks import figures


def draw_speed(work_precision: str, cost: str, regimes: list[str], stems: list[str]) -> None:
    """Draw one figure a regime and then the cost, each to stem.png, .pdf, .nc and .json."""
    measured, drawn = read(work_precision), []
    for regime in regimes:
        data = figures.gather_work_precision(measured, regime)
        drawn.append((figures.draw_work_precision(data), data))
    data = figures.gather_cost(read(cost))
    drawn.append((figures.draw_cost(data), data))
    for stem, (figure, data) in zip(stems, drawn, strict=True):
        save(figure, data, *(f"{stem}.{kind}" for kind in ("png", "pdf", "nc", "json")))


if __name__ == "__main__":
    from job import run

    run(draw_speed, snakemake)  # noqa: F821
