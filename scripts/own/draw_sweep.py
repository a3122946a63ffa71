"""A sweep of one's own: its norms against the half-width, beside what is checked of it."""

import xarray
from pendula.datasets.netcdf import read, save
from pendula.drawing.style import save as save_figure
from pendula.own_cases import figures
from pendula.own_cases.pendula import check_sweep
from pendula.problem import PENDULA
from pendula.studies.theory.bounds import check_sweeps


def draw_sweep(
    sweep: str,
    name: str,
    text_window: str,
    caption_window: str,
    checks: str,
    figure: list[str],
) -> None:
    """Draw the maximum over one window and the mean over another; check the norms by `name`."""
    swept = read(sweep)
    drawn = figures.gather_sweep(swept, text_window, caption_window)
    save_figure(figures.draw_sweep(drawn), drawn, *figure)
    if swept.attrs.get("model") == PENDULA:
        save(checks, check_sweep(name, swept))
    else:
        save(checks, xarray.Dataset.from_dict(check_sweeps({name: swept})))


if __name__ == "__main__":
    from job import run

    run(draw_sweep, snakemake)  # noqa: F821
