"""Expressions of functions that are translated to LLVM's code in one pass: see `one_pass`.

An expression is a `Value`, or a number, function or tuple that is known before the run.
"""

import ast
import operator
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial, reduce
from typing import Any

import numba
from llvmlite import ir
from numba import types
from numba.core import cgutils

from .array_access import address_of, field_of, view_of
from .inside_numba import Kernel

OPERATORS = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
    ast.Pow: operator.pow,
    ast.BitAnd: operator.and_,
    ast.USub: operator.neg,
    ast.Not: operator.not_,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
}
EXTREMES = {min: operator.lt, max: operator.gt}
CONVERSIONS = {int: types.int64, float: types.float64}


TRANSLATED: dict[Callable, Callable] = {}
"""The original functions; each key is the function that `in_one_pass` returned."""


@dataclass(frozen=True)
class Value:
    """A value that is computed at run time."""

    type: types.Type
    value: ir.Value


@dataclass(frozen=True)
class Variable:
    """The memory of a name that is assigned more than once."""

    type: types.Type
    address: ir.Value


class Expressions(ABC):
    """Translation of the expressions of a function; a subclass translates its statements."""

    context: Any
    builder: ir.IRBuilder
    known: dict
    """What was looked up: code of numba for some types, attributes, and translated functions."""
    names: dict[str, Any]
    outside: Mapping[str, Any]
    """Values by name: of the function's own names, and of all others that it reads."""

    @abstractmethod
    def expand(self, function: Callable, arguments: Iterable[Any]) -> Any:
        """Insert the statements of a function, and return what it returns."""

    @abstractmethod
    def call_function(
        self, function: Callable, kinds: tuple[types.Type, ...], values: list[ir.Value]
    ) -> Value:
        """Call a function of LLVM for arguments of these types, which is translated only once."""

    def _stored(self, place: Variable | None, value: Any, name: str) -> Variable:
        """Store a value in memory of its type, which is new if `place` is None."""
        value = self.computed(value)
        if place is None:
            address = cgutils.alloca_once(self.builder, value.value.type)
            place = Variable(value.type, address)
        elif place.type != value.type:
            raise NotImplementedError(f"{name} changes from {place.type} to {value.type}")
        self.builder.store(value.value, place.address)
        return place

    def _value(self, expression: ast.expr) -> Any:
        """Return a `Value`, or a number, function or tuple that is known before the run."""
        match expression:
            case ast.Constant(value=value):
                return value
            case ast.Name(id=name):
                found = self.names[name] if name in self.names else self.outside[name]
                if isinstance(found, Variable):
                    return Value(found.type, self.builder.load(found.address))
                return found
            case ast.Tuple(elts=items):
                return tuple(self._values(items))
            case ast.Attribute(value=owner, attr=name):
                return self._attribute(self._value(owner), name)
            case ast.Subscript(value=items, slice=index):
                return self._item(self._value(items), self._value(index))
            case ast.BinOp(left=first, op=op, right=second):
                return self._operate(op, self._value(first), self._value(second))
            case ast.UnaryOp(op=op, operand=operand):
                return self._operate(op, self._value(operand))
            case ast.Compare(left=value, ops=[ast.In()], comparators=[ast.Tuple(elts=items)]):
                equal = [ast.Compare(value, [ast.Eq()], [item]) for item in items]
                return self._join(ast.Or(), equal)
            case ast.Compare(left=first, ops=[op], comparators=[second]):
                return self._operate(op, self._value(first), self._value(second))
            case ast.Compare(left=first, ops=[op, *ops], comparators=[second, *others]):
                pair = ast.Compare(first, [op], [second]), ast.Compare(second, ops, others)
                return self._join(ast.And(), [*pair])
            case ast.BoolOp(op=op, values=conditions):
                return self._join(op, conditions)
            case ast.IfExp(test=test, body=first, orelse=second):
                return self._choose(self._test(test), first, second)
            case ast.Slice(lower=lower, upper=upper):
                bounds = (bound and self._value(bound) for bound in (lower, upper))
                return self._call(slice, *bounds)
            case ast.Call(
                func=ast.Attribute(value=array, attr="reshape"),
                args=[ast.UnaryOp(op=ast.USub(), operand=ast.Constant(1))],
            ):
                return self._flat(self._value(array))
            case ast.Call(func=function, args=arguments):
                return self._call(self._value(function), *self._values(arguments))
        raise NotImplementedError(ast.unparse(expression))

    def _values(self, expressions: list[ast.expr]) -> Iterator[Any]:
        for expression in expressions:
            if isinstance(expression, ast.Starred):
                yield from self._items(self._value(expression.value))
            else:
                yield self._value(expression)

    def _test(self, expression: ast.expr) -> Any:
        """Return a truth value."""
        value = self._value(expression)
        if isinstance(value, Value) and value.type != types.boolean:
            return self._call(operator.ne, value, 0)
        return value

    def _operate(self, op: ast.AST, *operands: Any) -> Any:
        function = OPERATORS[type(op)]
        if not any(isinstance(operand, Value) for operand in operands):
            return function(*operands)
        return self._call(function, *operands)

    def _join(self, op: ast.boolop, conditions: list[ast.expr]) -> Any:
        """Return whether all or any of some conditions hold; evaluate only those that matter."""
        first, *others = conditions
        value, decides = self._value(first), isinstance(op, ast.Or)
        if not others:
            return value
        if not isinstance(value, Value):
            return value if bool(value) == decides else self._join(op, others)
        place = self._stored(None, value, "a condition")
        with self.builder.if_then(self.builder.not_(value.value) if decides else value.value):
            self._stored(place, self._join(op, others), "a condition")
        return Value(place.type, self.builder.load(place.address))

    def _choose(self, test: Any, first: ast.expr, second: ast.expr) -> Any:
        if not isinstance(test, Value):
            return self._value(first if test else second)
        place = None
        with self.builder.if_else(test.value) as branches:
            for branch, expression in zip(branches, (first, second), strict=True):
                with branch:
                    place = self._stored(place, self._value(expression), "a value")
        return Value(place.type, self.builder.load(place.address))

    def _attribute(self, owner: Any, name: str) -> Any:
        if not isinstance(owner, Value):
            return getattr(owner, name)
        if isinstance(owner.type, types.BaseNamedTuple):
            return self._item(owner, owner.type.fields.index(name))
        if name == "ndim":
            return owner.type.ndim
        if name == "shape" and isinstance(owner.type, types.Array):
            lengths = self._field(owner, name)
            return Value(types.UniTuple(types.intp, owner.type.ndim), lengths)
        if (owner.type, name) not in self.known:
            kind = self.context.typing_context.resolve_getattr(owner.type, name)
            self.known[owner.type, name] = kind, self.context.get_getattr(owner.type, name)
        kind, read = self.known[owner.type, name]
        if isinstance(kind, types.BoundFunction):
            receiver = self.context.cast(self.builder, owner.value, owner.type, kind.this)
            return Value(kind, receiver)
        return Value(kind, read(self.context, self.builder, owner.type, owner.value, name))

    def _item(self, items: Any, index: Any) -> Any:
        if isinstance(index, int):
            if not isinstance(items, Value):
                return items[index]
            if isinstance(items.type, types.BaseTuple):
                kind = items.type.types[index]
                return Value(kind, self.builder.extract_value(items.value, index % len(items.type)))
        indices = self._indices(items, index)
        if not indices:
            return self._call(operator.getitem, items, index)
        address, kind = self._address(items, indices), items.type
        if len(indices) == kind.ndim:
            return Value(kind.dtype, self.context.unpack_value(self.builder, kind.dtype, address))
        return self._view(items, address, kind.ndim - len(indices))

    def _set_item(self, items: Value, index: Any, value: Any) -> None:
        indices = self._indices(items, index)
        if not indices or len(indices) < items.type.ndim:
            self._call(operator.setitem, items, index, value)
            return
        number = self._converted(value, items.type.dtype)
        address = self._address(items, indices)
        self.context.pack_value(self.builder, number.type, number.value, address)

    def _indices(self, items: Any, index: Any) -> tuple:
        """Return the integers that choose an element or row of a contiguous array, else nothing."""
        kind = getattr(items, "type", None)
        if not isinstance(kind, types.Array) or kind.layout != "C":
            return ()
        indices = self._items(index) if _is_tuple(index) else (index,)
        return indices if all(map(_is_integer, indices)) else ()

    def _address(self, array: Value, indices: tuple) -> ir.Value:
        kinds = [
            types.uintp  # counted from the start
            if isinstance(index, int) and index >= 0
            else getattr(index, "type", types.intp)
            for index in indices
        ]
        places = [self._converted(index, types.intp).value for index in indices]
        typed = list(zip(places, kinds, strict=True))
        return address_of(self.context, self.builder, array.type, array.value, typed)

    def _view(self, array: Value, data: ir.Value, dimensions: int) -> Value:
        view = view_of(self.context, self.builder, array.type, array.value, data, dimensions)
        return Value(*view)

    def _flat(self, array: Value) -> Value:
        """Return a contiguous array as one of a single dimension."""
        if array.type.layout != "C":
            raise NotImplementedError(f"reshape(-1) of {array.type}")
        return self._view(array, self._field(array, "data"), 0)

    def _field(self, array: Value, name: str) -> ir.Value:
        return field_of(self.context, self.builder, array.type, array.value, name)

    def _items(self, value: Any) -> tuple:
        """Return the items of a tuple."""
        if isinstance(value, tuple):
            return value
        items = cgutils.unpack_tuple(self.builder, value.value)
        return tuple(map(Value, value.type, items))

    def computed(self, value: Any) -> Value:
        """Return a `Value`; a number or tuple known before the run becomes a constant."""
        if isinstance(value, Value):
            return value
        if isinstance(value, tuple) and not hasattr(value, "_fields"):
            items = [self.computed(item) for item in value]
            kind = types.BaseTuple.from_types([item.type for item in items])
            values = [item.value for item in items]
            return Value(kind, self.context.make_tuple(self.builder, kind, values))
        kind = numba.typeof(value)
        if isinstance(kind, types.Opaque):
            return Value(kind, self.context.get_dummy_value())
        return Value(kind, self.context.get_constant_generic(self.builder, kind, value))

    def _converted(self, value: Any, kind: types.Type) -> Value:
        value = self.computed(value)
        return Value(kind, self.context.cast(self.builder, value.value, value.type, kind))

    def _call(self, function: Any, *arguments: Any) -> Any:
        is_kernel = isinstance(function, Kernel)
        written = function.py_func if is_kernel else TRANSLATED.get(function)
        if written and not (is_kernel and "forceinline" not in function.targetoptions):
            return self.expand(written, arguments)
        arguments = [self.computed(argument) for argument in arguments]
        kinds = tuple(argument.type for argument in arguments)
        values = [argument.value for argument in arguments]
        if is_kernel:
            return self.call_function(written, kinds, values)
        if function in CONVERSIONS and len(arguments) == 1:
            return self._converted(*arguments, CONVERSIONS[function])
        if function in EXTREMES and {*kinds} <= {types.int64, types.float64}:
            kind = types.float64 if types.float64 in kinds else types.int64
            numbers = [self._converted(argument, kind) for argument in arguments]
            return reduce(partial(self._extreme, EXTREMES[function]), numbers)
        signature, write = self._looked_up(function, kinds)
        values = [
            self.context.cast(self.builder, value, kind, wanted)
            for value, kind, wanted in zip(values, kinds, signature.args, strict=True)
        ]
        receiver = [function.value] if isinstance(function, Value) else []
        return Value(signature.return_type, write(self.builder, [*receiver, *values]))

    def _extreme(self, is_beyond: Callable, first: Value, second: Value) -> Value:
        test = self._call(is_beyond, second, first).value
        return Value(first.type, self.builder.select(test, second.value, first.value))

    def _looked_up(self, function: Any, kinds: tuple[types.Type, ...]) -> tuple[Any, Callable]:
        """Return numba's signature and code of a function or method for these types."""
        typing = self.context.typing_context
        is_method = isinstance(function, Value)
        called = function.type if is_method else typing.resolve_value_type(function)
        if (called, kinds) not in self.known:
            signature = typing.resolve_function_type(called, kinds, {})
            self.known[called, kinds] = signature, self.context.get_function(called, signature)
        return self.known[called, kinds]


def _is_tuple(value: Any) -> bool:
    return isinstance(value, tuple) or isinstance(getattr(value, "type", None), types.BaseTuple)


def _is_integer(value: Any) -> bool:
    return isinstance(value, int) or isinstance(getattr(value, "type", None), types.Integer)
