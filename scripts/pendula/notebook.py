"""The library for notebooks: cases, their runs and sweeps as xarray datasets, and checks of them.

Everything is dimensionless, as in the paper (Phys. Lett. A 381 (2017) 3884, arXiv 1708.06134):
time is tau = mu^2 t / 2 of its expansion (3), amplitudes are A_n and B_n of its equations (4),
rates are per unit of tau. Datasets are those that the workflow writes, by the same code.
Figures are matplotlib's: a notebook shows the one that a cell ends with, and saves it by
`figure.savefig("mine.pdf")`.
"""

from collections.abc import Iterable

import xarray as xr
from latticode import notebook
from latticode.notebook import draw_breather, draw_survey, read, survey

from pendula.configuration import cases
from pendula.configuration.cases import takes_model
from pendula.configuration.messages import Sections
from pendula.own_cases.checks import KEPT, check_run

__all__ = [
    "Case",
    "check",
    "draw_breather",
    "draw_norms",
    "draw_spacetime",
    "draw_survey",
    "draw_sweep",
    "read",
    "simulate",
    "survey",
    "sweep",
]


class Case(cases.Case):
    """One initial-value problem of the paper's equations, checked when it is made.

    They are the equations (4) of the amplitudes, or Newton's equations (1) of the pendula.

    Keys and defaults are those of a case in YAML:

    omega: detuning Omega, the only key without a default.
    epsilon, gamma: coupling of neighbours and strength of the drive, both 1.
    half_width: M; the chain has 2M + 1 pairs on the sites -M..M. 30.
    boundary: "dirichlet" (A = B = 0 beyond the ends), "free" or "periodic".
    initial: {site: (A, B)} in complex numbers, at rest elsewhere. {0: (1, 0.1)}.
    end_time, output_step: in tau; observables are kept at every step. 50 and 0.025.
    snapshot_step: in tau; how often the moduli on all sites are kept, whole output steps.
        They divide the run. Left out, 200 snapshots or more are spread over it.
    solver: "taylor" (1e-14), "dop853", "ode45", "crank_nicolson", "delfour_fortin_payre" or "auto",
        or a dict with the controls, such as {"name": "auto", "error": 1e-9}. The pendula have
        "taylor", "dop853", "ode45", "kahan_li" and "auto".
    model: "amplitudes", or "pendula"; these need mu, and start from the angles and velocities that
        the expansion (3) makes of `initial`.
    mu: the small parameter of (3); angles have the size of 2 mu A.

    A `latticode.Model`, or the path of its file, may stand for the model. The case then has
    `parameters` in place of epsilon, gamma, omega and mu: {name: a number, or one for each site},
    and `initial` has a value for each field.

    Raises ConfigurationError, with every fault in words.

    >>> Case(omega=-4).half_width
    30
    >>> Case(omgea=-4)
    Traceback (most recent call last):
    latticode.configuration.files.ConfigurationError: the case has 2 errors:
      omega: is missing
      omgea: is not a known key; did you mean 'omega'?
    """

    def __new__(cls, /, **keys):
        """Return a case of the kind that its model asks for."""
        return notebook.Case(**keys) if takes_model(keys.get("model")) else super().__new__(cls)

    def __init__(self, /, **keys):
        notebook.made(super().__init__, keys, root=Sections)

    def changed(self, **keys) -> notebook.Case:
        """Return the case with other values under `keys`, checked anew.

        >>> Case(omega=-4).changed(omega=8, half_width=10).half_width
        10
        """
        return Case(**{**self.model_dump(), **keys})


def simulate(case: Case, name: str = "case", hours: float | None = None):
    """Integrate a case and return its trajectory as an xarray.Dataset.

    Coordinates: tau (time,), component ("A", "B"), site (-M..M), part ("re", "im").
    Variables, all without units (those of the pendula, ("x", "y") and ("angle", "velocity"), are
    in rad, and have no energy):

    linf, l2 (component, tau): max_n |A_n| and sqrt(sum_n |A_n|^2); the same of B.
    energy (tau): the conserved H of equation (8).
    modulus (component, site, snapshot): |A_n|, |B_n| at the times `snapshot`, as snapshot_tau has.
    final (part, component, site): the amplitudes at end_time.

    Attributes: every parameter, the solver's controls and its work, `name` as "case". All but
    `final` is what `snakemake results/trajectories/{name}.nc` writes.

    A run that would take more than `hours` (1 if they are left out) or 8 GB of memory is refused
    before it starts; one of some minutes says first what it takes.

    Raises ConfigurationError for such a run; IntegrationError, with the reason, where the solver
    cannot reach end_time with the digits that were asked for.

    >>> run = simulate(Case(omega=8, end_time=10))
    >>> run["l2"].shape, run["modulus"].shape
    ((2, 401), (2, 61, 201))
    >>> bool(abs(run["energy"] - run["energy"][0]).max() < 1e-11)
    True
    """
    return notebook.simulate(case, name, hours)


def sweep(
    case: Case,
    half_widths: Iterable[int],
    windows: Iterable[tuple[float, float]] = ((10, 40), (10, 50), (10, 70)),
    name: str = "sweep",
    hours: float | None = None,
):
    """Integrate a case on chains of many half-widths; return maxima and means of its norms.

    `windows` are (start, end) in tau, both included, on output steps; the case is run to the end
    of the last one, whatever its end_time. The defaults are the windows of the paper.

    Returns an xarray.Dataset with l2 and linf (half_width, quantity, statistic, window), without
    units: quantity is "A", "B" or "pair" (the root of the sum of squares in l2, the larger in
    linf), statistic "max" or "mean" (over time, trapezoidal), windows are named "[10, 50]". Of the
    pendula quantity is "x", "y" or "pair", in rad. Attributes as in `simulate`. The same as
    `snakemake results/sweeps/{name}.nc` writes.

    Raises ConfigurationError for windows off the grid, initial data outside a chain, or a sweep
    that would take more than `hours` (1 if they are left out); IntegrationError as `simulate`.

    >>> peaks = sweep(Case(omega=-4), [2, 4, 8], windows=[(1, 5)])
    >>> peaks["l2"].sel(quantity="pair", statistic="max", window="[1, 5]").shape
    (3,)
    """
    return notebook.sweep(case, half_widths, windows, name, hours)


def check(case: Case, run=None):
    """Set a run beside the paper's lemmas and theorems, and measure how far it can be trusted.

    `run` is what `simulate` made of the case; if it is left out, the case is integrated here.
    Returns an xarray.Dataset of numbers, each with a long_name and units; pendula.own_cases.checks
    says how each is computed.

    >>> found = check(Case(omega=8, end_time=10))
    >>> str(found["region"].values), bool(found["ratio"] < 1)
    ('theorem 1', True)
    """
    kept = KEPT.get(getattr(case, "model", None), ())
    return notebook.check(case, run, check_run, *kept)


def draw_norms(run, checks=None):
    """Draw the norms of A (red) and B (blue) against tau: l-infinity left, l2 right.

    `run` is a trajectory as `pendula.simulate` or `pendula.read` return it. With the `checks` that
    `pendula.check` made of it, their second run is drawn below it in pale colours, and a mark shows
    the divergence time. The layout is that of a row of Figs 2 to 4 of the paper.

    >>> from pendula import Case, simulate
    >>> len(draw_norms(simulate(Case(omega=8, end_time=10))).axes)
    2
    """
    from .own_cases import figures  # here, so that who draws nothing does without it

    notebook.require_norms(run, checks)
    return figures.draw_norms(figures.gather_norms(run, checks))


def draw_spacetime(run):
    """Draw |A_n| (left) and |B_n| (right) over tau and sites, from a run that keeps `modulus`.

    >>> from pendula import Case, simulate
    >>> len(draw_spacetime(simulate(Case(omega=8, end_time=10))).axes)
    3
    """
    from .own_cases import figures  # here, so that who draws nothing does without it

    notebook.require(run, xr.Dataset, notebook.SNAPSHOTS, "modulus")
    return figures.draw_spacetime(figures.gather_spacetime(run))


def draw_sweep(sweep, max_window: str | None = None, mean_window: str | None = None):
    """Draw the norms of the pair (A, B) against the half-width M: l-infinity left, l2 right.

    Filled dots are the maximum over `max_window`, hollow dots the mean over `mean_window`. Windows
    are named as in the dataset; where one is left out, the first is taken. The layout is that of
    Figs 5 and 6 of the paper.

    >>> from pendula import Case, sweep
    >>> len(draw_sweep(sweep(Case(omega=-4), [2, 4, 8], windows=[(1, 5)])).axes)
    2
    """
    from .own_cases import figures  # here, so that who draws nothing does without it

    return figures.draw_sweep(notebook.gathered_sweep(sweep, max_window, mean_window))
