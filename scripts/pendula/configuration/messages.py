"""The whole configuration, with a section for each study, and checks of what figures need."""

from collections.abc import Iterator, Mapping

from latticode.configuration import messages
from latticode.configuration.cases import CaseSection
from latticode.configuration.cost import steps_of
from latticode.configuration.files import list_faults
from latticode.configuration.schema import Sweep
from pydantic import ValidationError, create_model

from pendula.problem import AMPLITUDES
from pendula.studies import modules_named

from .cost import demand
from .schema import PaperConfiguration

STUDIES = {name: module.Settings for name, module in modules_named("settings").items()}
Sections = create_model(
    "Sections",
    __base__=PaperConfiguration,
    **{name: (of | None, None) for name, of in STUDIES.items()},
)
"""The whole configuration: a section for each study, None if it is omitted."""


def load(raw: dict) -> PaperConfiguration:
    """Return the validated configuration; raises ConfigurationError with a list of all errors."""
    try:
        settings = Sections.model_validate(raw)
    except ValidationError as error:
        raise messages.configuration_error(error, "the configuration", root=Sections) from None
    lines = [
        f"{study}.{key}: {text}"
        for study in STUDIES
        if hasattr(section := getattr(settings, study), "faults")
        for key, text in section.faults(settings)
    ]
    if lines:
        raise list_faults(lines, "the configuration")
    return settings


def require(
    settings: PaperConfiguration, cases: list[str], sweeps: list[str], solvers: list[str]
) -> None:
    """Raise ConfigurationError if something that the figures need is missing or invalid.

    Each of `cases` is integrated by each of `solvers`, whose step must divide the output step.
    """
    absent = [study for study in STUDIES if getattr(settings, study) is None]
    absent += [f"cases.{name}" for name in cases if name not in settings.cases]
    absent += [f"sweeps.{name}" for name in sweeps if name not in settings.sweeps]
    lines = [f"{path}: is missing or empty, but the figures need it" for path in absent]
    steps: dict[str, str] = {}
    for name in [name for name in cases if name in settings.cases]:
        lines += _faults_of_figures(name, settings.cases[name])
        lines += _faults_of_short_chains(name, settings)
        for solver in solvers:
            controls = getattr(settings.solvers, solver)
            for _, text in settings.cases[name].faults_of_step(controls):
                steps.setdefault(f"solvers.{solver}.step: {text}", name)
    lines += [f"{text} (in cases.{name})" for text, name in steps.items()]
    lines += _unlike_panels(settings.sweeps, sweeps)
    known_cases = [name for name in cases if name in settings.cases]
    lines += _too_coarse_steps(settings, known_cases) if "ode45" in solvers else []
    if lines:
        raise list_faults(lines, "the configuration")


def _faults_of_figures(name: str, case: CaseSection) -> Iterator[str]:
    """Yield an error for each reason why a case cannot replace one of the paper's."""
    way_out = "use another name for this case"
    if case.model != AMPLITUDES:
        yield f"cases.{name}.model: the figures of the paper show amplitudes; {way_out}"
        return
    if not any(z for pair in case.data.values() for z in pair):
        yield f"cases.{name}.initial: is zero everywhere, so nothing would move; {way_out}"
    if case.epsilon < 0.0:
        text = "but pendula that repel each other speed up without bound"
        yield f"cases.{name}.epsilon: is {case.epsilon:g}, {text}; {way_out}"
    if case.half_width == 0:
        yield f"cases.{name}.half_width: is 0, but the figures need several pairs; {way_out}"


def _faults_of_short_chains(name: str, settings: PaperConfiguration) -> Iterator[str]:
    """Yield an error if a case has initial data beyond the ends of a study's shorter chains."""
    reach = max(map(abs, settings.cases[name].data), default=0)
    shorter = settings.chaos.shorter_chains(settings, name) if settings.chaos else {}
    for key, half_width in shorter.items():
        if half_width < reach <= settings.cases[name].half_width:
            text = f"the chains of chaos.{key} end at {half_width}; use sites nearer to the centre"
            yield f"cases.{name}.initial: has the site {reach}, but {text}"
            return


def _too_coarse_steps(settings: PaperConfiguration, names: list[str]) -> Iterator[str]:
    """Yield an error for a tolerance of ode45 at which runs of the paper's cases may blow up.

    The relative error of a step is up to `rtol`. Once these errors add up to the size of the data,
    ode45 may gain energy until its step is too small. A run with a sum of 1.75 times the data did.
    """
    runs = {}
    for case in names:
        swept = [
            settings.swept_problem(key) for key, run in settings.sweeps.items() if run.case == case
        ]
        runs[case] = settings.problem(case, "ode45")
        runs[case]["end_time"] = max(run["end_time"] for run in (runs[case], *swept))
    rtol = settings.solvers.ode45.rtol
    name = max(runs, key=lambda case: _sum_of_errors(runs[case], rtol), default="")
    if name and (total := _sum_of_errors(runs[name], rtol)) > 1.0:
        most, span = 0.1 * rtol, runs[name]["end_time"]
        while _sum_of_errors(runs[name], most) > 1.0:
            most *= 0.1
        text = f"add up to {total:.2g} times the data of cases.{name} by tau = {span:g}"
        words = f"is {rtol:g}, but the errors of its steps {text}; give at most {most:.0e}"
        yield f"solvers.ode45.rtol: {words}"


def _sum_of_errors(problem: dict, rtol: float) -> float:
    """Return the sum of the errors of all steps of ode45, relative to the data."""
    steps, _ = steps_of({**problem["solver"], "rtol": rtol}, problem, demand(problem))
    return steps * rtol


def _unlike_panels(sweeps: Mapping[str, Sweep], names: list[str]) -> list[str]:
    """Return an error for each panel whose windows differ from those of the panel to its left."""
    left_panels = {name: f"{name.partition('_')[0]}_left" for name in names}
    return [
        f"sweeps.{name}.draw: differs from sweeps.{left}, the panel to its left: give both the same"
        " windows and draw"
        for name, left in left_panels.items()
        if {name, left} <= set(sweeps) and sweeps[name].drawn != sweeps[left].drawn
    ]
