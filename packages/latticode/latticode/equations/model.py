"""A model: the equations of a lattice. All kernels are derived from their trace.

A model is a Python file such as this one (see docs/own_models.md):

    fields = ("u",)
    parameters = {"epsilon": 1.0, "gamma": 0.1}
    def i_dt(p, u):
        return p.epsilon * lap(u) + abs2(u) * u - 1j * p.gamma * u

`i_dt` returns i du_n/dt of each complex field. For real fields, write `dt`, which returns dx_n/dt,
or `d2_dt2`, which returns d^2 x_n/dt^2 and may take the velocities after the fields:
d2_dt2(p, x, v) or d2_dt2(p, x, y, vx, vy). `p` has the parameters and the time `p.t`. The function
is called with symbols instead of numbers; they record each operation in a graph (`symbols`,
`graph`).
"""

import inspect
import json
from collections.abc import Callable, Iterable, Mapping
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import numpy as np

from .couplings import entries_of
from .graph import (
    LEAVES,
    MOTION,
    ZERO,
    Node,
    derivative,
    in_order,
    leaf,
    leaves_in,
    neg,
    node,
    number,
)
from .model_file import BEFORE, SEED, placed, run_file, same, values_at
from .names import Parameters, require_names
from .rate_bounds import Slopes, bound_rates, slopes_of
from .rate_properties import (
    are_even,
    continue_real_equations,
    stay_at_rest,
    vanishes,
    why_no_series,
)
from .symbols import ModelError, Value, abs2, conj, cos, exp, lap, log, shift, sin, sqrt

__all__ = [
    "Model",
    "ModelError",
    "Value",
    "abs2",
    "conj",
    "cos",
    "exp",
    "lap",
    "log",
    "shift",
    "sin",
    "sqrt",
]


FORMS = ("i_dt", "dt", "d2_dt2")
"""The names of the functions that define the equations; a model has exactly one of them."""


class Model:
    """The traced equations of a lattice.

    fields: the names of the fields.
    parameters: a default for each name: a number, a number for each site, or a function that
        returns either for the array of sites n (for disorder).
    i_dt, dt, d2_dt2: the equations; exactly one of the three functions described in this module.
    conserved: a function (p, *fields) that returns densities by name; runs record their sums over
        the chain.
    text: the source code, which datasets store.

    The state has two real rows for each field: real and imaginary part (`i_dt`), value and velocity
    (`d2_dt2`), or value and zero (`dt`). `rates` are the time derivatives of these rows.

    Raises ModelError if a function cannot be traced.
    """

    def __init__(
        self,
        *,
        fields: Iterable[str],
        parameters: Mapping[str, Any],
        i_dt: Callable | None = None,
        dt: Callable | None = None,
        d2_dt2: Callable | None = None,
        conserved: Callable | None = None,
        name: str = "model",
        text: str = "",
    ) -> None:
        equations = dict(zip(FORMS, (i_dt, dt, d2_dt2), strict=True))
        forms = [form for form, function in equations.items() if function is not None]
        if len(forms) != 1:
            raise ModelError(f"{name} needs exactly one of the functions i_dt, dt and d2_dt2")
        self.fields = require_names(
            "fields", (fields,) if isinstance(fields, str) else fields, name
        )
        if not isinstance(parameters, Mapping):
            raise ModelError(f"{name}: parameters must be a dictionary of names and values")
        require_names("parameters", parameters, name)
        self.parameters, self.name = dict(parameters), name
        self.form = forms[0]
        functions = [equations[self.form], *([conserved] if conserved else [])]
        self.text = text or "\n".join(_source_of(function) for function in functions)
        self.rates = self._twice(equations[self.form], self._rates_of)
        self._require_real_fields_to_move()
        self.conserved = self._twice(conserved, self._densities) if conserved else {}
        self._require_matrices_apart()

    @classmethod
    def read(cls, path: Path | str) -> "Model":
        """Return the model defined by a Python file.

        The file is executed twice and must define the same equations and values both times. It can
        import modules in its folder, and `__file__` is its path. Raises ModelError if the file
        cannot be read, fails, or defines no model.
        """
        path = Path(path)
        try:
            text = path.read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            why = getattr(error, "strerror", None) or "it is not UTF-8 text"
            raise ModelError(f"{path} cannot be read: {why}") from None
        model, reread = (cls._of_run(run_file(path, text), path.name, text) for _ in range(2))
        if reread.plain["nodes"] != model.plain["nodes"]:
            raise ModelError(f"{path.name} gives different equations each time. {SEED}")
        for name, value in model.parameters.items():
            if not (callable(value) or same(value, reread.parameters.get(name))):
                raise ModelError(f"{path.name} gives {name} a different value each time. {SEED}")
        return model

    @classmethod
    def _of_run(cls, namespace: Mapping[str, Any], name: str, text: str) -> "Model":
        """Return the model defined by the namespace of an executed file."""
        absent = [key for key in ("fields", "parameters") if key not in namespace]
        if absent:
            raise ModelError(f"{name} has no {' and no '.join(absent)}")
        known = ("fields", "parameters", *FORMS, "conserved")
        return cls(
            **{key: namespace[key] for key in known if key in namespace}, name=name, text=text
        )

    @cached_property
    def plain(self) -> dict[str, Any]:
        """The model as plain values, from which `of_plain` restores it without running its code."""
        roots = (*self.rates, *self.conserved.values())
        order = in_order(roots)
        place = {entry: i for i, entry in enumerate(order)}
        count = len(self.rates)
        at = [place[entry] for entry in roots]
        return {
            "name": self.name,
            "text": self.text,
            "fields": list(self.fields),
            "form": self.form,
            "nodes": [
                [entry.operation, *(place[a] for a in entry.inputs)]
                if entry.inputs
                else [entry.operation, *entry.operands]
                for entry in order
            ],
            "rates": at[:count],
            "conserved": dict(zip(self.conserved, at[count:], strict=True)),
        }

    @classmethod
    def of_plain(cls, values: Mapping[str, Any]) -> "Model":
        """Return the model of `plain` values, without parameters; a problem supplies these."""
        return _of_json(json.dumps(values))

    # --- The trace

    def _called(self, function: Callable) -> Any:
        """Return the result of a model function called with symbols for fields and velocities."""
        values = [
            Value(leaf(c, 0), ZERO if self.real else leaf(c, 1)) for c in range(len(self.fields))
        ]
        velocities = [Value(leaf(c, 1)) for c in range(len(self.fields))]
        known = [values, values + velocities] if self.second_order else [values]
        symbols = next((names for names in known if _accepts(function, 1 + len(names))), None)
        if symbols is None:
            named = ", ".join(("p", *self.fields))
            more = f", or ({named}, and a velocity of each)" * self.second_order
            raise ModelError(f"{self.name}: {function.__name__} must take ({named}){more}")
        try:
            return function(Parameters(self.parameters), *symbols)
        except Exception as error:
            place = function.__code__.co_filename
            raise ModelError(placed(error, place, self.text, self.name)) from None

    def __repr__(self) -> str:
        values = [
            f"{name} = {'a function of the sites' if callable(value) else values_shown(value)}"
            for name, value in self.parameters.items()
        ]
        head = f"Model {self.name}: fields {', '.join(self.fields)}"
        lines = self.text.strip().splitlines()
        text = [*lines[:MOST_SHOWN], *["..."][: len(lines) > MOST_SHOWN]]
        return "\n    ".join(["; ".join([head, *values]), *text])

    def trace(self, function: Callable) -> Node:
        """Return the node of a real function of (p, *fields), which may also take the velocities.

        Raises ModelError if it cannot be traced, is complex, or depends on no field.
        """

        def real_node(returned: Any) -> Node:
            value = Value.of(returned)
            if not vanishes(value.im):
                raise ModelError(f"{function.__name__} returns a complex number; give a real one")
            if value.re.level != MOTION:
                raise ModelError(f"{function.__name__} depends on no field")
            if leaves_in([value.re], "matrix"):
                raise ModelError(f"{function.__name__} uses couple(p.W, u): only rates may do so")
            return value.re

        return self._twice(function, real_node)

    def _twice(self, function: Callable, nodes_of: Callable) -> Any:
        """Return nodes_of(result) for a function of the model, traced twice.

        Raises ModelError if the traces differ, for example because the function draws random
        numbers or counts its calls. Datasets would not record such values.
        """
        nodes, retraced = (nodes_of(self._called(function)) for _ in range(2))
        if retraced != nodes:
            name = function.__name__
            raise ModelError(f"{self.name}: {name} gives different equations each time. {BEFORE}")
        return nodes

    def _rates_of(self, returned: Any) -> tuple[Node, ...]:
        """Return the rates of all rows from the result of `i_dt`, `dt` or `d2_dt2`."""
        if returned is None:
            raise ModelError(f"{self.name}: {self.form} returns nothing; add a return statement")
        values = returned if isinstance(returned, tuple | list) else (returned,)
        values = [Value.of(value) for value in values]
        if len(values) != len(self.fields):
            wrong = f"{len(values)} values for {len(self.fields)} fields"
            raise ModelError(f"{self.name} returns {wrong}")
        if not self.real:  # i u' = F: Re u' = Im F and Im u' = -Re F
            return tuple(row for value in values for row in (value.im, neg(value.re)))
        if any(value.im is not ZERO for value in values):
            text = f"{self.form} returns complex numbers, but its fields are real"
            raise ModelError(f"{self.name}: {text}")
        if self.form == "dt":
            return tuple(row for value in values for row in (value.re, ZERO))
        return tuple(row for c, value in enumerate(values) for row in (leaf(c, 1), value.re))

    def _require_real_fields_to_move(self) -> None:
        """Raise ModelError if `i_dt` lacks the factor 1j in the rate of a real field.

        Without this factor the real part never changes, although the equations read only this part.
        """
        read = {entry.operands[:2] for entry in leaves_in(self.rates, "field")}
        for c, field in enumerate(self.fields if self.form == "i_dt" else ()):
            real, imaginary = self.rates[2 * c : 2 * c + 2]
            read_alone = (c, 0) in read and (c, 1) not in read
            if read_alone and vanishes(real) and not vanishes(imaginary):
                raise ModelError(
                    f"{self.name}: i_dt changes only the imaginary part of {field}, which no"
                    f" equation reads; if {field} is real, define dt instead, which returns"
                    f" d{field}/dt, or multiply this rate by 1j"
                )

    def _require_matrices_apart(self) -> None:
        """Raise ModelError if a parameter is used both as a matrix and as a number."""
        nodes = (*self.rates, *self.conserved.values())
        if leaves_in(self.conserved.values(), "matrix"):
            raise ModelError(f"{self.name}: conserved uses couple(p.W, u): only rates may do so")
        numbers = {parameter.operands[0] for parameter in leaves_in(nodes, "parameter")}
        for name in sorted(self.matrices & numbers):
            text = f"p.{name} is a matrix in couple(p.{name}, u) and a number elsewhere"
            raise ModelError(f"{self.name}: {text}; use two parameters")

    def _densities(self, returned: Any) -> dict[str, Node]:
        """Return the real densities by name from the result of `conserved`."""
        if not isinstance(returned, Mapping):
            text = 'conserved must return a dictionary of densities, such as {"P": abs2(u)}'
            raise ModelError(f"{self.name}: {text}")
        densities = {}
        for name, returned_value in returned.items():
            density = Value.of(returned_value)
            description = f"{self.name}: the density {name!r} in conserved"
            if not vanishes(density.im):
                raise ModelError(f"{description} is complex; give its real part, (...).real")
            if leaves_in([density.re], "time"):
                raise ModelError(f"{description} depends on the time p.t, so it is not conserved")
            if density.re.level != MOTION:
                raise ModelError(f"{description} depends on no field")
            densities[str(name)] = density.re
        return densities

    # --- Properties of the equations

    @property
    def real(self) -> bool:
        """Whether the fields are real numbers."""
        return self.form != "i_dt"

    @property
    def second_order(self) -> bool:
        """Whether the equations are of second order in time."""
        return self.form == "d2_dt2"

    @cached_property
    def matrices(self) -> frozenset[str]:
        """The names of the parameters that are coupling matrices."""
        return frozenset(leaf.operands[0] for leaf in leaves_in(self.rates, "matrix"))

    def value_at(self, name: str, value: Any, sites: range) -> Any:
        """Return a parameter on the sites of a chain: a number, a list (site,), or `Entries`.

        Raises ValueError if the value does not fit; callers put "parameter W" before the message.
        """
        return entries_of(value, sites) if name in self.matrices else values_at(value, sites)

    @cached_property
    def farthest(self) -> int:
        """The distance in sites to the farthest neighbour in an equation or a density."""
        return max(entry.reach for entry in (*self.rates, *self.conserved.values()))

    @cached_property
    def reach(self) -> int:
        """The number of neighbours on each side that the equations read, at least 1."""
        return max(1, *(rate.reach for rate in self.rates))

    @cached_property
    def reach_of_densities(self) -> int:
        """The number of neighbours on each side that a conserved density reads, at least 1."""
        return max((1, *(density.reach for density in self.conserved.values())))

    @cached_property
    def even(self) -> bool:
        """Whether exchanging left and right changes no bit of the rates."""
        # the symmetry of a matrix depends on its values
        return not self.matrices and are_even(self.rates)

    @cached_property
    def separable(self) -> bool:
        """Whether the equations are of second order with forces independent of velocities."""
        leaves = leaves_in(self.rates[1::2], "field")
        return self.second_order and not any(entry.operands[1] for entry in leaves)

    @cached_property
    def without_imaginary_parts(self) -> tuple[str, ...]:
        """The complex fields with imaginary parts that never change and that no equation reads."""
        read = {entry.operands[:2] for entry in leaves_in(self.rates, "field")}
        if self.form == "d2_dt2":
            return ()
        return tuple(
            field
            for c, field in enumerate(self.fields)
            if (c, 1) not in read and vanishes(self.rates[2 * c + 1])
        )

    @cached_property
    def continues_real_equations(self) -> bool:
        """Whether `i_dt` only extends equations of real fields, such as x' = x y."""
        return not self.real and continue_real_equations(self.rates)

    @cached_property
    def driven(self) -> bool:
        """Whether the equations depend on the time."""
        return bool(leaves_in(self.rates, "time"))

    @cached_property
    def stays_at_rest(self) -> bool:
        """Whether a chain with all fields zero stays so."""
        return stay_at_rest(self.rates)

    @cached_property
    def why_no_series(self) -> str:
        """The reason why solutions have no power series, "" if they have one."""
        return why_no_series(self.rates)

    def rates_at(self, parameters: Mapping[str, Any], *peaks: float) -> list[float]:
        """Return upper bounds of the rate, per unit time, at which fields rotate or grow.

        Each is for one of the largest amplitudes `peaks`. At a peak of 0, infinite derivatives are
        ignored, for example the derivative of sqrt.
        """
        defaults = {name: value for name, value in self.parameters.items() if not callable(value)}
        return bound_rates(len(self.rates), self._slopes, defaults | parameters, peaks)

    @cached_property
    def _slopes(self) -> Slopes:
        return slopes_of(self.rates)

    def tangent(self) -> "Model":
        """Return the model with the fields of a tangent vector after the fields of a solution."""
        count = len(self.fields)

        def change(entry: Node) -> Node:
            if entry.operation != "field":
                return ZERO
            component, *place = entry.operands
            return leaf(component + count, *place)

        tangent = object.__new__(Model)
        tangent.__dict__.update(
            fields=(*self.fields, *(f"d{field}" for field in self.fields)),
            parameters=self.parameters,
            name=self.name,
            form=self.form,
            text=self.text,
            rates=(*self.rates, *derivative(self.rates, change)),
            conserved={},
        )
        return tangent


MOST_SHOWN = 20
"""The number of lines of source code in the repr of a model."""


def values_shown(value: Any) -> str:
    """Return the text of a parameter's value in the repr of a model."""
    return f"{value}" if np.ndim(value) == 0 else f"{len(value)} values"


@cache
def _of_json(text: str) -> Model:
    values, nodes = json.loads(text), []
    for operation, *operands in values["nodes"]:
        if operation not in LEAVES:
            operands = [nodes[i] for i in operands]
        nodes.append(number(*operands) if operation == "number" else node(operation, *operands))
    model = object.__new__(Model)
    model.__dict__.update(
        fields=tuple(values["fields"]),
        parameters={},
        name=values["name"],
        form=values["form"],
        text=values["text"],
        rates=tuple(nodes[i] for i in values["rates"]),
        conserved={name: nodes[i] for name, i in values["conserved"].items()},
    )
    return model


def _accepts(function: Callable, count: int) -> bool:
    """Return whether a function can be called with `count` positional arguments."""
    try:
        inspect.signature(function).bind(*range(count))
    except TypeError:
        return False
    return True


def _source_of(function: Callable) -> str:
    try:
        return inspect.getsource(function)
    except (OSError, TypeError):  # typed at a prompt: no source file
        return ""
