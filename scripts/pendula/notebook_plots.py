"""The figures of a case and of a sweep for notebooks: a dataset in, a matplotlib Figure out.

A notebook shows the figure that a cell ends with; `figure.savefig("mine.pdf")` saves it.
"""

from pendula.studies.own import figures

__all__ = ["draw_norms", "draw_spacetime", "draw_sweep"]


def draw_norms(run, checks=None):
    """Draw the norms of A (red) and B (blue) against tau: l-infinity left, l2 right.

    `run` is a trajectory as `pendula.simulate` or `pendula.read` return it. With the `checks` that
    `pendula.check` made of it, their second run lies below in pale colours, and a mark shows from
    when on the two are other curves. Laid out as a row of Figs 2 to 4 of the paper.

    >>> from pendula import Case, simulate
    >>> len(draw_norms(simulate(Case(omega=8, end_time=10))).axes)
    2
    """
    return figures.draw_norms(figures.gather_norms(run, checks))


def draw_spacetime(run):
    """Draw |A_n| (left) and |B_n| (right) over tau and sites, from a run that keeps `modulus`.

    >>> from pendula import Case, simulate
    >>> len(draw_spacetime(simulate(Case(omega=8, end_time=10))).axes)
    3
    """
    return figures.draw_spacetime(figures.gather_spacetime(run))


def draw_sweep(sweep, max_window: str | None = None, mean_window: str | None = None):
    """Draw the norms of the pair (A, B) against the half-width M: l-infinity left, l2 right.

    Dots are the maximum over `max_window`, hollow ones the mean over `mean_window`, windows named
    as in the dataset; left out, the first window serves for both. As in Figs 5 and 6 of the paper.

    >>> from pendula import Case, sweep
    >>> len(draw_sweep(sweep(Case(omega=-4), [2, 4, 8], windows=[(1, 5)])).axes)
    2
    """
    return figures.draw_sweep(figures.gather_sweep(sweep, max_window, mean_window))
