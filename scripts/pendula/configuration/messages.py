"""Faults of a configuration in words: all at once, by dotted path, with the nearest valid key."""

import difflib
import re
from collections.abc import Iterator, Mapping
from typing import get_args

from pydantic import BaseModel, ValidationError, create_model

from pendula.problem import AMPLITUDES
from pendula.studies import modules

from .cases import Case
from .files import ConfigurationError, list_faults
from .schema import Configuration, Sweep
from .solvers import Solvers
from .values import LONGEST_SHOWN, shown

SOLVERS = tuple(Solvers.model_fields)
HINTS = {
    "N": "the chain has N = 2 half_width + 1 sites, always an odd number: give half_width",
    "sites": "the chain has N = 2 half_width + 1 sites, always an odd number: give half_width",
    "M": "the paper's M is called half_width",
    "tau": "the end of the run is called end_time",
}
WORDS = {
    "missing": "is missing",
    "finite_number": "is {input}, which is not finite",
    "greater_than": "is {input}; it must be greater than {gt}",
    "greater_than_equal": "is {input}; it must be at least {ge}",
    "less_than": "is {input}; it must be less than {lt}",
    "less_than_equal": "is {input}; it must be at most {le}",
    "too_short": "has fewer than {min_length} entries",
    "too_long": "has {actual_length} entries; give at most {max_length}",
    "invalid_key": "is not a known key",
    **dict.fromkeys(("bool_parsing", "bool_type"), "is {input}, not true or false"),
    "int_parsing_size": "is {input}, more than can be counted to",
    "string_too_long": "is a name of more than {max_length} characters",
    **dict.fromkeys(("float_parsing", "float_type"), "is {input}, not a number"),
    **dict.fromkeys(
        ("int_parsing", "int_type", "int_from_float"), "is {input}, not a whole number"
    ),
    **dict.fromkeys(("dict_type", "model_type"), "is {input}, not a mapping of keys to values"),
    "model_attributes_type": "is {input}, not a name or a mapping of keys to values",
    "list_type": "is {input}, not a list",
    "tuple_type": "is {input}, not a pair of values",
    "string_type": "is {input}, not a name",
    "literal_error": "is {input}; it must be one of {expected}",
    "string_pattern_mismatch": "is not a name: use letters, digits, _ and -, a letter first",
}


STUDIES = {name: module.Settings for name, module in modules("settings").items()}
Sections = create_model(
    "Sections", __base__=Configuration, **{name: (of | None, None) for name, of in STUDIES.items()}
)
"""The whole configuration: with a section for each study, None where none is given."""


def load(raw: dict) -> Configuration:
    """Return the validated configuration, or raise ConfigurationError with every fault."""
    try:
        settings = Sections.model_validate(raw)
    except ValidationError as error:
        raise in_words(error, "the configuration") from None
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
    settings: Configuration, cases: list[str], sweeps: list[str], solvers: list[str]
) -> None:
    """Raise ConfigurationError unless all that the figures need is there and fits.

    Each of `cases` is integrated by each of `solvers`, whose steps must fit its outputs.
    """
    absent = [study for study in STUDIES if getattr(settings, study) is None]
    absent += [f"cases.{name}" for name in cases if name not in settings.cases]
    absent += [f"sweeps.{name}" for name in sweeps if name not in settings.sweeps]
    lines = [f"{path}: is missing or empty, and the figures need it" for path in absent]
    steps: dict[str, str] = {}
    for name in [name for name in cases if name in settings.cases]:
        lines += _faults_of_figures(name, settings.cases[name])
        for solver in solvers:
            controls = getattr(settings.solvers, solver)
            for _, text in settings.cases[name].faults_of_step(controls):
                steps.setdefault(f"solvers.{solver}.step: {text}", name)
    lines += [f"{text} (in cases.{name})" for text, name in steps.items()]
    lines += _unlike_panels(settings.sweeps, sweeps)
    if lines:
        raise list_faults(lines, "the configuration")


def _faults_of_figures(name: str, case: Case) -> Iterator[str]:
    """Yield why a case cannot take the place of one of the paper's, of which all studies are."""
    other = "give a case of another name"
    if case.model != AMPLITUDES:
        yield f"cases.{name}.model: the figures of the paper are of the amplitudes; {other}"
    if not any(z for pair in case.initial.values() for z in pair):
        yield f"cases.{name}.initial: is zero everywhere, and figures show what moves; {other}"
    if case.epsilon < 0.0:
        text = "and pendula that push each other apart speed up without bound"
        yield f"cases.{name}.epsilon: is {case.epsilon:g}, {text}; {other}"


def _unlike_panels(sweeps: Mapping[str, Sweep], names: list[str]) -> list[str]:
    """Return the faults of panels whose windows are not those of the panel to their left."""
    beside = {name: f"{name.partition('_')[0]}_left" for name in names}
    return [
        f"sweeps.{name}.draw: has other windows than sweeps.{left}, the panel beside it: give both "
        "the same windows and draw"
        for name, left in beside.items()
        if {name, left} <= set(sweeps) and sweeps[name].drawn != sweeps[left].drawn
    ]


def in_words(error: ValidationError, what: str, place: tuple = ()) -> ConfigurationError:
    """Return the error that lists every fault of `what`, which stands at `place`."""
    faults = [{**fault, "loc": (*place, *fault["loc"])} for fault in error.errors()]
    inside = _dotted(place) + "." if place else ""
    lines = [  # a line of a user's file, which is quoted below an error, belongs to it
        line.removeprefix(inside)
        for fault in faults
        for line in re.split(r"\n(?! )", _describe(fault))
    ]
    return list_faults(lines, what)


def _describe(fault: dict) -> str:
    kind, where, given = fault["type"], _dotted(fault["loc"]), fault["input"]
    if kind == "faults":
        inside = f"{where}." if where else ""
        return "\n".join(f"{inside}{key}: {text}" for key, text in fault["ctx"]["found"])
    if kind == "extra_forbidden":
        return f"{where}: is not a known key; {_nearest(fault['loc'])}"
    if kind == "union_tag_invalid":
        name = given.get("name")
        return f"{where}: there is no solver {name!r}; {_closest(str(name), SOLVERS)}"
    if kind == "union_tag_not_found":
        return f"{where}.name: is missing; it must be one of {', '.join(SOLVERS)}"
    values = {**fault.get("ctx", {}), "input": shown(given)}
    if kind == "too_short" and not given:
        return f"{where}: is empty; give at least {values['min_length']}"
    return f"{where}: {WORDS[kind].format(**values) if kind in WORDS else fault['msg']}"


def _dotted(place: tuple) -> str:
    """Return the path as the file has it: without the solver's tag, which pydantic inserts."""
    parts = [
        _printed(str(part))
        for before, part in zip(("", *place), place, strict=False)
        if not (before == "solver" and part in SOLVERS) and part != "[key]"
    ]
    return ".".join(parts)


def _printed(part: str) -> str:
    """Return a key as a path shows it: in quotes where it could not be seen otherwise."""
    part = part if len(part) <= LONGEST_SHOWN else f"{part[:LONGEST_SHOWN]}..."
    return part if part.isprintable() and part.strip() == part != "" else repr(part)


def _nearest(place: tuple) -> str:
    key = str(place[-1])
    if len(place) == 1 and key in Case.model_fields:
        return f"it belongs to a case: cases: {{mine: {{{key}: ...}}}}"
    return HINTS.get(key) or _closest(key, _model_at(place).model_fields)


def _closest(word: str, known) -> str:
    near = difflib.get_close_matches(word, known, 1, 0.5)
    return f"did you mean {near[0]!r}?" if near else f"known are {', '.join(known)}"


def _model_at(place: tuple) -> type[BaseModel]:
    """Return the model whose keys stand at this place of the configuration.

    Where a value may be of several models, the tag that pydantic inserts says which it is. Names
    of cases and numbers of items lead to no other model.
    """
    models = [Sections]
    for part in place[:-1]:
        tagged = [model for model in models if _tag_of(model) == part]
        fields = [field for model in models if (field := model.model_fields.get(str(part)))]
        models = tagged or (_models_in(fields[0].annotation) if fields else models)
    return models[0]


def _models_in(annotation) -> list[type[BaseModel]]:
    """Return the models that a type is made of: itself, or those of its parts."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for part in get_args(annotation) for model in _models_in(part)]


def _tag_of(model: type[BaseModel]) -> str | None:
    name = model.model_fields.get("name")
    return name.default if name else None
