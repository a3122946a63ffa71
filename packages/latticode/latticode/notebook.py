"""The library for notebooks: cases of a model, their runs and sweeps as datasets, checks, figures.

Equations are taken as dimensionless. Datasets are xarray's, each variable with a long_name and
units. Figures are matplotlib's: a notebook shows the one that a cell ends with, and saves it by
`figure.savefig("mine.pdf")`.

What is raised: ModelError, where equations cannot be traced; ConfigurationError, with every fault
of what was given; IntegrationError, where a run cannot reach its end with the digits that were
asked for; DatasetError, where a file cannot be read or written.
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
from latticode.configuration.messages import in_words
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
    """One initial-value problem of a model, checked when it is made.

    Keys and defaults are those of a case in YAML:

    model: a Model, or the path of its file.
    parameters: {name: a number, one for each site, or a function of the sites}; others have the
        model's own values.
    initial: {site: a value for each field} in complex numbers, at rest elsewhere; or an array of a
        number for each site, (field, site) for several fields; or a function of the array of sites
        that returns one; or a run, which goes on at its end; or a DataArray over site,
        such as run["state"].sel(snapshot=20); or a file of one of these (.nc, .npy, or .py with an
        `initial`). Of a field with d2_dt2 the imaginary part is the rate.
    start_time: the time at the start, of a drive p.t too. 0, or the end of the run in `initial`.
    half_width: M; the chain has the 2M + 1 sites -M..M. 30.
    sites: N, in place of half_width; the chain has the N sites 0..N-1.
    boundary: "dirichlet" (zero beyond the ends), "free" (a mirror beyond the last site: to second
        neighbours it adds a bond between the last two sites), "periodic" or "antiperiodic".
    end_time, output_step: observables are kept at every step. 50 and 0.025.
    snapshot_step: how often the fields on all sites are kept, whole output steps. They divide the
        run. Left out, 200 snapshots or more are spread over it.
    times: in place of it, a list of the times at which they are kept.
    keep: "state" (moduli and both parts of each field in double precision), "moduli" (in single
        precision, a sixth of the memory) or "norms" (no snapshots).
    solver: "taylor" (1e-14), "dop853", "ode45", "crank_nicolson", "kahan_li" or "auto", or a dict
        with the controls, such as {"name": "auto", "error": 1e-9}.

    Raises ConfigurationError, with every fault in words.

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
        """Return the case with other values under `keys`, checked anew."""
        values = self.model_dump()
        if end_of_run(keys.get("initial")) is not None:
            del values["start_time"]  # that of the run
        for key, replaced in (("sites", "half_width"), ("half_width", "sites")):
            if keys.get(key) is not None and replaced in values:  # one length replaces the other
                values[replaced] = None
        return type(self)(**{**values, **keys})


show_keys(Case, ("model", "parameters", "initial"))


def validate_case(
    initialise: Callable, keys: Mapping, root: type[Configuration] = Configuration
) -> None:
    """Make a case of its keys, which belong to a configuration of the type `root`.

    Raises ConfigurationError with all that is wrong with them.
    """
    try:
        initialise(**with_controls({"solver": DEFAULT, **keys}, {}))
    except ValidationError as error:
        raise in_words(error, "the case", root, ("cases", "case")) from None


def _limits(hours: float | None, gigabytes: float | None) -> dict[str, float]:
    """Return the limits that are given, by name."""
    limits = {"hours": hours, "gigabytes": gigabytes}
    return {name: limit for name, limit in limits.items() if limit is not None}


def _require_affordable(case: cases.CaseSection, chosen_limits: Mapping[str, float]) -> None:
    """Raise ConfigurationError if a run takes more than it may.

    A run of minutes says what it will take.
    """
    require(case, cases.CaseSection, CASE)
    try:
        limits = RunLimits(**chosen_limits)
    except ValidationError as error:
        raise in_words(error, "the limit", RunLimits) from None
    # The second problem chooses the times of its snapshots, which needs a run that is not too long.
    for problem in (case.problem, case.shown_problem):
        excess = cost.find_excess(problem(), limits.model_dump(), case.cost, case.ordinary)
        if excess:
            raise list_faults([f"{excess[0]}: {_as_argument(excess[1])}"], "the case")
    _announce(case.cost(case.shown_problem()))


def _as_argument(text: str) -> str:
    """Return what a message says of a limit with the argument that raises it."""
    for name in RunLimits.model_fields:
        if f"limits.{name} allows" in text:
            text = text.replace(f"limits.{name}", name)
            return text.replace("raise the limit", f"raise it by the argument {name}")
    return text


def _load(sections: Mapping, limits: Mapping[str, float]) -> Configuration:
    """Return a configuration of a notebook's case; errors name arguments in place of keys."""
    try:
        return load({**sections, "limits": limits})
    except ConfigurationError as error:
        raise ConfigurationError(_as_argument(str(error))) from None


def _announce(estimate: cost.RunCost) -> None:
    if estimate.seconds > cost.WORTH_SAYING:
        print(f"the run takes {estimate}", flush=True)


NEEDLESS = (
    "initial values have imaginary parts, and the equations are those of real fields: the run is of"
    " their continuation to complex numbers"
)


def _print_remark(solver: Mapping) -> None:
    """Print why a run is by another solver than was expected, if it is."""
    if remark := remark_on(solver):
        print(remark, flush=True)


OF_A_RUN = ("case", "output_step", "snapshot_every", "solver")
"""How attributes start that say how a case was run, and not of which problem the run is."""


def _require_run_of(case: cases.CaseSection, run: xr.Dataset) -> None:
    """Raise ConfigurationError unless a run was made of a case, by whatever solver."""
    problem = case.kind.of(case.shown_problem())
    made_of = {"model": None} | describe_run("", problem, problem.solver)
    compared = [key for key in sorted(made_of) if not key.startswith(OF_A_RUN)]
    differing = [key for key in compared if run.attrs.get(key) != made_of[key]]
    if differing:
        raise ConfigurationError(
            f"the run is of another case: they differ in {', '.join(differing)}; give the run of"
            " this case, or leave it out"
        )


def require(argument: Any, kind: type[Any], description: str, *variables: str) -> None:
    """Raise ConfigurationError unless an argument is of a kind, and a dataset has `variables`."""
    if not isinstance(argument, kind):
        raise ConfigurationError(f"this takes {description}, and not {values.excerpt_of(argument)}")
    absent = [name for name in variables if name not in argument]
    if absent:
        raise ConfigurationError(
            f"this takes {description}; the dataset has no {', '.join(absent)}"
        )


CASE = "a case, as `Case` makes it"
RUN = "a run, as `simulate` and `read` return it"
SURVEY = "a survey, as `survey` returns it"


def simulate(
    case: cases.CaseSection,
    name: str = "case",
    hours: float | None = None,
    gigabytes: float | None = None,
) -> xr.Dataset:
    """Integrate a case and return its trajectory.

    Coordinates: tau (time,), component (the fields), site (-M..M), part ("re", "im", or "value",
    "rate" of fields with second derivatives). Variables, all without units:

    linf, l2 (component, tau): the largest modulus of a field on the chain, and the root of the sum
        of its squares.
    state (part, component, site, snapshot): the fields at the times `snapshot`, as snapshot_tau has
        them; x_n(t) of a real field x is run["state"].sel(part="value", component="x").
    modulus (component, site, snapshot): their moduli, in single precision.
    conserved (conserved_quantity, tau): what the model conserves, if it says so.
    final (part, component, site): the fields at end_time.

    Attributes: every parameter, the solver's controls and its work, `name` as "case".

    A run that would take more than `hours` or `gigabytes` of memory (1 and 8 if they are left out)
    is refused before it starts; one of some minutes says first what it takes. The time follows from
    the fastest rate at the start: motion that decays takes less.

    Raises ConfigurationError for such a run; IntegrationError, with the reason, where the solver
    cannot reach end_time with the digits that were asked for.

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
    if anew := simulation.remark_on_start(problem):
        print(anew, flush=True)
    if case.has_needless_imaginary_parts:
        print(NEEDLESS, flush=True)
    variables, attributes = trajectory_contents(name, problem, trajectory)
    return timed(as_xarray(variables | final_state(problem, trajectory), attributes))


def read(path: str | Path) -> xr.Dataset:
    """Return the dataset at `path` in memory, its snapshots by their times as in `simulate`.

    Raises DatasetError where it is missing, damaged, or not what was written.
    """
    return timed(netcdf.read(path))


def timed(data: xr.Dataset) -> xr.Dataset:
    """Return a dataset whose snapshots, if it has any, are chosen by their times: sel(snapshot=20).

    In files they are numbered, and `sel` would take a time for a number in silence.
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
    """Integrate a case on chains of many half-widths; return maxima and means of its norms.

    `windows` are (start, end) of time, both included, on output steps; the case is run to the end
    of the last one, whatever its end_time. A parameter that is a function of the sites has the same
    values at the sites of every chain.

    Returns a dataset with l2 and linf (half_width, quantity, statistic, window), without units:
    quantity is a field or "pair", all of them together (the root of the sum of squares in l2, the
    largest in linf); statistic "max" or "mean" (over time, trapezoidal); windows are named
    "[10, 50]". Attributes as in `simulate`.

    Raises ConfigurationError for windows off the grid, initial data outside a chain, or a sweep
    that would take more than `hours` or `gigabytes` (1 and 8 if they are left out);
    IntegrationError as `simulate`.

    >>> from latticode import Model, abs2, lap
    >>> dnls = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + abs2(u) * u)
    >>> peaks = sweep(Case(model=dnls, initial={0: [1.5]}), [2, 4, 8], windows=[(1, 5)])
    >>> peaks["l2"].sel(quantity="u", statistic="max", window="[1, 5]").shape
    (3,)
    """
    require(case, cases.CaseSection, CASE)
    asked = {"case": name, "half_widths": _listed(half_widths), "windows": _listed(windows)}
    limits = _limits(hours, gigabytes)
    settings = _load({"cases": {name: case}, "sweeps": {name: asked}}, limits)
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
    """Make many runs of a case and keep a few numbers of each.

    axes: {a parameter, "half_width", "end_time" or "initial.SITE.FIELD": values}; all are combined.
    members: {"count": ..., "size": ..., "seed": ...}: copies of each run whose initial data differ
        by a random relative change of that size.
    keep: "max_l2", "max_linf", "mean_l2", "mean_linf" over the `window` of time, "final_l2",
        "final_linf" of each field; "exponent" of time with which the power grows in the window;
        "divergence", the time at which a run by another method differs; or a function of the
        problem of a run and its trajectory, kept under its own name: a number or an array. The
        trajectory has tau, l2, linf, final, and where the case has a snapshot_step or times also
        snapshot_tau and state (part, component, site, snapshot).
    cores: how many runs are made side by side; it changes no bit.
    together: what varies along one more axis, all names from one value to the next.
    resume: what the same survey returned when Ctrl-C interrupted it: the runs that it has are not
        made again.

    Returns a dataset whose dimensions are the axes, "member", and "component" for what each field
    has. A run that cannot be made to its end has NaN, and a line says how many there are: they are
    the attribute failed_runs, and "failure" has the reason of each. So "remark" says which runs are
    not by the solver of the case, and why, and "unfinished" which were not made before Ctrl-C.

    Raises ConfigurationError for what has no meaning, or would take more than `hours` or
    `gigabytes` (1 and 8 if they are left out).

    >>> from latticode import Model, abs2, lap
    >>> dnls = Model(fields="u", parameters={"c": 1}, i_dt=lambda p, u: p.c * lap(u) + abs2(u) * u)
    >>> case = Case(model=dnls, half_width=5, initial={0: [1.5]}, end_time=5)
    >>> found = survey(case, {"c": [0.5, 1, 2]}, keep=["final_l2"])
    >>> found["final_l2"].dims, found["final_l2"].round(6).values.ravel().tolist()
    (('c', 'component'), [1.5, 1.5, 1.5])
    """
    require(case, cases.CaseSection, CASE)
    if not isinstance(cores, Integral) or isinstance(cores, bool) or cores < 1:
        text = f"cores: is {values.excerpt_of(cores)}; give a whole number of 1 or more"
        raise list_faults([text], "the survey")
    quantities = [keep] if isinstance(keep, str) or callable(keep) else list(keep)
    if not quantities:
        raise list_faults(["keep: is empty; give what is kept of each run"], "the survey")
    for key, argument in (("axes", axes), ("together", together)):
        if not isinstance(argument, Mapping | None):
            text = f"{key}: is {values.excerpt_of(argument)}, not a mapping of names to values"
            raise list_faults([text], "the survey")
    asked = {
        "case": name,
        "axes": {axis: _listed(values) for axis, values in (axes or {}).items()},
        "together": {axis: _listed(values) for axis, values in (together or {}).items()},
        "members": dict(members) if isinstance(members, Mapping) else members,
        "keep": [quantity for quantity in quantities if not callable(quantity)] or ["max_l2"],
        "window": _listed(window),
    }
    limits = _limits(hours, gigabytes)
    settings = _load({"cases": {name: case}, "surveys": {name: asked}}, limits)
    _announce(settings.cost_of_survey(name))
    plan = settings.surveys[name].plan._replace(
        keep=tuple(quantities), by_half_width=settings.values_by_half_width(name)
    )
    try:
        names_of(plan)
    except ValueError as error:
        raise list_faults([str(error)], "the survey") from None
    plain_values = settings.surveyed_problem(name)
    if any(map(callable, quantities)):  # which may read the snapshots that the case asks for
        plain_values = case.problem()
    problem = case.kind.of(plain_values)
    retained = {} if resume is None else _runs_to_resume(resume, name, problem, plan)
    run = partial(run_until_interrupted, cores=cores, retained=retained)
    results = survey_runs.run_survey(problem, plan, run)
    return as_xarray(*survey_contents(name, problem, plan, results))


def _runs_to_resume(resume: xr.Dataset, name: str, problem: Problem, plan: Survey) -> Retained:
    """Return the runs that an interrupted survey has; raise ConfigurationError for another one."""
    names = names_of(plan)
    require(resume, xr.Dataset, "the survey to resume, as `survey` returned it", *names)
    expected = as_xarray(*survey_contents(name, problem, plan, {}))
    differ = [key for key in expected.variables if not expected[key].equals(resume.get(key))]
    known = {"case", "title", *COUNTS.values()}
    differ += [
        key
        for key, value in expected.attrs.items()
        if key not in known and not np.array_equal(value, resume.attrs.get(key, ""))
    ]
    if differ:
        raise ConfigurationError(
            f"resume: it is another survey: they differ in {', '.join(map(str, differ))}; give"
            " what this one returned, or leave it out"
        )
    return runs_in(resume, names, plan.shape)


def _listed(argument: Any) -> Any:
    """Return a list of what can be iterated, such as a range, and all else as it is."""
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
    """Measure how far a run of a case can be trusted, and whether its motion is chaotic.

    `run` is what `simulate` made of the case; if it is left out, the case is integrated here. Of
    the problem and of the run, which must have `variables`, `checks` makes a dataset of numbers,
    each with a long_name and units: see `latticode.checks`.

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
    if sentence := measured.attrs.get(UNSTABLE_REST):
        print(sentence)
    return measured


def lyapunov(case: cases.CaseSection, count: int = 1, hours: float | None = None) -> xr.Dataset:
    """Measure the `count` largest Lyapunov exponents of the motion of a case, with their errors.

    Tangent vectors are carried along with the solution by dop853 and made orthonormal again and
    again; rates are those of the second half of the run, so that the first half is the transient.
    Returns exponent and exponent_error (number,), largest first, per unit of tau, and log_growth
    (number, growth_tau). The sum of all exponents is the mean divergence of the equations.

    Raises ConfigurationError where there are fewer directions than exponents, or the work would
    take more than `hours` (1 if it is left out); IntegrationError as `simulate`.

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
            [_as_argument(f"count: {cost.refusal(estimate, limits)}")], "the spectrum"
        )
    _announce(estimate)
    with show_progress("lyapunov"):
        return measure_exponents(problem, int(count))


def section(
    case: cases.CaseSection, when: Callable, direction: str = "up", site: int | None = None
) -> xr.Dataset:
    """Find the times and states at which a function of the fields crosses zero in a run.

    when: a function (p, *fields), as the equations are, of what shall cross zero; of fields with
        d2_dt2 it may take velocities too.
    direction: "up" (from below zero), "down" or "both".
    site: where the function is taken; the first of the sites 0..N-1, or 0.

    Returns crossing_tau (crossing,) and crossing_state (part, component, site, crossing). A
    crossing is seen where the sign changes from one output of the case to the next, and located by
    runs from the output before it, to the last digits of the solver.

    Raises ModelError where `when` cannot be traced; ConfigurationError for no direction or site;
    IntegrationError as `simulate`.

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
        faults.append("case: has equations that are no Model; give a case of a Model")
    if not callable(when):
        faults.append("when: is no function; give one such as lambda p, x: x - 1")
    if faults:
        raise list_faults(faults, "the section")
    problem = case.kind.of(case.problem())
    with show_progress("section"):
        return section_at(problem, case.model.trace(when), direction, site)


def draw_norms(run: xr.Dataset, checks: xr.Dataset | None = None) -> "Figure":
    """Draw the norms of all fields against time: l-infinity left, l2 right.

    `run` is a trajectory as `simulate` or `read` return it. With the `checks` that `check` made of
    it, their second run is drawn below it where the two differ, and a mark shows from when on.
    """
    from .drawing import runs  # here: importing matplotlib takes half a second

    require_norms(run, checks)
    return runs.draw_norms(runs.gather_norms(run, checks))


def require_norms(run: xr.Dataset, checks: xr.Dataset | None) -> None:
    """Raise ConfigurationError unless a run has norms, and its checks a second run."""
    require(run, xr.Dataset, RUN, "linf", "l2", "tau")
    if checks is not None:
        require(checks, xr.Dataset, "checks, as `check` returns them", "divergence_time")


def draw_spacetime(run: xr.Dataset) -> "Figure":
    """Draw all fields over time and sites: moduli, or the values of real fields with their signs.

    The run must keep snapshots, and for signs the `state`.
    """
    from .drawing import runs  # here: importing matplotlib takes half a second

    require(run, xr.Dataset, SNAPSHOTS, "modulus")
    return runs.draw_spacetime(runs.gather_spacetime(run))


SNAPSHOTS = f"{RUN}, with snapshots (its case keeps moduli or the state)"


def draw_breather(checks: xr.Dataset) -> "Figure":
    """Draw the localised state that `check` found, and its stability.

    Left are the moduli of all fields over sites; right its Floquet multipliers beside the unit
    circle, or the exponents of perturbations where the state is steady.
    Where there is no such state, the figure says why.
    """
    from .drawing import runs  # here: importing matplotlib takes half a second

    require(checks, xr.Dataset, "checks, as `check` returns them", "divergence_time")
    return runs.draw_breather(runs.gather_breather(checks))


def draw_survey(survey: xr.Dataset) -> "Figure":
    """Draw what a survey kept, as `survey` returns it: against one axis, or over two as maps.

    Of further axes the first value is shown, and of members the mean with its 95 % limits.
    """
    from .drawing import surveys  # here: importing matplotlib takes half a second

    require(survey, xr.Dataset, SURVEY, "component")
    if "failed_runs" not in survey.attrs:
        raise ConfigurationError(f"this takes {SURVEY}; the dataset is of something else")
    return surveys.draw_survey(surveys.gather_survey(survey))


def draw_sweep(
    sweep: xr.Dataset, max_window: str | None = None, mean_window: str | None = None
) -> "Figure":
    """Draw the norms of all fields together against the half-width M: l-infinity left, l2 right.

    Filled dots are the maximum over `max_window`, hollow dots the mean over `mean_window`. Windows
    are named as in the dataset; where one is left out, the first is taken.
    """
    from .drawing import runs  # here: importing matplotlib takes half a second

    return runs.draw_sweep(gathered_sweep(sweep, max_window, mean_window))


def gathered_sweep(
    sweep: xr.Dataset, max_window: str | None, mean_window: str | None
) -> xr.Dataset:
    """Return what `draw_sweep` draws, or raise ConfigurationError for what is no sweep."""
    from .drawing import runs

    require(sweep, xr.Dataset, "a sweep, as `sweep` returns it", "linf", "l2", "window")
    known = [str(window) for window in sweep["window"].values]
    for window in (max_window, mean_window):
        if window is not None and window not in known:
            raise ConfigurationError(
                f"there is no window {values.excerpt_of(window)}; known are {', '.join(known)}"
            )
    return runs.gather_sweep(sweep, max_window, mean_window)
