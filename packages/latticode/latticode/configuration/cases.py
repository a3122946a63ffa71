"""A case of a traced model: its keys, their defaults, and checks of keys against each other."""

import difflib
from collections.abc import Iterator, Mapping
from math import gcd, inf
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import (
    BeforeValidator,
    Field,
    PlainSerializer,
    SerializationInfo,
    ValidationInfo,
    ValidatorFunctionWrapHandler,
    WrapValidator,
    field_validator,
    model_validator,
)

from latticode.equations.couplings import at_middle
from latticode.equations.ends import ENDS
from latticode.equations.initial_values import STORED_OBSERVABLES
from latticode.equations.model import Model as Traced
from latticode.equations.model import ModelError
from latticode.equations.model_file import chain_sites
from latticode.integrators.families import first_tolerance, instead_of_taylor, pair_of
from latticode.integrators.method import Obstacle
from latticode.integrators.methods import METHODS, methods_taking
from latticode.simulation.feasibility import MOST_STEPS, find_fault, rates_of
from latticode.simulation.problem import Problem

from . import cost
from .cost import RunCost
from .files import ConfigurationError
from .initial import BySite, end_of_run, fields_on, read_initial
from .solvers import DEFAULT, FLAG, Solver, Solvers, Taylor
from .values import (
    Complex,
    Count,
    Distinct,
    Integer,
    Natural,
    Number,
    Positive,
    Section,
    excerpt_of,
    fault,
    faults,
)

FEWEST = 200
"""The fewest snapshots for a smooth picture."""
MOST_NUMBERS = 20_000_000
"""The most moduli that are kept in memory; very long chains get fewer snapshots."""
UNKNOWN = "initial", "mu", "parameters", "solver.name"
"""Keys that `obstacles` needs; it is not called if one of them is invalid."""
MOST_COUNTED = 1e15
"""Beyond this many steps, rounding hides whether a step divides a time. Such runs are rejected for
their cost."""


def choose_every(outputs: int, sites: int) -> int:
    """Return the number of output steps between two snapshots of a run of `outputs` steps.

    It divides `outputs`, so the last state is a snapshot.
    """
    most = max(1, MOST_NUMBERS // (2 * sites))
    divisors = [every for every in range(1, outputs // FEWEST + 1) if outputs % every == 0]
    every = divisors[-1] if divisors else 1
    while outputs // every > most or outputs % every:
        every += 1
    return every


def is_multiple(time: float, step: float) -> bool:
    """Return whether a time is a whole number of steps, at least one."""
    if time / step >= MOST_COUNTED:
        return True
    count = round(time / step)
    return count >= 1 and abs(time - count * step) <= 1e-9 * time


def _nearest_multiples(time: float, step: float) -> str:
    count = int(time / step)
    near = [f"{max(count, 1) * step:.12g}", f"{(max(count, 1) + 1) * step:.12g}"]
    return f"the nearest are {near[0]} and {near[1]}" if count else f"the shortest is {near[0]}"


def _nearest_parts(span: float, step: float) -> str:
    """Return the part of a message that names the steps nearest to `step` that divide `span`."""
    count = min(span / step, MOST_COUNTED)
    near = [span / max(1, int(count) + more) for more in (0, 1)]
    shortest = f"the longest that does is {span:.12g}"
    return shortest if count < 1 else f"the nearest that do are {near[1]:.12g} and {near[0]:.12g}"


def _nearest_snapshots(outputs: int, every: int, step: float) -> str:
    """Return the part of a message that names the nearest snapshot steps that divide the run."""
    below = next(n for n in range(every, 0, -1) if outputs % n == 0)
    above = next(n for n in range(every, outputs + 1) if outputs % n == 0)
    return f"the nearest that do are {below * step:.12g} and {above * step:.12g}"


def _initial(raw_value: Any, by_site: ValidatorFunctionWrapHandler) -> Any:
    """Return data by site as numbers; arrays and functions are evaluated on the sites later."""
    data = read_initial(raw_value)
    return by_site(data) if isinstance(data, dict) else data


Initial = Annotated[
    dict[Integer, tuple[Complex, ...]],
    Field(min_length=1),
    WrapValidator(_initial),
    PlainSerializer(lambda data: data),
]
"""Initial data: by site, an array with one number per site, or a function of the sites."""


def _listed_times(raw_value: Any) -> Any:
    return raw_value.tolist() if isinstance(raw_value, np.ndarray) else raw_value


Time = Annotated[Number, Field(ge=0)]
Times = Annotated[
    list[Time], BeforeValidator(_listed_times), Field(min_length=1, max_length=100_000), Distinct
]


def _as_model(value: Any) -> Traced:
    try:
        if isinstance(value, Mapping):
            raise fault(
                "is a mapping; give the path of a file, such as mine.py: a configuration"
                " cannot contain code"
            )
        if not isinstance(value, Traced | str | Path):
            raise fault(f"is {excerpt_of(value)}; give a Model, or the path of its file")
        return value if isinstance(value, Traced) else Traced.read(value)
    except ModelError as error:
        raise fault(str(error)) from None


def _as_written(model: Traced, info: SerializationInfo) -> Any:
    """Return a model unchanged, or its plain values when the case is written as JSON."""
    return model.plain if info.mode == "json" else model


class CaseSection(Section):
    """An initial-value problem of a traced model, with its solver.

    Fields and parameters have the names that the model gives them.
    """

    kind: ClassVar[type[Problem]] = Problem
    """The class of the problem that is built from the plain values of a case."""
    model: Annotated[Any, BeforeValidator(_as_model), PlainSerializer(_as_written, Any)]
    parameters: dict[str, Any] = {}
    half_width: Natural | None = 30
    sites: Count | None = None
    boundary: Literal[tuple(ENDS)] = "dirichlet"
    initial: Initial
    start_time: Time = 0.0
    end_time: Positive = 50.0
    output_step: Positive = 0.025
    snapshot_step: Positive | None = None
    times: Times | None = None
    keep: Literal[STORED_OBSERVABLES] = "state"
    solver: Solver = Taylor(**DEFAULT)

    @model_validator(mode="before")
    @classmethod
    def _going_on(cls, raw: Any) -> Any:
        """Set `start_time` to the end of the run in `initial`, unless it is given."""
        if not isinstance(raw, dict) or "start_time" in raw:
            return raw
        start = end_of_run(raw.get("initial"))
        return raw if start is None else {**raw, "start_time": start}

    @model_validator(mode="before")
    @classmethod
    def _one_length(cls, raw_keys: Any) -> Any:
        """Drop `half_width` if the chain has a number of `sites`; reject a case with both."""
        if not isinstance(raw_keys, Mapping) or raw_keys.get("sites") is None:
            if isinstance(raw_keys, Mapping) and raw_keys.get("half_width", 0) is None:
                raise faults([("half_width", "is empty; give half_width or sites")])
            return raw_keys
        if raw_keys.get("half_width") is not None:
            text = "cannot be combined with half_width: leave one of them out; sites: 32 means the"
            raise faults([("sites", f"{text} sites 0..31, half_width: 16 the sites -16..16")])
        return {**raw_keys, "half_width": None}

    @field_validator("solver", mode="before")
    @classmethod
    def _known(cls, raw_value: Any, info: ValidationInfo) -> Any:
        """Reject an unknown solver, and list the solvers that can integrate the model."""
        if not isinstance(raw_value, Mapping) or "model" not in info.data:
            return raw_value
        name, known = raw_value.get("name"), cls.solvers_taking(info.data["model"])
        if "name" not in raw_value:
            raise faults([("name", f"is missing; it must be one of {', '.join(known)}")])
        if not isinstance(name, str) or name not in Solvers.model_fields:
            near = difflib.get_close_matches(str(name), known, 1, 0.5)
            hint = f"did you mean {near[0]!r}?" if near else f"give one of {', '.join(known)}"
            raise fault(f"there is no solver {name!r}; {hint}")
        return raw_value

    def __setattr__(self, name: str, value: Any) -> None:
        if name in type(self).model_fields:
            change = f"case.changed({name}={excerpt_of(value)})"
            raise ConfigurationError(f"a case cannot be changed; {change} returns a changed copy")
        super().__setattr__(name, value)

    # --- Properties that follow from the model

    def data_on(self, sites: range) -> BySite:
        """Return the initial data {site: a value for each field} on a chain.

        Raises ValueError if an array or a function has no values for the sites.
        """
        return fields_on(self.initial, self.fields, sites)

    @property
    def data(self) -> BySite:
        """The initial data {site: a value for each field}."""
        return self.data_on(self.chain)

    @property
    def span(self) -> float:
        """The duration of the run."""
        return self.end_time - self.start_time

    @classmethod
    def solvers_taking(cls, model: Any) -> list[str]:
        """Return the names of the solvers that can integrate a model."""
        return [*methods_taking(model), "auto"]

    @property
    def equations(self) -> str:
        """The name of the equations in messages."""
        return "the model" if self.model.name == "model" else f"the model {self.model.name}"

    @property
    def fields(self) -> tuple[str, ...]:
        """The names of the fields."""
        return self.model.fields

    @property
    def chain(self) -> range:
        """The sites of the chain: 0..sites - 1, or -M..M."""
        return chain_sites(self.half_width, self.sites)

    @property
    def solver_names(self) -> list[str]:
        """The names of the solvers that can integrate the equations."""
        return self.solvers_taking(self.model)

    @property
    def why_no_series(self) -> str:
        """The reason why solutions have no power series, "" if they have one."""
        return self.model.why_no_series if isinstance(self.model, Traced) else ""

    @property
    def cheap_values(self) -> Mapping[str, Mapping]:
        """Values that make a run short, for the keys that determine its cost."""
        return cost.CHEAP_VALUES

    def _faults_of_model(self) -> Iterator[tuple[str, str]]:
        known = self.model.parameters
        farthest = self.model.farthest
        key, length, least = "sites", self.sites, farthest
        if length is None:
            key, length, least = "half_width", self.half_width, min(farthest, self.model.reach)
        if length < least:
            why = f"because the model uses neighbours up to {farthest} site{'s' * (farthest > 1)}"
            yield key, f"is {length}; it must be at least {least}, {why} away"
        for name in self.parameters.keys() - known.keys():
            near = difflib.get_close_matches(name, known, 1)
            options = f"give one of {', '.join(known)}" if known else "it has none"
            hint = f"did you mean {near[0]!r}?" if near else options
            yield f"parameters.{name}", f"is not a parameter of {self.model.name}; {hint}"
        yield from self.faults_of_parameters(self.chain)

    def faults_of_parameters(self, sites: range) -> Iterator[tuple[str, str]]:
        """Yield (key, error) for each parameter whose values do not fit the sites of a chain."""
        for name, value in self._values_by_name().items():
            try:
                self.model.value_at(name, value, sites)
            except ValueError as error:
                where = "" if name in self.parameters else f" (the default in {self.model.name})"
                yield f"parameters.{name}", f"{error}{where}"

    def faults_of_half_widths(self, half_widths: list[int]) -> Iterator[tuple[str, str]]:
        """Yield (key, error) for each parameter whose values do not fit all chains of a sweep.

        Shorter chains use the values that the longest chain has at their sites. So a function must
        return the same value at a site for every chain.
        """
        longest, without_values = max(half_widths), []
        for name, text in self.faults_of_parameters(chain_sites(longest)):
            without_values.append(name)
            yield name, f"on the longest chain: {text}"
        for name, value in self._values_by_name().items():
            if callable(value) and f"parameters.{name}" not in without_values:
                longest_values = self.model.value_at(name, value, chain_sites(longest))
                if any(
                    at_middle(longest_values, m) != self.model.value_at(name, value, chain_sites(m))
                    for m in half_widths
                ):
                    text = "is a function whose values at a site change with the chain length"
                    yield f"parameters.{name}", f"{text}; make them depend only on the site"

    def _values_by_name(self) -> dict[str, Any]:
        return {k: self.parameters.get(k, default) for k, default in self.model.parameters.items()}

    def _values(self, sites: range) -> dict[str, float | list[float]]:
        return {
            k: self.model.value_at(k, value, sites) for k, value in self._values_by_name().items()
        }

    def values_by_half_width(self, half_widths: list[int]) -> dict[int, dict[str, Any]]:
        """Return, by half-width, the values of the parameters that are functions of the sites."""
        functions = {
            name: value for name, value in self._values_by_name().items() if callable(value)
        }
        if not functions:
            return {}
        chains = {m: chain_sites(m) for m in half_widths}
        return {
            m: {name: self.model.value_at(name, value, sites) for name, value in functions.items()}
            for m, sites in chains.items()
        }

    def _fault_and_rate(
        self, peak: float, span: float, solver: dict
    ) -> tuple[Obstacle | None, float]:
        """Return why amplitudes up to `peak` cannot be integrated, or None; and a rate bound."""
        rates = rates_of(self.model, self._values(self.chain), peak)
        return find_fault({}, rates, peak, span, solver), sum(rates.values())

    def problem(self, **changes: Any) -> dict:
        """Return the case as plain values of a Problem, with `changes` to some of them.

        Parameters are evaluated on the sites, so that a job is rerun if a value changes.
        """
        plain_values = self._plain_values(**changes)
        values = self._values(
            chain_sites(plain_values["half_width"], plain_values.get("site_count"))
        )
        return {**plain_values, "model": self.model.plain, "parameters": values}

    def cost(self, problem: Mapping) -> RunCost:
        """Return the cost of a problem of this case, given as plain values."""
        return cost.estimate(problem)

    def cost_with_checks(self, problem: Mapping) -> RunCost:
        """Return the cost of a run together with its checks."""
        return cost.with_checks(problem)

    # --- Cases of a survey

    @property
    def varied(self) -> tuple[str, ...]:
        """The names that a survey can vary, besides `half_width`, `end_time` and initial data."""
        return tuple(self.model.parameters)

    def _varied(self, name: str, value: Any) -> dict[str, Any]:
        return {"parameters": {**self.parameters, name: value}}

    def at(self, values: Mapping[str, Any]) -> "CaseSection":
        """Return the validated case at one point of a survey's axes."""
        changes: dict[str, Any] = {"snapshot_step": None, "times": None}
        initial = {site: list(data) for site, data in self.data.items()}
        for name, value in values.items():
            if name.startswith("initial."):
                site, place = map(int, name.split(".")[1:])
                initial[site][place] = value
            elif name in ("half_width", "end_time"):
                if name == "half_width":
                    changes["sites"] = None
                changes[name] = value
            else:
                changes |= self._varied(name, value)
        # pydantic would check a class with an initialiser of its own, as in notebooks, twice
        kind = next(k for k in type(self).__mro__ if not k.__pydantic_custom_init__)
        return kind.model_validate({**self.model_dump(), **changes, "initial": initial})

    # --- Checks of keys against each other

    @model_validator(mode="after")
    def _consistent(self) -> "CaseSection":
        all_faults = [
            *self._faults_of_initial(),
            *self._faults_of_model(),
            *self._faults_of_times(),
        ]
        all_faults += [*self.faults_of_solver(self.solver)] or [*self.faults_of_step(self.solver)]
        if not any(key.startswith(UNKNOWN) for key, _ in all_faults):
            all_faults += self.obstacles()
        if all_faults:
            raise faults(all_faults)
        return self

    def _faults_of_initial(self) -> Iterator[tuple[str, str]]:
        count = len(self.fields)
        try:
            _ = self.data
        except ValueError as error:
            yield "initial", str(error)
            return
        for site, values in self.data.items():
            if len(values) != count:
                names = ", ".join(self.fields)
                has = f"{len(values)} value{'s' * (len(values) != 1)}"
                yield "initial", f"site {site} has {has}; give {count}, [{names}]"
        yield from self._needless_imaginary_parts()
        outside = [site for site in self.data if site not in self.chain]
        if outside:
            ends = f"{self.chain[0]} to {self.chain[-1]}"
            yield "initial", f"site {outside[0]} is outside the chain of the sites {ends}"

    def _needless_imaginary_parts(self) -> Iterator[tuple[str, str]]:
        """Yield an error for an imaginary part that enters the norms but no equation."""
        alone = getattr(self.model, "without_imaginary_parts", ())
        for site, values in self.data.items():
            for name, z in zip(self.fields, values, strict=False):
                if name in alone and z.imag:
                    text = f"site {site}: {name} has the imaginary part {z.imag:g}, which no"
                    yield "initial", f"{text} equation reads or changes; give a real number"
                    return

    @property
    def has_needless_imaginary_parts(self) -> bool:
        """Whether the initial data are complex but the equations are those of real fields."""
        complex_data = any(z.imag for values in self.data.values() for z in values)
        return complex_data and getattr(self.model, "continues_real_equations", False)

    def faults_of_solver(self, solver: Any) -> Iterator[tuple[str, str]]:
        """Yield (key, error) if a solver cannot integrate the equations of the case."""
        if solver.name not in self.solver_names and not getattr(solver, FLAG, False):
            known, equations = ", ".join(self.solver_names), self.equations
            why = self.why_no_series if solver.name == "taylor" else ""
            equations += f", which {why}" if why else ""
            yield "solver.name", f"{solver.name} cannot integrate {equations}; give one of {known}"

    def _faults_of_times(self) -> Iterator[tuple[str, str]]:
        step, off_grid = self.output_step, []
        if self.span <= 0:
            yield "end_time", f"is {self.end_time:g}; it must be later than {self.start_time:g}"
            return
        for key, time in (("end_time", self.span), ("snapshot_step", self.snapshot_step)):
            if time is not None and not is_multiple(time, step):
                off_grid.append(key)
                near = _nearest_multiples(time, step)
                since = f" after start_time {self.start_time:g}" if self.start_time else ""
                text = f"is not a whole number of output steps of {step:g}"
                yield key, f"{time:g}{since} {text}; {near}"
        yield from self._faults_of_chosen_times()
        if self.snapshot_step is None or off_grid:
            return
        if self.snapshot_step > self.span:
            yield "snapshot_step", "is longer than the run"
        elif not is_multiple(self.span, self.snapshot_step):
            outputs, every = round(self.span / step), round(self.snapshot_step / step)
            text = f"{self.snapshot_step:g} does not divide the run of {self.span:g}"
            near = _nearest_snapshots(outputs, every, step) if outputs < 1e7 else ""
            text += ", so the last state would not be stored"
            yield "snapshot_step", f"{text}; {near}".strip("; ")

    def _faults_of_chosen_times(self) -> Iterator[tuple[str, str]]:
        times, step = self.times or [], self.output_step
        if times and self.snapshot_step is not None:
            yield "times", "cannot be combined with snapshot_step: leave one of them out"
        if late := [time for time in times if time > self.end_time]:
            yield "times", f"{late[0]:g} lies after the end of the run at {self.end_time:g}"
        if early := [time for time in times if time < self.start_time]:
            yield "times", f"{early[0]:g} lies before the start of the run at {self.start_time:g}"
            return
        since = [time - self.start_time for time in times]
        if off_grid := [time for time in since if time and not is_multiple(time, step)]:
            near = _nearest_multiples(off_grid[0], step)
            after = f" after start_time {self.start_time:g}" if self.start_time else ""
            text = f"{off_grid[0]:g}{after} is not a whole number of output steps of {step:g}"
            yield "times", f"{text}; {near}"

    def faults_of_step(self, solver: Any) -> Iterator[tuple[str, str]]:
        """Yield (key, error) if the step of a solver does not divide the output step."""
        step, method = getattr(solver, "step", None), METHODS.get(solver.name)
        if method is None or not method.step_divides_outputs:
            return
        if not is_multiple(self.output_step, step):
            near = _nearest_parts(self.output_step, step)
            text = f"{step:g} does not divide the output step of {self.output_step:g}"
            yield "solver.step", f"{text}; {near}"

    def obstacles(self, solver: Section | None = None, span: float = 0.0) -> list[tuple[str, str]]:
        """Return (key, reason) if a run cannot reach its end with the requested accuracy.

        `solver` and `span` replace the solver and the duration of the case.
        """
        span = span or self.span
        controls = self._solver_of_run((solver or self.solver).model_dump())
        if controls["name"] == "auto":  # its first run has the loosest tolerance
            tolerance = first_tolerance(controls["error"], 0.0)
            name, _ = pair_of(self.solver_names)
            controls = {"name": name, "rtol": tolerance, "atol": tolerance}
        amplitudes = [z for values in self.data.values() for z in values]
        peak = max(max(abs(z.real), abs(z.imag)) for z in amplitudes)
        obstacle, speed = self._fault_and_rate(peak, span, controls)
        angle = speed * span
        ends = {"end_time": self.start_time + span, "snapshot_step": None, "times": None}
        run_cost = self.cost(self.problem(solver=controls, **ends))
        if obstacle is not None and cost.HOUR < run_cost.seconds < inf:
            obstacle = obstacle[0], f"{obstacle[1]}, and would take {run_cost}"
        if obstacle is not None and MOST_STEPS < angle < inf:
            # 0.99, so that rounding to three digits does not exceed the limit
            longest = self.start_time + 0.99 * MOST_STEPS / speed
            obstacle = obstacle[0], f"{obstacle[1]}; end_time may be at most {longest:.3g} here"
        if obstacle is None and 0.0 < angle < SMALLEST_ANGLE:
            text = f"is too short: the phases change by only {angle:.0e} radians, near rounding"
            obstacle = "end_time", f"{span:g} {text}"
        return [obstacle] if obstacle else []

    def _plain_values(self, **changes: Any) -> dict:
        values = {**self.model_dump(), **changes}
        count = values.pop("sites", None)
        counted = {} if count is None else {"site_count": count}
        if "initial" not in changes:
            values["initial"] = self.data_on(chain_sites(values["half_width"], count))
        snapshots, times = values.pop("snapshot_step"), values.pop("times")
        every = round(snapshots / values["output_step"]) if snapshots else 0
        since = [time - values["start_time"] for time in times or []]
        chosen = sorted(round(time / values["output_step"]) for time in since)
        if chosen:
            every = gcd(*chosen) or 1
        solver = self._solver_of_run(values["solver"])
        snapshots = {"snapshot_every": every, "snapshots_at": chosen}
        return {**values, "solver": solver, **snapshots, **counted}

    def _solver_of_run(self, solver: dict) -> dict:
        """Return the controls of the solver that runs the case.

        If the case names no solver and its solutions have no power series, it is `dop853`. If the
        series may fail during the run, a flag allows `dop853` to take over.
        """
        if not solver.get(FLAG) or "taylor" in self.solver_names:
            return solver
        why = f"{self.equations} {self.why_no_series}"
        return {**instead_of_taylor(solver), "instead_of_taylor": why}

    def shown_problem(self, **changes: Any) -> dict:
        """Return the problem, with enough snapshots for a picture if the case specifies none."""
        problem = self.problem(**changes)
        if self.keep == "norms":
            return {**problem, "snapshot_every": 0, "snapshots_at": []}
        every = problem["snapshot_every"] or choose_every(
            round(cost.span_of(problem) / problem["output_step"]), len(self.chain)
        )
        return {**problem, "snapshot_every": every}


SMALLEST_ANGLE = 1e-9
"""Radians: a run is rejected if its phases change by less, because rounding would dominate."""
