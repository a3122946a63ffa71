"""All figures of a run, with functions that gather their accepted data and draw them."""

from accepted import dataset
from pendula.studies.breathers import figures as breathers
from pendula.studies.chaos import figures as chaos
from pendula.studies.newton import figures as pendula
from pendula.studies.paper import chain_figure
from pendula.studies.paper import figures as paper
from pendula.studies.theory import figures as theory
from pendula.studies.unbounded import figures as unbounded


def norms_of(figure: str) -> tuple[list, list]:
    """Return both runs of a figure of norms, and these runs with its true norms."""
    truth = dataset(f"figures/{figure}")
    runs = [dataset(f"trajectories/{figure}_{size}") for size in paper.SIZES]
    truth = [truth.sel(initial_size=size).dropna("tau", subset=["true_l2"]) for size in paper.SIZES]
    true = [
        run.assign(l2=true_norms["true_l2"], linf=true_norms["true_linf"])
        for run, true_norms in zip(runs, truth, strict=True)
    ]
    return runs, true


def gather_norms(figure: str, ensembles=None):
    return paper.gather_norms(*norms_of(figure), ensembles)


def gather_sweeps(figure: str, windows: tuple[str, str], norms: list[str]):
    sweeps = (dataset(f"sweeps/{figure}_{side}") for side in ("left", "right"))
    return paper.gather_sweeps(*sweeps, *windows, norms, dataset("checks/ensembles"))


FIGURES = {
    "fig1": (chain_figure.draw_chain, chain_figure.gather_chain),
    "fig2": (paper.draw_norms, lambda: gather_norms("fig2")),
    "fig3": (paper.draw_norms, lambda bands: gather_norms("fig3", bands), "checks/members"),
    "fig4": (paper.draw_norms, lambda bands: gather_norms("fig4", bands), "checks/members"),
    **{
        f"fig{n}_spacetime": (
            paper.draw_spacetime,
            lambda spacetime, n=n: paper.gather_spacetime(norms_of(f"fig{n}")[0], spacetime),
            f"figures/fig{n}",
        )
        for n in (2, 3, 4)
    },
    "fig5": (
        paper.draw_sweeps,
        lambda: gather_sweeps("fig5", ("[10, 50]", "[10, 50]"), ["l2", "linf"]),
    ),
    "fig6": (paper.draw_sweeps, lambda: gather_sweeps("fig6", ("[10, 70]", "[10, 40]"), ["l2"])),
    "energy_drift": (paper.draw_drift, paper.gather_drift, "checks/solvers"),
    "trust_horizons": (paper.draw_trust, paper.gather_trust, "checks/trust"),
    "fates": (breathers.draw_fates, breathers.gather_fates, "breathers/fates", "quoted/breathers"),
    "lifetimes": (chaos.draw_lifetimes, chaos.gather_lifetimes, "checks/lifetimes"),
    "pendula_over_the_top": (
        pendula.draw_over_the_top,
        pendula.gather_over_the_top,
        "pendula/over_the_top",
    ),
    "bounds": (theory.draw_bounds, theory.gather_bounds, "checks/cases"),
    "stability_chart": (
        theory.draw_chart,
        lambda chart: theory.gather_chart(chart, [(-4.0, 1.0), (0.0, 1.0), (8.0, 1.0)], True),
        "checks/chart",
    ),
    "fronts": (
        unbounded.draw_fronts,
        unbounded.gather_fronts,
        "unbounded/fronts",
        "quoted/unbounded",
    ),
    "growth_law": (
        unbounded.draw_growth_law,
        lambda *data: unbounded.gather_growth_law(data[:-1], data[-1]),
        *(f"unbounded/{name}" for name in ("fig4_small", "fig3_large", "fig2_large", "fig3_small")),
        "unbounded/thermal",
    ),
}
"""For each figure: the function that draws it, the one that gathers its data, and datasets."""
