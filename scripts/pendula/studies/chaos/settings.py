"""The keys of config/chaos.yaml: cases, run times, tolerances and seeds."""

from collections.abc import Iterator
from typing import Annotated, Literal

from latticode.configuration.values import (
    Count,
    Counts,
    Distinct,
    Integer,
    Name,
    Names,
    Natural,
    Positive,
    Section,
    Tolerance,
    Window,
    section_of,
)
from pydantic import Field

from pendula.configuration.cost import RunCost, estimate
from pendula.configuration.runs import Runs
from pendula.configuration.schema import PAPER_CASES, Faults, PaperConfiguration


class SpectrumSection(Section):
    """All Lyapunov exponents on a short chain, to `duration_factor` times the latest end time.

    Without a drive the chain is integrated to `undriven_duration_factor` times the same time.
    """

    cases: Names
    half_width: Count
    tolerance: Tolerance
    duration_factor: Positive
    undriven_duration_factor: Positive


RANDOM = {"tolerance": Tolerance, "size": Positive, "seed": Natural}
"""Keys of all ensembles; `size` is the relative perturbation."""

VARIED = Literal["tolerance", "output_step", "size", "seed", "window", "level", "multiple"]
"""Choices of the study of lifetimes that its long runs vary."""

# The largest exponent of every case, over a time span.
Lyapunov = section_of(
    span=Window, members=Annotated[Integer, Field(ge=2)], spectrum=SpectrumSection, **RANDOM
)

# Sweeps of ensembles: on chains of each half-width, `members` runs from slightly perturbed data.
Ensembles = section_of(
    sweeps=Annotated[
        dict[Name, section_of(half_widths=Counts, members=Annotated[Integer, Field(ge=2)])],
        Field(min_length=1),
    ],
    output_step=Positive,
    **RANDOM,
)

# A chaotic sweep by the second solver with two steps, and by the first solver.
SecondSolver = section_of(
    sweep=Name,
    half_widths=Counts,
    members=Annotated[Integer, Field(ge=2)],
    first_members=Annotated[Integer, Field(ge=2)],
    seed=Natural,
)

# Ensembles of every case, with each member reduced to numbers over time windows.
Members = section_of(
    windows=Annotated[list[Window], Field(min_length=2, max_length=2), Distinct],
    output_step=Positive,
    members=Annotated[Integer, Field(ge=3)],
    **RANDOM,
)


def second_solver_steps(step: float, output_step: float) -> list[float]:
    """Return the step of the second solver and a coarse one, in order, or one if they are equal.

    The coarse step is half of the output step, so it divides the output step.
    """
    return sorted({step, output_step / 2})


class Lifetimes(Section):
    """Two times of the transition, against the initial amplitude of the central pair."""

    case: Name
    amplitudes: Annotated[list[Positive], Field(min_length=2), Distinct]
    ratio: Positive
    members: Count
    size: Positive
    tolerance: Tolerance
    window: Window
    level: Annotated[Positive, Field(lt=1)]
    multiple: Positive
    end_time: Positive
    output_step: Positive
    seed: Natural
    long: section_of(members=Count, variations=dict[VARIED, list[Positive | Window]])


class Settings(Section):
    """Section `chaos` of the configuration."""

    lyapunov: Lyapunov
    ensembles: Ensembles
    second_solver: SecondSolver
    members: Members
    lifetimes: Lifetimes

    def faults(self, settings: PaperConfiguration) -> Faults:
        """Yield errors in cases, sweeps and windows, and for runs that take too long."""
        absent = [
            *settings.absent("cases", "lyapunov.spectrum.cases", self.lyapunov.spectrum.cases),
            *settings.absent("sweeps", "ensembles.sweeps", list(self.ensembles.sweeps)),
            *settings.absent("sweeps", "second_solver.sweep", [self.second_solver.sweep]),
            *settings.absent("cases", "lifetimes.case", [self.lifetimes.case]),
        ]
        yield from absent
        windows = {f"members.windows.{i}": window for i, window in enumerate(self.members.windows)}
        windows |= {"lyapunov.span": self.lyapunov.span, "lifetimes.window": self.lifetimes.window}
        for key, (start, end) in windows.items():
            if not 0 <= start < end:
                yield key, f"[{start:g}, {end:g}] must have 0 <= start < end"
        if (last := self.lifetimes.window[1]) > self.lifetimes.end_time:
            yield "lifetimes.window", f"ends at {last:g}, after the runs; increase end_time"
        if not absent:
            for runs in self.runs_of(settings):
                yield from settings.faults_of_runs(runs)
            yield from settings.excess("lyapunov.spectrum.duration_factor", self._spectra(settings))

    def member_of(self, settings: PaperConfiguration, sweep: str) -> dict:
        """Return the problem of a sweep's ensemble as plain values, and the windows in figures."""
        drawn = settings.sweeps[sweep].drawn
        windows = [list(window) for window in (drawn.max, drawn.mean)]
        times = {
            "output_step": self.ensembles.output_step,
            "end_time": max(end for _, end in windows),
        }
        case, tolerance = settings.sweeps[sweep].case, self.ensembles.tolerance
        return {"problem": settings.run_of(case, tolerance, **times), "windows": windows}

    def by_second_solver(self, settings: PaperConfiguration, sweep: str) -> list[dict]:
        """Return a sweep's problems by the second solver, with its step and a coarse one."""
        problem = settings.swept_problem(sweep, "crank_nicolson")
        end_time = self.member_of(settings, sweep)["problem"]["end_time"]
        problem |= {"end_time": end_time, "snapshot_every": 0}
        steps = second_solver_steps(problem["solver"]["step"], problem["output_step"])
        return [{**problem, "solver": {**problem["solver"], "step": step}} for step in steps]

    def shorter_chains(self, settings: PaperConfiguration, case: str) -> dict[str, int]:
        """Return the least half-width of each ensemble that integrates a case, by its key."""
        spectrum = self.lyapunov.spectrum
        half_widths = {"lyapunov.spectrum": spectrum.half_width} if case in spectrum.cases else {}
        for name, swept in self.ensembles.sweeps.items():
            if name in settings.sweeps and settings.sweeps[name].case == case:
                half_widths[f"ensembles.sweeps.{name}"] = min(swept.half_widths)
        swept = self.second_solver
        if swept.sweep in settings.sweeps and settings.sweeps[swept.sweep].case == case:
            half_widths["second_solver.half_widths"] = min(swept.half_widths)
        return half_widths

    def runs_of(self, settings: PaperConfiguration) -> Iterator[Runs]:
        """Yield the runs of each ensemble; a tangent vector costs as much as its trajectory."""
        paper = [case for case in PAPER_CASES if case in settings.cases]
        longest = max((settings.cases[case].end_time for case in paper), default=1.0)
        followed = self.lyapunov
        runs = [
            settings.run_of(case, followed.tolerance, "dop853", end_time=longest) for case in paper
        ]
        yield Runs(
            "lyapunov.members",
            "lyapunov.tolerance",
            runs,
            2.0 * followed.span[1] / longest * followed.members,
            "lyapunov.size",
            followed.size,
        )
        for name, sweep in self.ensembles.sweeps.items():
            key = f"ensembles.sweeps.{name}.members"
            yield self._swept(settings, key, name, sweep.half_widths, sweep.members)
        second = self.second_solver
        members = second.first_members + 2 * second.members
        key = "second_solver.first_members"
        yield self._swept(settings, key, second.sweep, second.half_widths, members)
        ensembles = self.members
        ends = {"end_time": max(end for _, end in ensembles.windows)}
        chosen = {**ends, "output_step": ensembles.output_step, "snapshot_every": 1}
        runs = [settings.run_of(case, ensembles.tolerance, **chosen) for case in paper]
        every = "members.members", "members.tolerance", runs, ensembles.members
        yield Runs(*every, "members.size", ensembles.size)
        yield self._lives(settings)

    def _swept(
        self, settings: PaperConfiguration, key: str, name: str, widths: list[int], members: int
    ) -> Runs:
        """Return the runs of the members of a sweep by the solver of the ensembles."""
        drawn, sweep = self.ensembles, settings.sweeps[name]
        ends = {"end_time": max(sweep.drawn.max[1], sweep.drawn.mean[1])}
        chosen = {**ends, "output_step": drawn.output_step}
        runs = [
            settings.run_of(sweep.case, drawn.tolerance, half_width=m, **chosen) for m in widths
        ]
        return Runs(key, "ensembles.tolerance", runs, members, "ensembles.size", drawn.size)

    def _lives(self, settings: PaperConfiguration) -> Runs:
        """Return the runs from each amplitude; the centre is checked at each output."""
        lifetimes = self.lifetimes
        times = {"end_time": lifetimes.end_time, "output_step": lifetimes.output_step}
        runs = [
            settings.run_of(
                lifetimes.case, lifetimes.tolerance, **times, initial={0: (a, lifetimes.ratio * a)}
            )
            for a in lifetimes.amplitudes
        ]
        larger = "ratio" if lifetimes.ratio > 1.0 else "amplitudes"  # key of the larger of A_0, B_0
        short = max(map(estimate, runs)).seconds < 60.0
        many = "members" if short else "ratio" if lifetimes.ratio > 1.0 else "end_time"
        keys = f"lifetimes.{many}", f"lifetimes.{larger}"
        return Runs(*keys, runs, lifetimes.members, "lifetimes.size", lifetimes.size)

    def _spectra(self, settings: PaperConfiguration) -> list[RunCost]:
        """Return the costs of spectra: of half as many tangent vectors as a state has numbers."""
        spectrum, costs = self.lyapunov.spectrum, []
        for case in spectrum.cases:
            cost = estimate(settings.problem(case, half_width=spectrum.half_width))
            vectors = (
                2
                * (2 * spectrum.half_width + 1)
                * (spectrum.duration_factor + spectrum.undriven_duration_factor)
            )
            costs.append(RunCost(vectors * cost.seconds, cost.memory))
        return costs
