"""Speed against error in each regime, and how the cost grows."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.plots import cost_growth, work_precision


def draw_speed(work: str, growth: str, regimes: list[str], stems: list[str]) -> None:
    """Draw one figure a regime and then the growth, each to stem.png, stem.pdf and stem.nc."""
    measured = read(work)
    drawn = [(work_precision.gather(measured, regime), work_precision.draw) for regime in regimes]
    drawn.append((cost_growth.gather(read(growth)), cost_growth.draw))
    for stem, (data, draw) in zip(stems, drawn, strict=True):
        save(draw(data), data, *(f"{stem}.{kind}" for kind in ("png", "pdf", "nc")))


if __name__ == "__main__":
    from job import run

    run(draw_speed, snakemake)  # noqa: F821
