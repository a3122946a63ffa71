"""Translates generated functions to LLVM's code in one pass over their statements.

numba infers the types of a function by iteration and rewrites its statements many times. Here, a
name has the type of the value that is assigned to it, so one pass suffices. Each operation is
numba's own for these types, so results have the same bits as with numba's compiler.

The language: assignments, `if`, `while`, `for ... in range(...)` or over a tuple, `break`,
`continue`, `return`, and expressions of numbers, vectors, arrays and tuples. A name that branches
or loops assign keeps its type, and a step of `range` that a run computes is positive.
The statements of a translated function are inserted into its caller, and so are those of functions
`inlined_by_llvm` that it calls. Each other compiled function that it calls becomes one function of
LLVM for all its callers.
"""

import ast
import inspect
import linecache
import operator
import secrets
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, partial, reduce
from typing import Any

import numba
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from .array_access import address_of, field_of, view_of
from .inside_numba import Kernel, SubroutineLibrary, context_of_kernels

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
        context, kinds = context_of_kernels(), tuple(map(types.unliteral, arguments))
        name = f"{function.__qualname__}_{secrets.token_hex(8)}"
        library = SubroutineLibrary(context.codegen(), name)
        module = context.create_module(name)
        with context.push_code_library(library):
            written = _Function(function, kinds, name, context, module, {})
        library.add_ir_module(module)
        library.finalize()

        def generate(context, builder, signature, values):
            context.add_linking_libs([library])
            return written.call(builder, values).value

        return written.result(*kinds), generate

    parameters = inspect.signature(function).parameters.values()
    context = inspect.Parameter("typing_context", inspect.Parameter.POSITIONAL_OR_KEYWORD)
    typed.__signature__ = inspect.Signature([context, *parameters])
    typed.__name__ = function.__name__
    translated = intrinsic(typed)
    _TRANSLATED[translated] = function
    return translated


_TRANSLATED: dict[Callable, Callable] = {}
"""The original functions; each key is the function that `in_one_pass` returned."""


class _Function:
    """A function of LLVM, which writes its result to the address in its first argument."""

    def __init__(
        self,
        function: Callable,
        kinds: tuple[types.Type, ...],
        name: str,
        context: Any,
        module: ir.Module,
        known: dict,
    ) -> None:
        """Write the function, for arguments of these types, into the module."""
        self.name, self.context = name, context
        convention = context.call_conv
        plain = convention.get_function_type(types.none, [types.voidptr])
        # numba would pass each length and stride of each array as an argument
        values = map(context.get_value_type, kinds)
        self.type = ir.FunctionType(plain.return_type, [*plain.args, *values])
        place = ir.Function(module, self.type, name)
        builder = ir.IRBuilder(place.append_basic_block("entry"))
        convention.init_call_helper(builder)
        _, _, address, *values = place.args
        translation = _Translation(function, context, builder, known)
        returned = translation.computed(translation.run(map(Value, kinds, values)))
        self.result = returned.type
        if self.result != types.none:
            target = builder.bitcast(address, returned.value.type.as_pointer())
            builder.store(returned.value, target)
        convention.return_value(builder, context.get_dummy_value())

    def call(self, builder: ir.IRBuilder, values: Sequence[ir.Value]) -> Value:
        """Write a call, and return its result."""
        function = cgutils.get_or_insert_function(builder.module, self.type, self.name)
        result = cgutils.alloca_once(builder, self.context.get_value_type(self.result))
        address = builder.bitcast(result, cgutils.voidptr_t)
        nothing = cgutils.alloca_once(builder, self.type.args[0].pointee)
        error = builder.function.args[1]
        code = builder.call(function, (nothing, error, address, *values))
        with cgutils.if_unlikely(builder, builder.icmp_signed("!=", code, code.type(0))):
            builder.ret(code)
        return Value(self.result, builder.load(result))


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
        self.loops: list[tuple[ir.Block, ir.Block]] = []
        self.result: Variable | None = None
        self.end: ir.Block | None = None
        self.changing = _changing_in(self.definition)

    def run(self, arguments: Iterable[Any]) -> Any:
        """Write the function's statements, and return what it returns."""
        parameters = self.definition.args.args
        for parameter, argument in zip(parameters, arguments, strict=True):
            self._assign(ast.Name(parameter.arg), argument)
        *statements, last = self.definition.body
        returns = _returns_of(self.definition)
        if returns == [last]:
            self._write(statements)
            return self._value(last.value)
        if not returns:
            return self._write(self.definition.body)
        self.end = self.builder.append_basic_block("return")
        self._write(self.definition.body)
        self._go_to(self.end)
        self.builder.position_at_end(self.end)
        if self.result:
            return Value(self.result.type, self.builder.load(self.result.address))
        return None

    # --- Statements

    def _write(self, statements: list[ast.stmt]) -> None:
        for statement in statements:
            if self.builder.block.is_terminated:
                return
            match statement:
                case ast.Assign(targets=targets, value=value):
                    result = self._value(value)
                    for target in targets:
                        self._assign(target, result)
                case ast.AugAssign(target=ast.Name(id=name) as target, op=op, value=value):
                    before = self._value(ast.Name(name, ast.Load()))
                    self._assign(target, self._operate(op, before, self._value(value)))
                case ast.AugAssign(target=ast.Subscript() as place, op=op, value=value):
                    array, index = self._value(place.value), self._value(place.slice)
                    result = self._operate(op, self._item(array, index), self._value(value))
                    self._set_item(array, index, result)
                case ast.If(test=test, body=body, orelse=otherwise):
                    self._write_branches(self._test(test), body, otherwise)
                case ast.While(test=test, body=body, orelse=[]):
                    self._write_while(test, body)
                case ast.For(
                    target=target,
                    iter=ast.Call(func=ast.Name("range"), args=bounds),
                    body=body,
                    orelse=[],
                ):
                    self._write_range(target, [self._value(bound) for bound in bounds], body)
                case ast.For(target=target, iter=ast.Tuple(elts=items), body=body, orelse=[]):
                    for item in items:
                        self._assign(target, self._value(item))
                        self._write(body)
                case ast.Return(value=value):
                    self._return(value and self._value(value))
                case ast.Break():
                    self._go_to(self.loops[-1][1])
                case ast.Continue():
                    self._go_to(self.loops[-1][0])
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
                self._set_item(self._value(array), self._value(index), value)
            case ast.Name(id=name) if name in self.changing:
                self.names[name] = self._stored(self.names.get(name), value, name)
            case ast.Name(id=name):
                self.names[name] = value

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

    def _return(self, value: Any) -> None:
        if value is not None:
            self.result = self._stored(self.result, value, "the result")
        self._go_to(self.end)

    def _go_to(self, block: ir.Block, test: Any = True, otherwise: ir.Block | None = None) -> None:
        """Write a jump to a block, or to another one where a test fails."""
        if self.builder.block.is_terminated:
            return
        if isinstance(test, Value):
            self.builder.cbranch(test.value, block, otherwise)
        else:
            self.builder.branch(block if test else otherwise)

    def _write_branches(self, test: Any, body: list[ast.stmt], otherwise: list[ast.stmt]) -> None:
        if not isinstance(test, Value):
            self._write(body if test else otherwise)
            return
        with self.builder.if_else(test.value) as (then, else_):
            with then:
                self._write(body)
            with else_:
                self._write(otherwise)

    def _write_loop(self, body: list[ast.stmt], following: ir.Block, after: ir.Block) -> None:
        """Write the body of a loop; `following` is the block before the next pass."""
        self.loops.append((following, after))
        self._write(body)
        self._go_to(following)
        self.loops.pop()

    def _write_while(self, test: ast.expr, body: list[ast.stmt]) -> None:
        condition, inside, after = map(self.builder.append_basic_block, ("test", "loop", "after"))
        self.builder.branch(condition)
        self.builder.position_at_end(condition)
        self._go_to(inside, self._test(test), after)
        self.builder.position_at_end(inside)
        self._write_loop(body, condition, after)
        self.builder.position_at_end(after)

    def _write_range(self, target: ast.Name, bounds: list[Any], body: list[ast.stmt]) -> None:
        start, stop, step = {1: [0, *bounds, 1], 2: [*bounds, 1], 3: bounds}[len(bounds)]
        falls = isinstance(step, int) and step < 0
        is_unsigned = any(getattr(bound, "type", None) == types.uint64 for bound in bounds)
        kind = types.uint64 if is_unsigned else types.int64
        start, stop, step = (self._converted(bound, kind).value for bound in (start, stop, step))
        before = self.builder.block
        names = "test", "loop", "next", "after"
        condition, inside, following, after = map(self.builder.append_basic_block, names)
        self.builder.branch(condition)
        self.builder.position_at_end(condition)
        index = self.builder.phi(start.type)
        compare = self.builder.icmp_unsigned if is_unsigned else self.builder.icmp_signed
        self.builder.cbranch(compare(">" if falls else "<", index, stop), inside, after)
        self.builder.position_at_end(inside)
        self._assign(target, Value(kind, index))
        self._write_loop(body, following, after)
        self.builder.position_at_end(following)
        index.add_incoming(start, before)
        index.add_incoming(self.builder.add(index, step), following)
        self.builder.branch(condition)
        self.builder.position_at_end(after)

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
        kinds = [getattr(index, "type", types.intp) for index in indices]
        kinds = [
            types.uintp if isinstance(index, int) and index >= 0 else kind
            for index, kind in zip(indices, kinds, strict=True)
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
        written = function.py_func if is_kernel else _TRANSLATED.get(function)
        if written and not (is_kernel and "forceinline" not in function.targetoptions):
            expansion = _Translation(written, self.context, self.builder, self.known)
            return expansion.run(arguments)
        arguments = [self.computed(argument) for argument in arguments]
        kinds = tuple(argument.type for argument in arguments)
        values = [argument.value for argument in arguments]
        if is_kernel:
            return self._function(written, kinds).call(self.builder, values)
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

    def _function(self, written: Callable, kinds: tuple[types.Type, ...]) -> _Function:
        if (written, kinds) not in self.known:
            module = self.builder.module
            name = module.get_unique_name(written.__qualname__)
            function = _Function(written, kinds, name, self.context, module, self.known)
            module.get_global(name).linkage = "internal"
            self.known[written, kinds] = function
        return self.known[written, kinds]


def _is_tuple(value: Any) -> bool:
    return isinstance(value, tuple) or isinstance(getattr(value, "type", None), types.BaseTuple)


def _is_integer(value: Any) -> bool:
    return isinstance(value, int) or isinstance(getattr(value, "type", None), types.Integer)


@cache
def _changing_in(definition: ast.FunctionDef) -> set[str]:
    """Return the names that branches or loops of a function assign, and other statements too."""
    parameters = [parameter.arg for parameter in definition.args.args]
    assigned = [*parameters, *_assigned_in(definition)]
    nested = (node for node in definition.body if hasattr(node, "body"))
    return {name for node in nested for name in _assigned_in(node) if assigned.count(name) > 1}


@cache
def _returns_of(definition: ast.FunctionDef) -> list[ast.Return]:
    return [node for node in ast.walk(definition) if isinstance(node, ast.Return)]


def _assigned_in(node: ast.AST) -> list[str]:
    return [
        name.id
        for name in ast.walk(node)
        if isinstance(name, ast.Name) and isinstance(name.ctx, ast.Store)
    ]
