"""The function that a rule calls, and its arguments: the named inputs and parameters of the rule.

A rule writes `call=function("package.module.name")`. Each of its named inputs and parameters is an
argument, and the annotation in the function's signature decides what the function gets:

| annotation | the rule gives | the function gets |
| --- | --- | --- |
| `Dataset` | the path of a dataset | the dataset |
| `Problem`, `PaperProblem` | plain values of a problem | the problem |
| a list, sequence or collection of these | a list | a list |
| a mapping to these | paths, or values by name | a dictionary, of datasets by their stems |
| anything else | a path or plain values | the same |

An input without a name is not an argument; the job only waits for it. None and an empty list of
files are omitted if the function has a default.
"""

from collections.abc import Callable, Iterable, Mapping
from difflib import get_close_matches
from importlib import import_module
from inspect import Parameter, signature
from pathlib import Path
from types import NoneType, UnionType
from typing import Any, NamedTuple, Union, get_args, get_origin, get_type_hints

from pendula.sources import SCRIPTS

OF_THE_JOB = ("call", "code", "chunks", "unlike_paper")
"""Names in a rule that are not arguments: the function, a hash of the script, the files of a
study's chunks, and, for figures, the differences of the configuration from the paper's."""


class RuleError(Exception):
    """The names in a rule are not the parameters of the function that it calls."""


class Arguments(NamedTuple):
    """The arguments of a job's function by name, and the names of the datasets that were read."""

    values: dict[str, Any]
    sources: dict[str, list[str]]

    @property
    def settings(self) -> dict[str, Any]:
        """The arguments that are no datasets."""
        return {name: value for name, value in self.values.items() if name not in self.sources}


def function_of(call: list[str]) -> Callable:
    """Return the function that a rule calls; `call` is its dotted name and a hash of its code."""
    module, _, name = call[0].rpartition(".")
    return getattr(import_module(module), name)


def gather_for(draw: Callable) -> Callable:
    """Return gather_x of the module of draw_x, which returns the data of the figure."""
    topic = draw.__name__.removeprefix("draw")
    return getattr(import_module(draw.__module__), f"gather{topic}")


def load_arguments(function: Callable, job: Any, kinds: Mapping[type, Callable]) -> Arguments:
    """Return the arguments of `function` from the named inputs, outputs and parameters of a job.

    `kinds` maps types of annotations to functions that load them from a path or from plain values.
    Named outputs are arguments too. Raises RuleError if a name is unknown, missing or given twice.
    """
    rule_values = _named(function, job)
    hints = get_type_hints(function)
    values, sources = {}, {}
    for name, value in rule_values.items():
        container, kind = _kind_of(hints.get(name))
        located = locate(value)
        values[name] = _load(located, container, kinds[kind]) if kind in kinds else located
        if kind in kinds and (paths := _paths_in(located)):
            sources[name] = [name_of(path) for path in paths]
    return Arguments(values, sources)


def _named(function: Callable, job: Any) -> dict[str, Any]:
    """Return the rule's values for the function's parameters, by name, after a check."""
    parameters = signature(function).parameters
    places = [dict(place.items()) for place in (job.input, job.params, job.output)]
    values: dict[str, Any] = {}
    for place in places:
        for name, value in place.items():
            if name in OF_THE_JOB:
                continue
            if name in values:
                raise RuleError(f"{_rule(job)} gives {name!r} twice, as an input and a parameter")
            if not (_is_left_out(value) and _has_default(parameters.get(name))):
                values[name] = value
    check_names(function, values, _rule(job))
    return values


def check_names(function: Callable, names: Iterable[str], rule: str) -> None:
    """Raise RuleError unless `names` are parameters of `function`, and all that it requires."""
    parameters = signature(function).parameters
    called = f"{function.__module__}.{function.__name__}"
    parameter_list = f"it takes {', '.join(parameters)}" if parameters else "it takes none"
    for name in names:
        if name not in parameters:
            near = get_close_matches(name, parameters, 1)
            meant = f"; did you mean {near[0]!r}?" if near else ""
            raise RuleError(f"{rule}: {called} has no parameter {name!r}{meant} ({parameter_list})")
    required = [name for name, parameter in parameters.items() if not _has_default(parameter)]
    if missing := [name for name in required if name not in names]:
        raise RuleError(f"{rule} does not give {', '.join(missing)}, which {called} requires")


def _is_left_out(value: Any) -> bool:
    return value is None or value == []


def _has_default(parameter: Parameter | None) -> bool:
    return parameter is not None and parameter.default is not Parameter.empty


def _rule(job: Any) -> str:
    return f"rule {job.rule}"


def _kind_of(hint: Any) -> tuple[str, Any]:
    """Return the container of an annotation, "none", "list" or "mapping", and its values' type."""
    if get_origin(hint) in (Union, UnionType):
        hint = next(alternative for alternative in get_args(hint) if alternative is not NoneType)
    origin, inner = get_origin(hint), get_args(hint)
    if not isinstance(origin, type) or not inner:
        return "none", hint
    if issubclass(origin, Mapping):
        return "mapping", inner[1]
    return "list", inner[0]


def _load(value: Any, container: str, make: Callable) -> Any:
    """Apply `make` to each value, and return the results in the container."""
    if value is None or container == "none":
        return value if value is None else make(value)
    if isinstance(value, Mapping):
        return {name: make(entry) for name, entry in value.items()}
    entries = value if isinstance(value, list) else [value]
    if container == "mapping":
        return {Path(path).stem: make(path) for path in entries}
    return [make(entry) for entry in entries]


def _paths_in(value: Any) -> list[str]:
    """Return the paths in an argument, or no paths if it consists of plain values."""
    entries = value if isinstance(value, list) else [value]
    return entries if all(isinstance(entry, str) for entry in entries) else []


COMMITTED = "committed"
"""Key of the path of a file of the project, in a parameter that also has its digest."""


def locate(value: Any) -> Any:
    """Return a rule's value with each `committed` entry replaced by the file's absolute path."""
    if isinstance(value, Mapping) and COMMITTED in value:
        return str(SCRIPTS.parent / value[COMMITTED])
    return [locate(entry) for entry in value] if isinstance(value, list) else value


def name_of(path: str) -> str:
    """Return the name of a dataset: its path below the results or below the project's folder."""
    place = Path(path).with_suffix("")
    if place.is_relative_to(SCRIPTS.parent):
        return place.relative_to(SCRIPTS.parent).as_posix()
    return Path(*place.parts[1:]).as_posix()
