"""Translates generated functions to LLVM's code in one pass over their statements.

numba infers the types of a function by iteration and rewrites its statements many times. Here, a
name has the type of the value that is assigned to it, so one pass suffices. Each operation is
numba's own for these types, so results have the same bits as with numba's compiler.

The language: assignments, `if`, `for ... in range(...)`, and expressions of numbers, vectors,
arrays and tuples. A `return` is the last statement. `and` and `or` evaluate both sides.
A name keeps its type, and a step of `range` that a run computes is positive.
The statements of a translated function are inserted into its caller, and so are those of functions
`inlined_by_llvm` that it calls. If code compiled by numba calls it, it returns nothing.
"""

import ast
import inspect
import linecache
import operator
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

OPERATORS = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
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
TYPES = {bool: types.boolean, int: types.int64, float: types.float64}


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


@cache
def _tree_of(file: str) -> ast.Module:
    return ast.parse("".join(linecache.getlines(file)))


@cache
def _definition_of(function: Callable) -> ast.FunctionDef:
    """Return the syntax tree of a function."""
    code = function.__code__
    for node in ast.walk(_tree_of(code.co_filename)):
        if isinstance(node, ast.FunctionDef):
            lines = [part.lineno for part in (node, *node.decorator_list)]
            if min(lines) == code.co_firstlineno:
                return node
    raise LookupError(f"{function.__qualname__} is not defined in {code.co_filename}")


def in_one_pass(function: Callable) -> Callable:
    """Return a function whose statements become a part of the kernels that call it."""

    def typed(typing_context, *arguments):
        def generate(context, builder, signature, values):
            translation = _Translation(function, context, builder, {})
            translation.run(map(Value, signature.args, values))
            return context.get_dummy_value()

        return types.void(*map(types.unliteral, arguments)), generate

    parameters = inspect.signature(function).parameters.values()
    context = inspect.Parameter("typing_context", inspect.Parameter.POSITIONAL_OR_KEYWORD)
    typed.__signature__ = inspect.Signature([context, *parameters])
    typed.__name__ = function.__name__
    translated = intrinsic(typed)
    _TRANSLATED[translated] = function
    return translated


_TRANSLATED: dict[Callable, Callable] = {}
"""The original functions; each key is the function that `in_one_pass` returned."""


class _Translation:
    """One expansion of a function into the code of a caller."""

    def __init__(
        self, function: Callable, context: Any, builder: ir.IRBuilder, known: dict
    ) -> None:
        self.definition = _definition_of(function)
        self.context, self.builder, self.known = context, builder, known
        self.outside: Mapping[str, Any] = {
            **function.__builtins__,
            **function.__globals__,
            **inspect.getclosurevars(function).nonlocals,
        }
        self.names: dict[str, Any] = {}
        assigned = [
            node.id
            for node in ast.walk(self.definition)
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
        ]
        self.changing = {name for name in assigned if assigned.count(name) > 1}

    def run(self, arguments: Iterable[Any]) -> Any:
        """Write the function's statements, and return what it returns."""
        parameters = [parameter.arg for parameter in self.definition.args.args]
        self.names.update(zip(parameters, arguments, strict=True))
        *statements, last = self.definition.body
        self._write(statements)
        if isinstance(last, ast.Return):
            return self._value(last.value)
        return self._write([last])

    # --- Statements

    def _write(self, statements: list[ast.stmt]) -> None:
        for statement in statements:
            match statement:
                case ast.Assign(targets=[target], value=value):
                    self._assign(target, self._value(value))
                case ast.AugAssign(target=target, op=op, value=value):
                    before = self._value(ast.Name(target.id, ast.Load()))
                    self._assign(target, self._operate(op, before, self._value(value)))
                case ast.If(test=test, body=body, orelse=otherwise):
                    self._write_branches(self._value(test), body, otherwise)
                case ast.For(target=target, iter=ast.Call(args=bounds), body=body):
                    self._write_loop(target, [self._value(bound) for bound in bounds], body)
                case ast.Expr(value=value):
                    self._value(value)
                case ast.Pass():
                    pass
                case _:
                    raise NotImplementedError(ast.unparse(statement))

    def _assign(self, target: ast.expr, value: Any) -> None:
        match target:
            case ast.Tuple(elts=targets):
                for place, item in zip(targets, self._items(value), strict=True):
                    self._assign(place, item)
            case ast.Subscript(value=array, slice=index):
                self._call(operator.setitem, self._value(array), self._value(index), value)
            case ast.Name(id=name) if name in self.changing:
                self._change(name, self._computed(value))
            case ast.Name(id=name):
                self.names[name] = value

    def _change(self, name: str, value: Value) -> None:
        place = self.names.get(name)
        if isinstance(place, Variable) and place.type != value.type:
            raise NotImplementedError(f"{name} changes from {place.type} to {value.type}")
        if not isinstance(place, Variable):
            address = cgutils.alloca_once(self.builder, value.value.type)
            place = self.names[name] = Variable(value.type, address)
        self.builder.store(value.value, place.address)

    def _write_branches(self, test: Any, body: list[ast.stmt], otherwise: list[ast.stmt]) -> None:
        if not isinstance(test, Value):
            self._write(body if test else otherwise)
            return
        with self.builder.if_else(test.value) as (then, else_):
            with then:
                self._write(body)
            with else_:
                self._write(otherwise)

    def _write_loop(self, target: ast.Name, bounds: list[Any], body: list[ast.stmt]) -> None:
        start, stop, step = {1: [0, *bounds, 1], 2: [*bounds, 1], 3: bounds}[len(bounds)]
        limits = [self._computed(bound).value for bound in (start, stop, step)]
        falls = isinstance(step, int) and step < 0
        with cgutils.for_range_slice(self.builder, *limits, inc=not falls) as (index, _):
            self._assign(target, Value(types.int64, index))
            self._write(body)

    # --- Expressions

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
                return tuple(map(self._value, items))
            case ast.Attribute(value=owner, attr=name):
                return self._attribute(self._value(owner), name)
            case ast.Subscript(value=items, slice=index):
                return self._item(self._value(items), self._value(index))
            case ast.BinOp(left=first, op=op, right=second):
                return self._operate(op, self._value(first), self._value(second))
            case ast.UnaryOp(op=op, operand=operand):
                return self._operate(op, self._value(operand))
            case ast.Compare(left=first, ops=[op], comparators=[second]):
                return self._operate(op, self._value(first), self._value(second))
            case ast.BoolOp(op=op, values=conditions):
                join = self.builder.and_ if isinstance(op, ast.And) else self.builder.or_
                total, *others = (self._computed(self._value(a)).value for a in conditions)
                for condition in others:
                    total = join(total, condition)
                return Value(types.boolean, total)
            case ast.IfExp(test=test, body=first, orelse=second):
                return self._choose(self._value(test), first, second)
            case ast.Slice(lower=lower, upper=upper):
                return self._call(slice, self._value(lower), self._value(upper))
            case ast.Call(func=function, args=arguments):
                return self._call(self._value(function), *map(self._value, arguments))
        raise NotImplementedError(ast.unparse(expression))

    def _operate(self, op: ast.AST, *operands: Any) -> Any:
        function = OPERATORS[type(op)]
        if not any(isinstance(operand, Value) for operand in operands):
            return function(*operands)
        return self._call(function, *operands)

    def _choose(self, test: Any, first: ast.expr, second: ast.expr) -> Any:
        if not isinstance(test, Value):
            return self._value(first if test else second)
        ends = []
        with self.builder.if_else(test.value) as branches:
            for branch, expression in zip(branches, (first, second), strict=True):
                with branch:
                    ends.append((self._computed(self._value(expression)), self.builder.block))
        result = self.builder.phi(ends[0][0].value.type)
        for value, block in ends:
            result.add_incoming(value.value, block)
        return Value(ends[0][0].type, result)

    def _attribute(self, owner: Any, name: str) -> Any:
        if not isinstance(owner, Value):
            return getattr(owner, name)
        if isinstance(owner.type, types.BaseNamedTuple):
            return self._items(owner)[owner.type.fields.index(name)]
        if name == "ndim":
            return owner.type.ndim
        kind = self.context.typing_context.resolve_getattr(owner.type, name)
        read = self.context.get_getattr(owner.type, name)
        return Value(kind, read(self.context, self.builder, owner.type, owner.value, name))

    def _item(self, items: Any, index: Any) -> Any:
        if isinstance(index, int) and (
            isinstance(items, tuple) or isinstance(items.type, types.BaseTuple)
        ):
            return self._items(items)[index]
        return self._call(operator.getitem, items, index)

    def _items(self, value: Any) -> tuple:
        """Return the items of a tuple."""
        if isinstance(value, tuple):
            return value
        items = cgutils.unpack_tuple(self.builder, value.value)
        return tuple(map(Value, value.type, items))

    def _computed(self, value: Any) -> Value:
        """Return a `Value`, also for a number or tuple that is known before the run."""
        if isinstance(value, Value):
            return value
        if isinstance(value, tuple):
            items = [self._computed(item) for item in value]
            kind = types.BaseTuple.from_types([item.type for item in items])
            values = [item.value for item in items]
            return Value(kind, self.context.make_tuple(self.builder, kind, values))
        kind = TYPES[type(value)]
        return Value(kind, self.context.get_constant(kind, value))

    def _call(self, function: Callable, *arguments: Any) -> Any:
        if written := _TRANSLATED.get(function) or _inlined_by_llvm(function):
            expansion = _Translation(written, self.context, self.builder, self.known)
            return expansion.run(arguments)
        arguments = [self._computed(argument) for argument in arguments]
        kinds = tuple(argument.type for argument in arguments)
        if function in EXTREMES and kinds == (types.int64, types.int64):
            is_first = self._call(EXTREMES[function], *arguments)
            first, second = (argument.value for argument in arguments)
            return Value(types.int64, self.builder.select(is_first.value, first, second))
        if (function, kinds) not in self.known:
            typing = self.context.typing_context
            function_type = typing.resolve_value_type(function)
            signature = typing.resolve_function_type(function_type, kinds, {})
            write = self.context.get_function(function_type, signature)
            self.known[function, kinds] = signature, write
        signature, write = self.known[function, kinds]
        values = [
            self.context.cast(self.builder, argument.value, argument.type, kind)
            for argument, kind in zip(arguments, signature.args, strict=True)
        ]
        return Value(signature.return_type, write(self.builder, values))


def _inlined_by_llvm(function: Callable) -> Callable | None:
    """Return the Python function of a compiled one that LLVM inlines, None for other functions."""
    options = getattr(function, "targetoptions", {})
    return function.py_func if options.get("forceinline") else None
