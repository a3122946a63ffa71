"""The equations of a lattice as one traced function, from which everything else is derived.

A model is a file such as this one (see docs/own_models.md):

    fields = ("u",)
    parameters = {"epsilon": 1.0, "gamma": 0.1}
    def i_dt(p, u):
        return p.epsilon * lap(u) + abs2(u) * u - 1j * p.gamma * u

`i_dt` returns i du_n/dt of each field; `d2_dt2` in its place returns the second derivatives of real
fields. `p` has the parameters, and the time `p.t`. The function is called once, with symbols in
place of numbers, which record each operation in a graph (`symbols`, `graph`).
"""

import inspect
import traceback
from collections.abc import Callable, Iterable, Mapping
from difflib import get_close_matches
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import numpy as np

from .graph import ZERO, Node, derivative, evaluate, leaf, leaves_in, neg, node, number, rebuilt
from .symbols import ModelError, Value, abs2, conj, cos, lap, shift, sin

__all__ = ["Model", "ModelError", "Value", "abs2", "conj", "cos", "lap", "shift", "sin"]


class Model:
    """A traced model: the rates of the real rows of its state, two of each field.

    The rows of a complex field are its real and its imaginary part, those of a field with `d2_dt2`
    its value and its rate. `parameters` holds a number for each name, or a function of an array of
    sites n that returns a number for each (as for disorder). conserved(p, *fields) returns
    densities by name, whose sums over the chain are kept. `text` is the source, for datasets.

    Raises ModelError where the functions cannot be traced.
    """

    def __init__(
        self,
        *,
        fields: Iterable[str],
        parameters: Mapping[str, Any],
        i_dt: Callable | None = None,
        d2_dt2: Callable | None = None,
        conserved: Callable | None = None,
        name: str = "model",
        text: str = "",
    ):
        if (i_dt is None) == (d2_dt2 is None):
            raise ModelError(f"{name} needs one function, i_dt or d2_dt2")
        self.fields = (fields,) if isinstance(fields, str) else tuple(fields)
        self.parameters, self.name, self.in_file = dict(parameters), name, False
        self.second_order = d2_dt2 is not None
        functions = [one for one in (i_dt, d2_dt2, conserved) if one is not None]
        self.text = text or "\n".join(_source_of(function) for function in functions)
        symbols = [
            Value(leaf(c, 0), ZERO if self.second_order else leaf(c, 1))
            for c in range(len(self.fields))
        ]
        self.rates = self._rates_of(self._called(i_dt or d2_dt2, symbols))
        kept = self._called(conserved, symbols) if conserved else {}
        self.conserved = {name: Value.of(density).re for name, density in kept.items()}

    @classmethod
    def read(cls, path: Path | str) -> "Model":
        """Return the model of a file, whose code is run."""
        try:
            text = Path(path).read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise ModelError(f"{path} cannot be read: {error}") from None
        return cls.of_text(Path(path).name, text)

    @classmethod
    @cache
    def of_text(cls, name: str, text: str) -> "Model":
        """Return the model of the text of a file, which is run under that name."""
        given: dict[str, Any] = {}
        try:
            exec(compile(text, name, "exec"), given)
        except Exception as error:
            raise ModelError(_placed(error, name, text)) from None
        absent = [key for key in ("fields", "parameters") if key not in given]
        if absent:
            raise ModelError(f"{name} has no {' and no '.join(absent)}")
        known = ("fields", "parameters", "i_dt", "d2_dt2", "conserved")
        model = cls(**{key: given[key] for key in known if key in given}, name=name, text=text)
        model.in_file = True
        return model

    @property
    def plain(self):
        """What of_text takes by name, if the model has a file; else the model itself."""
        return {"name": self.name, "text": self.text} if self.in_file else self

    # --- The trace

    def _called(self, function: Callable, symbols: list[Value]) -> Any:
        try:
            return function(_Parameters(self.parameters), *symbols)
        except Exception as error:
            place = function.__code__.co_filename
            raise ModelError(_placed(error, place, self.text, self.name)) from None

    def _rates_of(self, returned: Any) -> tuple[Node, ...]:
        """Return the rates of all rows from what `i_dt` or `d2_dt2` returned."""
        found = returned if isinstance(returned, tuple | list) else (returned,)
        found = [Value.of(one) for one in found]
        if len(found) != len(self.fields):
            wrong = f"{len(found)} values for {len(self.fields)} fields"
            raise ModelError(f"{self.name} returns {wrong}")
        if not self.second_order:  # i u' = F: Re u' = Im F and Im u' = -Re F
            return tuple(row for one in found for row in (one.im, neg(one.re)))
        if any(one.im is not ZERO for one in found):
            text = "d2_dt2 returns complex numbers, and its fields are real"
            raise ModelError(f"{self.name}: {text}")
        return tuple(row for c, one in enumerate(found) for row in (leaf(c, 1), one.re))

    # --- What follows from it

    @cached_property
    def reach(self) -> int:
        """How many sites to each side an equation looks."""
        return max(1, *(rate.reach for rate in self.rates))

    @cached_property
    def even(self) -> bool:
        """Whether the equations are the same, to the last bit, with left and right exchanged."""

        def ordered(one: Node, operands: list[Node]) -> Node | None:
            return node("add", *sorted(operands, key=id)) if one.operation == "add" else None

        def reflected(one: Node, operands: list[Node]) -> Node | None:
            if one.operation == "field":
                return leaf(*one.operands[:-1], -one.operands[-1])
            return ordered(one, operands)

        return rebuilt(self.rates, reflected) == rebuilt(self.rates, ordered)

    @cached_property
    def driven(self) -> bool:
        """Whether the equations depend on the time."""
        return bool(leaves_in(self.rates, "time"))

    def rate(self, parameters: Mapping[str, Any], peak: float) -> float:
        """Return a bound of the rates at which fields of the size `peak` turn or grow."""
        given = {name: value for name, value in self.parameters.items() if not callable(value)}
        sizes = {name: float(np.abs(value).max()) for name, value in (given | parameters).items()}

        def size(one: Node) -> float:
            if one.operation == "number":
                return one.operands[0]
            if one.operation == "field":
                return peak
            return sizes.get(one.operands[0], 1.0) if one.operands else 1.0

        rows = np.zeros(len(self.rates))
        for found in leaves_in(self.rates, "field"):
            change = derivative(self.rates, lambda one, found=found: number(one is found))
            rows += np.abs(evaluate(change, size))
        return float(rows.max())

    def tangent(self) -> "Model":
        """Return the model of a solution and a small perturbation of it: twice the fields."""
        count = len(self.fields)

        def change(one: Node) -> Node:
            if one.operation != "field":
                return ZERO
            component, *place = one.operands
            return leaf(component + count, *place)

        other = object.__new__(Model)
        other.__dict__.update(
            fields=(*self.fields, *(f"d{field}" for field in self.fields)),
            parameters=self.parameters,
            name=self.name,
            second_order=self.second_order,
            text=self.text,
            rates=(*self.rates, *derivative(self.rates, change)),
            conserved={},
        )
        return other


class _Parameters:
    """What a model calls `p`."""

    def __init__(self, names: Iterable[str]):
        self._names = list(names)

    def __getattr__(self, name: str) -> Value:
        if name == "t":
            return Value(node("time"))
        if name not in self._names:
            near = get_close_matches(name, self._names, 1)
            hint = f"; did you mean {near[0]!r}?" if near else ""
            raise ModelError(f"there is no parameter {name!r}{hint}")
        return Value(node("parameter", name, 0))


def _source_of(function: Callable) -> str:
    try:
        return inspect.getsource(function)
    except (OSError, TypeError):  # typed where no file keeps it
        return ""


def _placed(error: Exception, place: str, text: str, name: str = "") -> str:
    """Return what is wrong, with the line of the user's file where it is."""
    frames = [one for one in traceback.extract_tb(error.__traceback__) if one.filename == place]
    at = frames[-1].lineno if frames else getattr(error, "lineno", None)
    lines = text.splitlines()
    what = f"{error}" if isinstance(error, ModelError) else f"{type(error).__name__}: {error}"
    if at is None:
        return f"{name or place}: {what}"
    line = frames[-1].line if frames else ""
    line = line or (lines[at - 1] if at <= len(lines) else "")
    return f"{name or place}, line {at}: {what}\n    {line.strip()}"
