"""Names of fields and parameters, and the argument `p` from which equations read parameters."""

from collections.abc import Iterable
from difflib import get_close_matches
from keyword import iskeyword
from typing import Any, NoReturn

from .graph import node
from .symbols import ModelError, Value

RESERVED = {
    "model",
    "parameters",
    "half_width",
    "boundary",
    "initial",
    "end_time",
    "output_step",
    "snapshot_step",
    "snapshot_every",
    "snapshots_at",
    "start_time",
    "times",
    "keep",
    "solver",
    "component",
    "member",
}
"""Names forbidden for parameters: keys of a case, and dimensions of its datasets."""
ALL_FIELDS = "pair"
"""The name for all fields together in sweeps; no single field may have it."""


class Parameters:
    """The first argument `p` of a model's functions: its parameters and the time as symbols."""

    no_number = (
        "the first argument of the function is the parameters: write (p, ...) with the fields"
        " after p, p.name for a parameter, and p.t for the time"
    )
    """The error message for arithmetic with `p` itself."""

    def __init__(self, names: Iterable[str]) -> None:
        self._names = list(names)

    def __getattr__(self, name: str) -> Value:
        if name == "t":
            return Value(node("time"))
        if name not in self._names:
            near = get_close_matches(name, self._names, 1)
            hint = f"; did you mean {near[0]!r}?" if near else ""
            raise ModelError(f"there is no parameter {name!r}{hint}")
        return Value(node("parameter", name, 0))

    def __getitem__(self, name: Any) -> NoReturn:
        raise ModelError(f"write p.{name} for the parameter {name!r}")


def require_names(kind: str, names: Iterable[str], model: str) -> tuple[str, ...]:
    """Return the names of fields or parameters; raises ModelError for the first invalid one."""
    if not isinstance(names, Iterable):
        raise ModelError(f"{model}: {kind} is {names!r}; give names, such as ('u',)")
    checked = tuple(names)
    for place, name in enumerate(checked):
        why = None
        if not isinstance(name, str) or not name.isidentifier() or iskeyword(name):
            why = "is not a valid name in Python; write fields = ('u', 'v') for two fields"
            if kind == "parameters":
                why = "is not a valid name in Python; use letters, digits and _"
        elif name.startswith("_"):
            why = "begins with _; remove it"
        elif kind == "parameters" and name == "t":
            why = "is the time, p.t; give the parameter another name, such as J for a hopping rate"
        elif kind == "parameters" and name in RESERVED:
            why = "is a key of a case or a dimension of its datasets; give it another name"
        elif kind == "fields" and name == ALL_FIELDS:
            why = "denotes all fields together in sweeps; give the field another name"
        elif name in checked[:place]:
            why = "is given twice"
        if why:
            raise ModelError(f"{model}: the name {name!r} in {kind} {why}")
    if kind == "fields" and not checked:
        raise ModelError(f"{model}: fields is empty; give the name of a field, such as ('u',)")
    return checked
