"""Error messages of a configuration: all errors at once, each with its path and a hint."""

import difflib
import re
from collections.abc import Collection
from typing import Any, get_args

from pydantic import BaseModel, ValidationError

from .files import ConfigurationError, list_faults
from .solvers import Solvers
from .values import LONGEST_SHOWN, excerpt_of

SOLVERS = tuple(Solvers.model_fields)
HINTS = {
    "N": "the chain has N = 2 half_width + 1 sites: give half_width, or sites in your own models",
    "M": "the half-width M is called half_width",
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
    "int_parsing_size": "is {input}, too large to count with",
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


def configuration_error(
    error: ValidationError, subject: str, root: type[BaseModel], place: tuple = ()
) -> ConfigurationError:
    """Return the exception that lists all errors of `subject`, at the path `place` in `root`."""
    return list_faults(lines_of(error, root, place), subject)


def lines_of(error: ValidationError, root: type[BaseModel], place: tuple = ()) -> list[str]:
    """Return one message per error, each with its path below `place` in the model `root`."""
    faults = [{**fault, "loc": (*place, *fault["loc"])} for fault in error.errors()]
    inside = _dotted(place) + "." if place else ""
    return [  # an indented line quotes the user's file and belongs to the error above it
        line.removeprefix(inside)
        for fault in faults
        for line in re.split(r"\n(?! )", _describe(fault, root))
    ]


def _describe(fault: dict, root: type[BaseModel]) -> str:
    kind, where, raw_value = fault["type"], _dotted(fault["loc"]), fault["input"]
    if kind == "faults":
        inside = f"{where}." if where else ""
        return "\n".join(f"{inside}{key}: {text}" for key, text in fault["ctx"]["found"])
    if kind == "extra_forbidden":
        return f"{where}: is not a known key; {_nearest(fault['loc'], root)}"
    if kind == "union_tag_invalid":
        name = raw_value.get("name")
        return f"{where}: there is no solver {name!r}; {_closest(str(name), SOLVERS)}"
    if kind == "union_tag_not_found":
        return f"{where}.name: is missing; it must be one of {', '.join(SOLVERS)}"
    values = {**fault.get("ctx", {}), "input": excerpt_of(raw_value)}
    if kind == "too_short" and not raw_value:
        return f"{where}: is empty; give at least {values['min_length']}"
    return f"{where}: {WORDS[kind].format(**values) if kind in WORDS else fault['msg']}"


def _dotted(place: tuple) -> str:
    """Return the dotted path as in the file, without the tag that pydantic inserts for solvers."""
    keys = [
        _printed(str(key))
        for before, key in zip(("", *place), place, strict=False)
        if not (before == "solver" and key in SOLVERS) and key != "[key]"
    ]
    return ".".join(keys)


def _printed(key: str) -> str:
    """Return a key for a path: shortened, and in quotes if it has invisible characters."""
    key = key if len(key) <= LONGEST_SHOWN else f"{key[:LONGEST_SHOWN]}..."
    return key if key.isprintable() and key.strip() == key != "" else repr(key)


def _nearest(place: tuple, root: type[BaseModel]) -> str:
    key = str(place[-1])
    if present := getattr(root, "FORMER_KEYS", {}).get(_dotted(place)):
        return f"it is now called {present!r}"
    if len(place) == 1 and key in _keys_at(("cases", "mine", key), root):
        return f"it belongs to a case: cases: {{mine: {{{key}: ...}}}}"
    return HINTS.get(key) or _closest(key, _keys_at(place, root))


def _closest(word: str, known: Collection[str]) -> str:
    near = difflib.get_close_matches(word, known, 1, 0.5)
    return f"did you mean {near[0]!r}?" if near else f"give one of {', '.join(known)}"


def _keys_at(place: tuple, root: type[BaseModel]) -> list[str]:
    """Return the allowed keys at a path of the configuration.

    If a value may have one of several models, the tag that pydantic inserts in the path selects it.
    Names of cases and indices of lists do not change the model.
    """
    models = [root]
    for key in place[:-1]:
        tagged = [model for model in models if _tag_of(model) == key]
        fields = [field for model in models if (field := model.model_fields.get(str(key)))]
        models = tagged or (_models_in(fields[0].annotation) if fields else models)
    fields = models[0].model_fields.items()
    return [key for key, field in fields if field.repr and not field.exclude]


def _models_in(annotation: Any) -> list[type[BaseModel]]:
    """Return the pydantic models in a type: itself, or those among its arguments."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for argument in get_args(annotation) for model in _models_in(argument)]


def _tag_of(model: type[BaseModel]) -> str | None:
    name = model.model_fields.get("name")
    return name.default if name else None
