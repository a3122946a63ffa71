"""The library for notebooks: cases of a model; runs, sweeps and checks as datasets; figures.

Equations are treated as dimensionless. Results are xarray.Datasets, in which each variable has a
long_name and units. Figures are from matplotlib: a notebook shows the figure in the last line of a
cell, and `figure.savefig("mine.pdf")` saves it.

Errors: ModelError if equations cannot be traced; ConfigurationError, which lists all invalid
arguments; IntegrationError if a run cannot reach its end with the requested accuracy; DatasetError
if a file cannot be read or written.
"""

from collections.abc import Callable, Iterable, Mapping
from functools import partial
from numbers import Integral
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np
import xarray as xr
from pydantic import ValidationError

from latticode.checks import UNSTABLE_REST, check_run
from latticode.configuration import cases, cost, values
from latticode.configuration.files import ConfigurationError, list_faults
from latticode.configuration.initial import end_of_run
from latticode.configuration.keys import CaseKeys, ChangedKeys, show_keys
from latticode.configuration.messages import configuration_error
from latticode.configuration.schema import Configuration, RunLimits, load
from latticode.configuration.solvers import DEFAULT, with_controls
from latticode.datasets import netcdf
from latticode.datasets.motions import measure_exponents, section_at
from latticode.datasets.netcdf import as_xarray
from latticode.datasets.stated import describe_run
from latticode.datasets.surveys import COUNTS, runs_in, survey_contents
from latticode.datasets.trajectories import final_state, sweep_contents, trajectory_contents
from latticode.equations.model import Model
from latticode.integrators.families import remark_on
from latticode.localised.sections import DIRECTIONS
from latticode.localised.spectra import count_directions
from latticode.simulation import simulate as simulation
from latticode.simulation import survey_runs
from latticode.simulation import sweep as sweeps
from latticode.simulation.problem import Problem
from latticode.simulation.progress import show_progress
from latticode.simulation.runs import Retained, run_until_interrupted
from latticode.simulation.survey import Survey, names_of

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
    "lyapunov",
    "read",
    "section",
    "simulate",
    "survey",
    "sweep",
]


class Case(cases.CaseSection):
    """An initial-value problem of a model, checked when it is created.

    Keys and defaults are those of a case in YAML:

    model: a Model, or the path of its file.
    parameters: {name: a number, one number per site, or a function of the sites}; by default the
        values of the model.
    initial: the fields at the start, complex. A field with d2_dt2 has its value as the real part
        and its rate as the imaginary part. Give one of
        - {site: [a value for each field]}; other sites are at rest;
        - an array (site,), or (field, site) for several fields;
        - a function of the array of sites that returns such an array;
        - a run, which is continued from its end;
        - a DataArray over site, such as run["state"].sel(snapshot=20);
        - a file with one of these: .nc, .npy, or .py that defines `initial`.
    start_time: the time p.t at the start. Default: 0, or the end of the run in `initial`.
    half_width: M; the chain has the 2M + 1 sites -M..M. Default: 30.
    sites: N, instead of half_width; the chain has the N sites 0..N-1.
    boundary: "dirichlet" (default; zero beyond the ends), "free" (beyond the ends is the mirror
        image of the chain, so coupling to second neighbours adds a bond between the last two
        sites), "periodic" or "antiperiodic".
    end_time, output_step: the end, and the time step of stored norms. Default: 50 and 0.025.
    snapshot_step: the time step at which the fields on all sites are stored, a multiple of
        output_step that divides the run. Default: one that gives at least 200 snapshots.
    times: instead of snapshot_step, a list of the times of the snapshots.
    keep: "state" (moduli and both parts of each field in double precision, the default), "moduli"
        (in single precision, a sixth of the memory) or "norms" (no snapshots).
    solver: "taylor" (tolerance 1e-14, the default), "dop853", "ode45", "crank_nicolson", "kahan_li"
        or "auto", or a dict with controls, such as {"name": "auto", "error": 1e-9}.

    Raises ConfigurationError, which lists all errors.

    >>> from latticode import Model, abs2, lap
    >>> dnls = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + abs2(u) * u)
    >>> Case(model=dnls, initial={0: [1.5]}).half_width
    30
    >>> Case(model=dnls, initail={0: [1.5]})
    Traceback (most recent call last):
    latticode.configuration.files.ConfigurationError: the case has 2 errors:
      initial: is missing
      initail: is not a known key; did you mean 'initial'?
    """

    def __init__(self, /, **keys: Unpack[CaseKeys]) -> None:
        validate_case(super().__init__, keys)

    def changed(self, **keys: Unpack[ChangedKeys]) -> "Case":
        """Return a new case with other values of `keys`, checked again."""
        values = self.model_dump()
        if end_of_run(keys.get("initial")) is not None:
            del values["start_time"]  # the run in `initial` has its own
        for key, replaced in (("sites", "half_width"), ("half_width", "sites")):
            if keys.get(key) is not None and replaced in values:
                values[replaced] = None
        return type(self)(**{**values, **keys})


show_keys(Case, ("model", "parameters", "initial"))


def validate_case(
    initialise: Callable, keys: Mapping, root: type[Configuration] = Configuration
) -> None:
    """Call the initialiser of a case with its keys, which belong to the configuration `root`.

    Raises ConfigurationError, which lists all errors.
    """
    try:
        initialise(**with_controls({"solver": DEFAULT, **keys}, {}))
    except ValidationError as error:
        raise configuration_error(error, "the case", root, ("cases", "case")) from None


def _limits(hours: float | None, gigabytes: float | None) -> dict[str, float]:
    """Return the limits that are not None, by name."""
    limits = {"hours": hours, "gigabytes": gigabytes}
    return {name: limit for name, limit in limits.items() if limit is not None}


def _require_affordable(case: cases.CaseSection, chosen_limits: Mapping[str, float]) -> None:
    """Raise ConfigurationError if a run exceeds the limits; print the cost of a long run."""
    require(case, cases.CaseSection, CASE)
    try:
        limits = RunLimits(**chosen_limits)
    except ValidationError as error:
        raise configuration_error(error, "the limit", RunLimits) from None
    # first without snapshots: choosing their times takes long for a run of too many steps
    for problem in (case.problem, case.shown_problem):
        excess = cost.find_excess(problem(), limits.model_dump(), case.cost, case.cheap_values)
        if excess:
            raise list_faults([f"{excess[0]}: {_as_argument(excess[1])}"], "the case")
    _announce(case.cost(case.shown_problem()))


def _as_argument(text: str) -> str:
    """Return a message in which the keys of limits are replaced by the names of arguments."""
    for name in RunLimits.model_fields:
        if f"limits.{name} allows" in text:
            text = text.replace(f"limits.{name}", name)
            return text.replace("raise the limit", f"raise it by the argument {name}")
    return text


def _load(sections: Mapping, limits: Mapping[str, float]) -> Configuration:
    """Return the configuration with these sections; errors name arguments instead of keys."""
    try:
        return load({**sections, "limits": limits})
    except ConfigurationError as error:
        raise ConfigurationError(_as_argument(str(error))) from None


def _announce(estimate: cost.RunCost) -> None:
    if estimate.seconds > cost.LONG_RUN:
        print(f"the run takes {estimate}", flush=True)


NEEDLESS = (
    "initial values have imaginary parts, but the equations are those of real fields: the run"
    " solves their continuation to complex numbers"
)


def _print_remark(solver: Mapping) -> None:
    """Print a message if a run was made by another solver than expected."""
    if remark := remark_on(solver):
        print(remark, flush=True)


OF_A_RUN = ("case", "output_step", "snapshot_every", "solver")
"""Prefixes of attributes that describe the solution method, not the problem."""


def _require_run_of(case: cases.CaseSection, run: xr.Dataset) -> None:
    """Raise ConfigurationError if a run is of another case; its solver may be different."""
    problem = case.kind.of(case.shown_problem())
    expected = {"model": None} | describe_run("", problem, problem.solver)
    compared = [key for key in sorted(expected) if not key.startswith(OF_A_RUN)]
    differing = [key for key in compared if run.attrs.get(key) != expected[key]]
    if differing:
        raise ConfigurationError(
            f"the run is of another case: it differs in {', '.join(differing)}; give a run of"
            " this case, or leave it out"
        )


def require(argument: Any, kind: type[Any], description: str, *variables: str) -> None:
    """Raise ConfigurationError unless an argument is a `kind` and has all `variables`."""
    if not isinstance(argument, kind):
        text = f"expected {description}, but got {values.excerpt_of(argument)}"
        raise ConfigurationError(text)
    if absent := [name for name in variables if name not in argument]:
        text = f"expected {description}, but the dataset has no {', '.join(absent)}"
        raise ConfigurationError(text)


CASE = "a case from `Case`"
RUN = "a run from `simulate` or `read`"
SURVEY = "a survey from `survey`"
CHECKS = "checks from `check`"


def simulate(
    case: cases.CaseSection,
    name: str = "case",
    hours: float | None = None,
    gigabytes: float | None = None,
) -> xr.Dataset:
    """Integrate a case and return its trajectory.

    Coordinates: tau (the times), component (the fields), site (-M..M), snapshot (the times of
    snapshots), part ("re", "im", or for fields with second derivatives "value", "rate"). Variables,
    all dimensionless:

    linf, l2 (component, tau): the norms of a field over the chain, largest modulus and root of the
        sum of squares.
    state (part, component, site, snapshot): the fields at the snapshots; a real field x is
        run["state"].sel(part="value", component="x").
    modulus (component, site, snapshot): their moduli, in single precision.
    conserved (conserved_quantity, tau): the conserved quantities that the model defines.
    final (part, component, site): the fields at end_time.

    Attributes: all parameters, the controls and the work of the solver, and `name` as "case".

    Before the run starts, its cost is estimated from the fastest rate at the start; motion that
    decays takes less time. A run that would take more than `hours` or `gigabytes` of memory
    (default: 1 and 8) is rejected; the cost of a run of several minutes is printed.

    Raises ConfigurationError for a rejected run; IntegrationError, with the reason, if the solver
    cannot reach end_time with the requested accuracy.

    >>> from latticode import Model, abs2, lap
    >>> dnls = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + abs2(u) * u)
    >>> run = simulate(Case(model=dnls, initial={0: [1.5]}, half_width=10, end_time=5))
    >>> run["l2"].shape, run["modulus"].shape, round(float(run["l2"][0, -1]), 12)
    ((1, 201), (1, 21, 201), 1.5)
    """
    _require_affordable(case, _limits(hours, gigabytes))
    require(name, str, "a name for the dataset")
    problem = case.kind.of(case.shown_problem())
    with show_progress("simulate"):
        trajectory = simulation.simulate(problem)
    _print_remark(trajectory.solver)
    if remark := simulation.remark_on_start(problem):
        print(remark, flush=True)
    if case.has_needless_imaginary_parts:
        print(NEEDLESS, flush=True)
    variables, attributes = trajectory_contents(name, problem, trajectory)
    return timed(as_xarray(variables | final_state(problem, trajectory), attributes))


def read(path: str | Path) -> xr.Dataset:
    """Return the dataset in a file; as in `simulate`, snapshots have their times as coordinates.

    Raises DatasetError if the file is missing, damaged or edited.
    """
    return timed(netcdf.read(path))


def timed(data: xr.Dataset) -> xr.Dataset:
    """Return a dataset with times as the coordinates of snapshots: sel(snapshot=20) is at time 20.

    In files, snapshots are only numbered: there sel(snapshot=20) returns the snapshot number 20.
    """
    if "snapshot_tau" not in data or data["snapshot_tau"].dims != ("snapshot",):
        return data
    return data.assign_coords(snapshot=data["snapshot_tau"].variable)


def sweep(
    case: cases.CaseSection,
    half_widths: Iterable[int],
    windows: Iterable[tuple[float, float]] = ((10, 40), (10, 50), (10, 70)),
    name: str = "sweep",
    hours: float | None = None,
    gigabytes: float | None = None,
) -> xr.Dataset:
    """Integrate a case for many half-widths and return maxima and means of its norms.

    `windows` are pairs (start, end) of times on output steps, both ends included. Runs end with the
    last window; the end_time of the case is ignored. A parameter that is a function of the sites
    must return the same value at a site for every chain.

    Returns a dataset with l2 and linf (half_width, quantity, statistic, window), dimensionless.
    quantity: a field, or "pair" for all fields together (the root of the sum of squares in l2, the
    largest in linf). statistic: "max", or "mean" (over time, trapezoidal). window: a name such as
    "[10, 50]". Attributes are those of `simulate`.

    Raises ConfigurationError if windows are not on output steps, if initial data lie outside a
    chain, or if the sweep would take more than `hours` or `gigabytes` (default: 1 and 8);
    IntegrationError like `simulate`.

    >>> from latticode import Model, abs2, lap
    >>> dnls = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + abs2(u) * u)
    >>> peaks = sweep(Case(model=dnls, initial={0: [1.5]}), [2, 4, 8], windows=[(1, 5)])
    >>> peaks["l2"].sel(quantity="u", statistic="max", window="[1, 5]").shape
    (3,)
    """
    require(case, cases.CaseSection, CASE)
    raw_section = {"case": name, "half_widths": _listed(half_widths), "windows": _listed(windows)}
    limits = _limits(hours, gigabytes)
    settings = _load({"cases": {name: case}, "sweeps": {name: raw_section}}, limits)
    _announce(settings.cost_of_sweep(name))
    checked, problem = settings.sweeps[name], case.kind.of(settings.swept_problem(name))
    with show_progress("sweep"):
        result = sweeps.sweep(problem, checked.half_widths, checked.windows)
    return as_xarray(*sweep_contents(name, problem, checked.half_widths, checked.windows, result))


def survey(
    case: cases.CaseSection,
    axes: Mapping[str, Iterable] | None = None,
    members: Mapping | None = None,
    keep: Iterable[str | Callable] = ("max_l2",),
    window: tuple[float, float] | None = None,
    name: str = "survey",
    hours: float | None = None,
    cores: int = 1,
    together: Mapping[str, Iterable] | None = None,
    gigabytes: float | None = None,
    resume: xr.Dataset | None = None,
) -> xr.Dataset:
    """Run a case many times, with varied values or perturbed data, and keep results of each run.

    axes: {name: values}, where a name is a parameter, "half_width", "end_time" or
        "initial.SITE.FIELD"; all combinations are run.
    members: {"count": ..., "size": ..., "seed": ...}: an ensemble of `count` copies of each run,
        with random relative perturbations of size `size` of the initial data.
    keep: results, by name or as functions.
        - "max_l2", "max_linf", "mean_l2", "mean_linf": norms of each field in the time `window`;
        - "final_l2", "final_linf": norms of each field at end_time;
        - "exponent": a, if the sum of squares of all fields grows like time**a in the window;
        - "divergence": the time at which a run by another method differs visibly;
        - a function (problem, trajectory) that returns a number or an array, stored under the name
          of the function. A trajectory has tau, l2, linf and final; if the case has a snapshot_step
          or times, also snapshot_tau and state (part, component, site, snapshot).
    window: a pair (start, end) of times, both included. Default: the whole run.
    cores: the number of simultaneous runs; results do not depend on it.
    together: {name: values}, all of the same length, which vary together along one more axis.
    resume: the dataset that this survey returned when Ctrl-C interrupted it. Its runs are reused.

    Returns a dataset over the axes, "member", and "component" for results of each field. Failed
    runs have NaN; "failure" has the reasons, and the attribute failed_runs the count, which is also
    printed. "remark" has the reason if a run is not by the solver of the case, "unfinished" if it
    was not executed before Ctrl-C.

    Raises ConfigurationError for invalid arguments, or if the survey would take more than `hours`
    or `gigabytes` (default: 1 and 8).

    >>> from latticode import Model, abs2, lap
    >>> dnls = Model(fields="u", parameters={"c": 1}, i_dt=lambda p, u: p.c * lap(u) + abs2(u) * u)
    >>> case = Case(model=dnls, half_width=5, initial={0: [1.5]}, end_time=5)
    >>> found = survey(case, {"c": [0.5, 1, 2]}, keep=["final_l2"])
    >>> found["final_l2"].dims, found["final_l2"].round(6).values.ravel().tolist()
    (('c', 'component'), [1.5, 1.5, 1.5])
    """
    require(case, cases.CaseSection, CASE)
    if not isinstance(cores, Integral) or isinstance(cores, bool) or cores < 1:
        text = f"cores: is {values.excerpt_of(cores)}; give a whole number, at least 1"
        raise list_faults([text], "the survey")
    quantities = [keep] if isinstance(keep, str) or callable(keep) else list(keep)
    if not quantities:
        raise list_faults(["keep: is empty; give a result, such as 'max_l2'"], "the survey")
    for key, argument in (("axes", axes), ("together", together)):
        if not isinstance(argument, Mapping | None):
            text = f"{key}: is {values.excerpt_of(argument)}, not a mapping of names to values"
            raise list_faults([text], "the survey")
    raw_section = {
        "case": name,
        "axes": {axis: _listed(values) for axis, values in (axes or {}).items()},
        "together": {axis: _listed(values) for axis, values in (together or {}).items()},
        "members": dict(members) if isinstance(members, Mapping) else members,
        "keep": [quantity for quantity in quantities if not callable(quantity)] or ["max_l2"],
        "window": _listed(window),
    }
    limits = _limits(hours, gigabytes)
    settings = _load({"cases": {name: case}, "surveys": {name: raw_section}}, limits)
    _announce(settings.cost_of_survey(name))
    plan = settings.surveys[name].plan._replace(
        keep=tuple(quantities), by_half_width=settings.values_by_half_width(name)
    )
    try:
        names_of(plan)
    except ValueError as error:
        raise list_faults([str(error)], "the survey") from None
    plain_values = settings.surveyed_problem(name)
    if any(map(callable, quantities)):  # functions may read the snapshots of the case
        plain_values = case.problem()
    problem = case.kind.of(plain_values)
    retained = {} if resume is None else _runs_to_resume(resume, name, problem, plan)
    run = partial(run_until_interrupted, cores=cores, retained=retained)
    results = survey_runs.run_survey(problem, plan, run)
    return as_xarray(*survey_contents(name, problem, plan, results))


def _runs_to_resume(resume: xr.Dataset, name: str, problem: Problem, plan: Survey) -> Retained:
    """Return the finished runs of an interrupted survey.

    Raises ConfigurationError if it is not this survey.
    """
    names = names_of(plan)
    require(resume, xr.Dataset, "the interrupted survey from `survey`", *names)
    expected = as_xarray(*survey_contents(name, problem, plan, {}))
    differing = [
        key
        for key in expected.variables
        if key not in resume.variables or not expected[key].equals(resume[key])
    ]
    ignored = {"case", "title", *COUNTS.values()}
    differing += [
        key
        for key, value in expected.attrs.items()
        if key not in ignored and not np.array_equal(value, resume.attrs.get(key, ""))
    ]
    if differing:
        raise ConfigurationError(
            f"resume: is another survey: it differs in {', '.join(map(str, differing))}; give"
            " the dataset that this survey returned, or leave it out"
        )
    return runs_in(resume, names, plan.shape)


def _listed(argument: Any) -> Any:
    """Return an iterable, such as a range, as a list; strings, dicts and others unchanged."""
    return (
        [_listed(item) for item in argument]
        if isinstance(argument, Iterable) and not isinstance(argument, str | dict)
        else argument
    )


def check(
    case: cases.CaseSection,
    run: xr.Dataset | None = None,
    checks: Callable = check_run,
    *variables: str,
) -> xr.Dataset:
    """Return checks of a run: its error, whether its motion is chaotic, and a localised state.

    `run` is from `simulate`; by default the case is integrated here. `checks` is a function
    (problem, run) that returns a dataset, by default the one described in `latticode.checks`. It
    reads the norms and the `variables` of the run.

    >>> from latticode import Model, abs2, lap
    >>> dnls = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + abs2(u) * u)
    >>> found = check(Case(model=dnls, initial={0: [0.5]}, half_width=10, end_time=5))
    >>> float(found["largest_difference"]) < 1e-11, int(found["chaotic"])
    (True, 0)
    """
    require(case, cases.CaseSection, CASE)
    run = simulate(case) if run is None else run
    require(run, xr.Dataset, RUN, "linf", "l2", "tau", *variables)
    _require_run_of(case, run)
    with show_progress("check"):
        measured = checks(case.kind.of(case.shown_problem()), run)
    if warning := measured.attrs.get(UNSTABLE_REST):
        print(warning)
    return measured


def lyapunov(case: cases.CaseSection, count: int = 1, hours: float | None = None) -> xr.Dataset:
    """Return the `count` largest Lyapunov exponents of the motion of a case, with their errors.

    Tangent vectors are integrated with the solution by dop853, and made orthonormal again at short
    intervals. Rates are from the second half of the run; the first half is the transient. Returns
    exponent and exponent_error (number,), largest first, per unit of tau, and log_growth (number,
    growth_tau). The sum of all exponents is the mean divergence of the equations.

    Raises ConfigurationError if `count` exceeds the dimension of phase space, or if the work would
    take more than `hours` (default: 1); IntegrationError like `simulate`.

    >>> from latticode import Model
    >>> def dt(p, x, y, z):
    ...     return 10 * (y - x), x * (28 - z) - y, x * y - 8 / 3 * z
    >>> lorenz = Model(fields=("x", "y", "z"), parameters={}, dt=dt)
    >>> case = Case(model=lorenz, sites=1, initial={0: [1, 1, 20]}, end_time=200)
    >>> found = lyapunov(case, count=3)
    >>> round(float(found["exponent"].sum()), 4)  # -10 - 1 - 8 / 3
    -13.6667
    """
    require(case, cases.CaseSection, CASE)
    problem = case.kind.of(case.problem())
    most = count_directions(problem)
    if not isinstance(count, Integral) or isinstance(count, bool) or not 1 <= count <= most:
        text = f"count: is {values.excerpt_of(count)}; give a whole number from 1 to {most}"
        raise list_faults([text], "the spectrum")
    cost_of_run = case.cost(case.problem(solver=cost.OF_TANGENTS))
    estimate = cost.RunCost((1 + count) * cost_of_run.seconds, (1 + count) * cost_of_run.memory)
    limits = RunLimits(**_limits(hours, None)).model_dump()
    if estimate.excess(limits) > 1.0:
        raise list_faults(
            [_as_argument(f"count: {cost.name_excess(estimate, limits)}")], "the spectrum"
        )
    _announce(estimate)
    with show_progress("lyapunov"):
        return measure_exponents(problem, int(count))


def section(
    case: cases.CaseSection, when: Callable, direction: str = "up", site: int | None = None
) -> xr.Dataset:
    """Return the times and states at which a function of the fields crosses zero in a run.

    when: a function (p, *fields), written like equations, whose zeros are the crossings; it may
        take the velocities too if the model has d2_dt2.
    direction: "up" (from below zero), "down" or "both".
    site: the site where the function is evaluated. Default: 0.

    Returns crossing_tau (crossing,) and crossing_state (part, component, site, crossing). A
    crossing is detected if the sign differs between two outputs of the case. It is located by runs
    from the first of these outputs, with the accuracy of the solver.

    Raises ModelError if `when` cannot be traced; ConfigurationError for an unknown direction or
    site; IntegrationError like `simulate`.

    >>> from latticode import Model
    >>> swing = Model(fields="x", parameters={}, d2_dt2=lambda p, x: -x)
    >>> case = Case(model=swing, sites=1, initial={0: [1]}, end_time=10)
    >>> found = section(case, when=lambda p, x: x, direction="up")
    >>> abs(float(found["crossing_tau"][0]) - 1.5 * 3.141592653589793) < 1e-12
    True
    """
    require(case, cases.CaseSection, CASE)
    site = 0 if site is None else site
    faults = []
    if direction not in DIRECTIONS:
        known = ", ".join(DIRECTIONS)
        faults.append(f"direction: is {values.excerpt_of(direction)}; give one of {known}")
    if site not in case.chain:
        ends = f"{case.chain[0]} to {case.chain[-1]}"
        faults.append(f"site: is {values.excerpt_of(site)}; the sites run from {ends}")
    if not isinstance(case.model, Model):
        faults.append("case: its equations are not a Model; give a case of a Model")
    if not callable(when):
        faults.append("when: is not a function; give one such as lambda p, x: x - 1")
    if faults:
        raise list_faults(faults, "the section")
    problem = case.kind.of(case.problem())
    with show_progress("section"):
        return section_at(problem, case.model.trace(when), direction, site)


def draw_norms(run: xr.Dataset, checks: xr.Dataset | None = None) -> "Figure":
    """Draw the norms of all fields against time: l-infinity left, l2 right.

    `run` is from `simulate` or `read`. With `checks` from `check`, if the second run differs
    visibly, it is drawn below the first, and a line marks the divergence time.
    """
    from .drawing import runs  # imported here, because matplotlib takes half a second

    require_norms(run, checks)
    return runs.draw_norms(runs.gather_norms(run, checks))


def require_norms(run: xr.Dataset, checks: xr.Dataset | None) -> None:
    """Raise ConfigurationError unless `run` has norms and `checks` is from `check`."""
    require(run, xr.Dataset, RUN, "linf", "l2", "tau")
    if checks is not None:
        require(checks, xr.Dataset, CHECKS, "divergence_time")


def draw_spacetime(run: xr.Dataset) -> "Figure":
    """Draw all fields over time and sites: the values of real fields, the moduli of others.

    The run must have snapshots. Values need the `state`; without it, moduli are drawn.
    """
    from .drawing import runs  # imported here, because matplotlib takes half a second

    require(run, xr.Dataset, SNAPSHOTS, "modulus")
    return runs.draw_spacetime(runs.gather_spacetime(run))


SNAPSHOTS = f"{RUN}, with snapshots (of a case with keep='moduli' or 'state')"


def draw_breather(checks: xr.Dataset) -> "Figure":
    """Draw the localised state in the dataset of `check`, and its stability.

    Left: the moduli of all fields over sites. Right: its Floquet multipliers with the unit circle,
    or the exponents of perturbations if the state is steady. If there is no localised state, the
    figure has the reason.
    """
    from .drawing import runs  # imported here, because matplotlib takes half a second

    require(checks, xr.Dataset, CHECKS, "divergence_time")
    return runs.draw_breather(runs.gather_breather(checks))


def draw_survey(survey: xr.Dataset) -> "Figure":
    """Draw the results of a survey from `survey`: curves over one axis, or maps over two.

    For further axes, the first value is shown. For members, the mean and its 95 % confidence
    interval are shown.
    """
    from .drawing import surveys  # imported here, because matplotlib takes half a second

    require(survey, xr.Dataset, SURVEY, "component")
    if "failed_runs" not in survey.attrs:
        raise ConfigurationError(f"expected {SURVEY}, but got a different dataset")
    return surveys.draw_survey(surveys.gather_survey(survey))


def draw_sweep(
    sweep: xr.Dataset, max_window: str | None = None, mean_window: str | None = None
) -> "Figure":
    """Draw the norms of all fields together against the half-width M: l-infinity left, l2 right.

    Filled dots are maxima over `max_window`, hollow dots means over `mean_window`. Windows have the
    names in the dataset; the default is the first one.
    """
    from .drawing import runs  # imported here, because matplotlib takes half a second

    return runs.draw_sweep(gathered_sweep(sweep, max_window, mean_window))


def gathered_sweep(
    sweep: xr.Dataset, max_window: str | None, mean_window: str | None
) -> xr.Dataset:
    """Return the data that `draw_sweep` draws; raises ConfigurationError if it is not a sweep."""
    from .drawing import runs

    require(sweep, xr.Dataset, "a sweep from `sweep`", "linf", "l2", "window")
    known = [str(window) for window in sweep["window"].values]
    for window in (max_window, mean_window):
        if window is not None and window not in known:
            raise ConfigurationError(
                f"there is no window {values.excerpt_of(window)}; give one of {', '.join(known)}"
            )
    return runs.gather_sweep(sweep, max_window, mean_window)
