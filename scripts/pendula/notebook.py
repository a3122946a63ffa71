"""The library for notebooks: cases, their runs and sweeps as xarray datasets, and checks of them.

Everything is dimensionless, as in the paper (Phys. Lett. A 381 (2017) 3884, arXiv 1708.06134):
time is tau = mu^2 t / 2 of its expansion (3), amplitudes are A_n and B_n of its equations (4).
Datasets have the workflow's variables, and are computed by the same code. The components of
amplitudes are "A" and "B", and a run has the energy H of equation (8). The components of pendula
are "x" and "y" in rad, with the parts "angle" and "velocity", without energy. Figures are
matplotlib's.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Unpack

import xarray as xr
from latticode import Model, notebook
from latticode.configuration import cases as library_cases
from latticode.configuration.initial import end_of_run
from latticode.configuration.keys import Initial, Numbers, RunKeys, show_keys
from latticode.notebook import draw_breather, draw_survey, read, simulate, survey, sweep

from pendula.configuration import cases
from pendula.configuration.cases import takes_model
from pendula.configuration.messages import Sections
from pendula.own_cases.checks import READ_VARIABLES, check_run

if TYPE_CHECKING:
    from matplotlib.figure import Figure

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


class PaperCaseKeys(RunKeys, total=False):
    """The keys of a case of the paper's equations, or of a user's own model, which has no omega."""

    omega: float
    epsilon: float
    gamma: float
    mu: float | None
    initial: Initial
    model: Literal["amplitudes", "pendula"] | Model | str | Path
    parameters: Mapping[str, Numbers]
    sites: int | None


class Case(cases.PaperCaseSection):
    """An initial-value problem of the paper's equations; its keys are checked at once.

    Keys and defaults are those of a case in YAML:

    omega: detuning Omega, the only key without a default.
    epsilon, gamma: coupling of neighbours and strength of the drive, both 1.
    half_width: M; the chain has 2M + 1 pairs on the sites -M..M. 30.
    boundary: "dirichlet" (A = B = 0 beyond the ends), "free" or "periodic".
    initial: {site: (A, B)} in complex numbers, at rest elsewhere. {0: (1, 0.1)}. Or an array, a
        function of the sites, a run or a file: see `latticode.Case`.
    start_time: in tau. 0, or the end of the run in `initial`.
    end_time, output_step: in tau; observables are kept at every step. 50 and 0.025.
    snapshot_step: in tau, between snapshots of the moduli on all sites. By default there are at
        least 200 snapshots.
    times: the times of the snapshots, instead of snapshot_step.
    keep: "moduli", "state" (moduli, and both parts of each amplitude in double precision) or
        "norms" (no snapshots).
    solver: "taylor" (1e-14), "dop853", "ode45", "crank_nicolson", "delfour_fortin_payre" or "auto",
        or a dict with the controls. Pendula have "kahan_li", but no energy-conserving schemes.
    model: "amplitudes"; "pendula", which also requires the small parameter mu; or a
        `latticode.Model` or the path of its file, with `parameters` instead of the constants.

    Raises ConfigurationError, whose message lists every invalid key.

    >>> Case(omega=-4).half_width
    30
    >>> Case(omgea=-4)
    Traceback (most recent call last):
    latticode.configuration.files.ConfigurationError: the case has 2 errors:
      omega: is missing
      omgea: is not a known key; did you mean 'omega'?
    """

    def __new__(cls, /, **keys: Any) -> Any:
        """Return a case of the paper's equations, or a `latticode.Case` for a user's own model."""
        return notebook.Case(**keys) if takes_model(keys.get("model")) else super().__new__(cls)

    def __init__(self, /, **keys: Unpack[PaperCaseKeys]) -> None:
        notebook.validate_case(super().__init__, keys, root=Sections)

    def changed(self, **keys: Unpack[PaperCaseKeys]) -> "Case":
        """Return a copy of the case with the values in `keys` changed, and checked again.

        >>> Case(omega=-4).changed(omega=8, half_width=10).half_width
        10
        """
        known = self.model_dump()
        if end_of_run(keys.get("initial")) is not None:
            del known["start_time"]  # the run sets it
        return Case(**{**known, **keys})


show_keys(Case, ("omega", "epsilon", "gamma", "initial"))


def check(case: library_cases.CaseSection, run: xr.Dataset | None = None) -> xr.Dataset:
    """Compare a run with the paper's theorems, and find until when it can be trusted.

    `run` is the result of `simulate(case)`; without it the case is integrated here. The
    returned dataset has numbers, each with long_name and units; pendula.own_cases.checks describes
    how they are computed.

    >>> checks = check(Case(omega=8, end_time=10))
    >>> str(checks["region"].values), bool(checks["ratio"] < 1)
    ('theorem 1', True)
    """
    model: Any = getattr(case, "model", "")
    variables = READ_VARIABLES.get(model, ())
    return notebook.check(case, run, check_run, *variables)


def draw_norms(run: xr.Dataset, checks: xr.Dataset | None = None) -> "Figure":
    """Draw the norms of A (red) and B (blue) against tau: l-infinity left, l2 right.

    With `checks`, the result of `pendula.check`, pale curves show the run by a second solver, and a
    mark shows the divergence time.

    >>> from pendula import Case, simulate
    >>> len(draw_norms(simulate(Case(omega=8, end_time=10))).axes)
    2
    """
    from .own_cases import figures  # here: importing matplotlib takes half a second

    notebook.require_norms(run, checks)
    return figures.draw_norms(figures.gather_norms(run, checks))


def draw_spacetime(run: xr.Dataset) -> "Figure":
    """Draw |A_n| (left) and |B_n| (right) over tau and sites, from a run with snapshots `modulus`.

    >>> from pendula import Case, simulate
    >>> len(draw_spacetime(simulate(Case(omega=8, end_time=10))).axes)
    3
    """
    from .own_cases import figures  # here: importing matplotlib takes half a second

    notebook.require(run, xr.Dataset, notebook.SNAPSHOTS, "modulus")
    return figures.draw_spacetime(figures.gather_spacetime(run))


def draw_sweep(
    sweep: xr.Dataset, max_window: str | None = None, mean_window: str | None = None
) -> "Figure":
    """Draw the norms of the pair (A, B) against the half-width M: l-infinity left, l2 right.

    Filled dots are the maximum over `max_window`, hollow dots the mean over `mean_window`; the
    default of both is the first window of the sweep.

    >>> from pendula import Case, sweep
    >>> len(draw_sweep(sweep(Case(omega=-4), [2, 4, 8], windows=[(1, 5)])).axes)
    2
    """
    from .own_cases import figures  # here: importing matplotlib takes half a second

    return figures.draw_sweep(notebook.gathered_sweep(sweep, max_window, mean_window))
