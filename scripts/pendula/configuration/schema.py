"""The configuration: every key, its default (the paper's value) and what it may be.

First come the kinds of values, then the solvers' controls, cases, sweeps, and the whole. Problems
are returned as plain values, which `pendula.problem.Problem.of` reads, since Snakemake compares the
parameters of its jobs from run to run.
"""

import difflib
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, model_validator
from pydantic_core import PydanticCustomError

Complex = Annotated[complex, BeforeValidator(lambda value: _as_complex(value))]
Number = Annotated[
    float, BeforeValidator(lambda value: _no_bool(value)), Field(allow_inf_nan=False)
]
Positive = Annotated[Number, Field(gt=0)]
Whole = Annotated[int, BeforeValidator(lambda value: _no_bool(value))]
Name = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_-]*$")]


def _no_bool(value: Any) -> Any:
    if isinstance(value, bool):
        raise PydanticCustomError("number", "is {value}, not a number", {"value": str(value)})
    return value


def _as_complex(value: Any) -> complex:
    """Read 2, 2.0 or "-0.3+0.4j" as Python writes complex numbers; refuse what is not finite."""
    try:
        number = complex(value.replace(" ", "") if isinstance(value, str) else _no_bool(value))
    except (TypeError, ValueError):
        raise PydanticCustomError(
            "complex",
            'is {value}, not a complex number such as "-0.3+0.4j"',
            {"value": repr(value)},
        ) from None
    if not abs(number) < float("inf"):
        raise PydanticCustomError("finite", "is {value}, which is not finite", {"value": value})
    return number


class Model(BaseModel):
    """A mapping of the configuration: unknown keys are faults."""

    model_config = ConfigDict(extra="forbid", frozen=True, validate_default=True)


class Ode45(Model):
    """MATLAB's ode45, at the paper's tolerances."""

    name: Literal["ode45"] = "ode45"
    rtol: Annotated[Positive, Field(ge=1e-13, lt=1)] = 1e-7
    atol: Positive = 1e-9


class Dop853(Model):
    """The explicit Runge-Kutta method of order eight, for accuracy."""

    name: Literal["dop853"] = "dop853"
    rtol: Annotated[Positive, Field(ge=1e-15, lt=1)] = 1e-13
    atol: Positive = 1e-13


class Taylor(Model):
    """The Taylor method, the default: at small errors the fastest on the paper's chains."""

    name: Literal["taylor"] = "taylor"
    rtol: Annotated[Positive, Field(ge=1e-16, lt=1)] = 1e-14
    atol: Positive = 1e-14


class Auto(Model):
    """The default solver, held to an error of the norms relative to their largest values."""

    name: Literal["auto"] = "auto"
    error: Annotated[Positive, Field(ge=1e-13, lt=1)] = 1e-9


class Iterated(Model):
    """Controls of an implicit scheme that is solved by fixed-point iteration."""

    step: Positive = 0.0025
    tolerance: Annotated[Positive, Field(ge=1e-14, lt=1)] = 1e-13
    iterations: Annotated[Whole, Field(ge=2, le=1000)] = 50


class CrankNicolson(Iterated):
    """The trapezoidal rule, the paper's second solver."""

    name: Literal["crank_nicolson"] = "crank_nicolson"


class DelfourFortinPayre(Iterated):
    """The variant of Crank-Nicolson that conserves the energy."""

    name: Literal["delfour_fortin_payre"] = "delfour_fortin_payre"


class Solvers(Model):
    """The controls of each solver where a case names it without giving its own."""

    ode45: Ode45 = Ode45()
    crank_nicolson: CrankNicolson = CrankNicolson()
    delfour_fortin_payre: DelfourFortinPayre = DelfourFortinPayre()
    dop853: Dop853 = Dop853()
    taylor: Taylor = Taylor()
    auto: Auto = Auto()


Solver = Annotated[
    Ode45 | CrankNicolson | DelfourFortinPayre | Dop853 | Taylor | Auto,
    Field(discriminator="name"),
]

Window = tuple[Number, Number]

FEWEST = 200
"""A smooth picture needs so many snapshots; fewer than twice as many are kept."""
MOST_NUMBERS = 20_000_000
"""At most so many moduli are kept in memory: very long chains have fewer snapshots."""


def choose_every(outputs: int, sites: int) -> int:
    """Return how many output steps lie between snapshots, for a run of `outputs` steps."""
    wanted = max(1, min(FEWEST, MOST_NUMBERS // (2 * sites)))
    return max(1, outputs // wanted)


def _on_grid(time: float, step: float) -> bool:
    count = round(time / step)
    return abs(time - count * step) <= 1e-9 * time


class Case(Model):
    """One initial-value problem of equations (4), and the solver that integrates it."""

    omega: Number
    epsilon: Number = 1.0
    gamma: Number = 1.0
    half_width: Annotated[Whole, Field(ge=0)] = 30
    boundary: Literal["dirichlet", "free", "periodic"] = "dirichlet"
    initial: Annotated[dict[Whole, tuple[Complex, Complex]], Field(min_length=1)] = {0: (1, 0.1)}
    end_time: Positive = 50.0
    output_step: Positive = 0.025
    snapshot_step: Positive | None = None
    solver: Solver = Taylor()

    @model_validator(mode="after")
    def _consistent(self) -> "Case":
        for key in ("end_time", "snapshot_step"):
            time = getattr(self, key)
            if time is not None and not _on_grid(time, self.output_step):
                raise PydanticCustomError(
                    "grid",
                    "{key}: {time} is not a whole number of output steps of {step}",
                    {"key": key, "time": time, "step": self.output_step},
                )
        if self.snapshot_step is not None and self.snapshot_step > self.end_time:
            raise PydanticCustomError("grid", "snapshot_step: is longer than the run")
        outside = [site for site in self.initial if abs(site) > self.half_width]
        if outside:
            raise PydanticCustomError(
                "site",
                "initial: site {site} lies outside the chain, whose sites run from -{m} to {m}",
                {"site": outside[0], "m": self.half_width},
            )
        return self

    def problem(self, **changes) -> dict:
        """Return the case as plain values of a Problem, some of them changed."""
        values = {**self.model_dump(), **changes}
        snapshots = values.pop("snapshot_step")
        every = round(snapshots / values["output_step"]) if snapshots else 0
        return {**values, "snapshot_every": every}

    def shown_problem(self, **changes) -> dict:
        """Return the problem, with snapshots enough for a picture if the case names no number."""
        problem = self.problem(**changes)
        every = problem["snapshot_every"] or choose_every(
            round(problem["end_time"] / problem["output_step"]), 2 * problem["half_width"] + 1
        )
        return {**problem, "snapshot_every": every}


class Drawn(Model):
    """The windows whose maximum and whose mean a figure shows."""

    max: Window
    mean: Window


class Sweep(Model):
    """A case repeated over half-widths, with its norms reduced over windows of time."""

    case: str
    half_widths: Annotated[list[Annotated[Whole, Field(ge=0)]], Field(min_length=1)]
    windows: Annotated[list[Window], Field(min_length=1)] = [(10, 40), (10, 50), (10, 70)]
    draw: Drawn | None = None
    solver: Solver | None = None

    @model_validator(mode="after")
    def _consistent(self) -> "Sweep":
        for start, end in self.windows:
            if not 0 <= start < end:
                raise PydanticCustomError(
                    "window",
                    "windows: [{start}, {end}] does not run forward from a time >= 0",
                    {"start": start, "end": end},
                )
        if len(set(self.half_widths)) < len(self.half_widths):
            raise PydanticCustomError("repeated", "half_widths: the same half-width stands twice")
        if self.draw and not {self.draw.max, self.draw.mean} <= set(self.windows):
            raise PydanticCustomError("drawn", "draw: takes windows that stand under windows only")
        return self

    @property
    def drawn(self) -> Drawn:
        """The windows that a figure shows: the first one, if the configuration names none."""
        return self.draw or Drawn(max=self.windows[0], mean=self.windows[0])


def with_controls(item: Any, shared: Any) -> Any:
    """Return a case or sweep whose solver is a mapping, completed from the shared controls."""
    given = item.get("solver") if isinstance(item, dict) else None
    given = {"name": given} if isinstance(given, str) else given
    if not isinstance(given, dict) or not isinstance(shared, dict):
        return item
    controls = shared.get(given.get("name"))
    return {**item, "solver": {**controls, **given} if isinstance(controls, dict) else given}


class Configuration(Model):
    """Cases, sweeps and the solvers' controls; `messages` adds a section for each study."""

    cases: Annotated[dict[Name, Case], Field(min_length=1)]
    sweeps: dict[Name, Sweep] = {}
    solvers: Solvers = Solvers()

    @model_validator(mode="before")
    @classmethod
    def _complete_solvers(cls, raw: Any) -> Any:
        """Give every solver that is only named its controls from `solvers`."""
        if not isinstance(raw, dict):
            return raw
        sections = {}
        for section, default in (("cases", {"solver": "taylor"}), ("sweeps", {})):
            if isinstance(raw.get(section), dict):
                sections[section] = {
                    name: with_controls({**default, **item}, raw.get("solvers") or {})
                    if isinstance(item, dict)
                    else item
                    for name, item in raw[section].items()
                }
        return {**raw, **sections}

    @model_validator(mode="after")
    def _sweeps_fit_their_cases(self) -> "Configuration":
        faults = [fault for name in self.sweeps for fault in self._faults_of_sweep(name)]
        if faults:
            raise PydanticCustomError("sweeps", "{faults}", {"faults": "\n".join(faults)})
        return self

    def _faults_of_sweep(self, name: str) -> list[str]:
        sweep, here = self.sweeps[name], f"sweeps.{name}"
        if sweep.case not in self.cases:
            near = difflib.get_close_matches(sweep.case, self.cases, 1)
            hint = f"; did you mean {near[0]!r}?" if near else ""
            return [f"{here}.case: there is no case {sweep.case!r}{hint}"]
        case, faults = self.cases[sweep.case], []
        reach = max(map(abs, case.initial))
        if reach > min(sweep.half_widths):
            faults.append(
                f"{here}.half_widths: site {reach} of case {sweep.case!r} lies outside the chain "
                f"of half-width {min(sweep.half_widths)}"
            )
        off_grid = [t for w in sweep.windows for t in w if not _on_grid(t, case.output_step)]
        if off_grid:
            faults.append(
                f"{here}.windows: {off_grid[0]} is not a whole number of output steps "
                f"of {case.output_step}"
            )
        return faults

    def problem(self, case: str, solver: str | None = None, **changes) -> dict:
        """Return a case as plain values of a Problem.

        `solver` takes the place of the case's own, `changes` that of other keys.
        """
        return self.cases[case].problem(**self._by(solver), **changes)

    def shown_problem(self, case: str, solver: str | None = None) -> dict:
        """Return the problem, with snapshots enough for a picture if the case names no number."""
        return self.cases[case].shown_problem(**self._by(solver))

    def swept_problem(self, sweep: str, solver: str | None = None) -> dict:
        """Return the case of a sweep as plain values, to be run to the end of the last window."""
        end_time = max(end for _, end in self.sweeps[sweep].windows)
        own = self.sweeps[sweep].solver
        changes = {"end_time": end_time, "snapshot_step": None}
        if own is not None:
            changes["solver"] = own.model_dump()
        changes |= self._by(solver)
        return self.cases[self.sweeps[sweep].case].problem(**changes)

    def _by(self, solver: str | None) -> dict:
        return {} if solver is None else {"solver": getattr(self.solvers, solver).model_dump()}
