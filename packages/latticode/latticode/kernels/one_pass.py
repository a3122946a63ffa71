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
import secrets
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from .expressions import TRANSLATED, Expressions, Value, Variable
from .inside_numba import SubroutineLibrary, context_of_kernels


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
    TRANSLATED[translated] = function
    return translated


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


class _Translation(Expressions):
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

    # --- Functions

    def expand(self, function: Callable, arguments: Iterable[Any]) -> Any:
        """Insert the statements of a function, and return what it returns."""
        return _Translation(function, self.context, self.builder, self.known).run(arguments)

    def call_function(
        self, function: Callable, kinds: tuple[types.Type, ...], values: list[ir.Value]
    ) -> Value:
        """Call a function of LLVM for arguments of these types, which is translated only once."""
        if (function, kinds) not in self.known:
            module = self.builder.module
            name = module.get_unique_name(function.__qualname__)
            written = _Function(function, kinds, name, self.context, module, self.known)
            module.get_global(name).linkage = "internal"
            self.known[function, kinds] = written
        return self.known[function, kinds].call(self.builder, values)


@cache
def _changing_in(definition: ast.FunctionDef) -> set[str]:
    """Return the names that branches or loops of a function assign, and that need memory.

    These are the names that are also assigned elsewhere, or read after the branch or loop.
    """
    parameters = [parameter.arg for parameter in definition.args.args]
    assigned, read = (
        [*parameters, *_names_in(definition, ast.Store)],
        _names_in(definition, ast.Load),
    )
    changing = set()
    for node in definition.body:
        if hasattr(node, "body"):
            inside = _names_in(node, ast.Load)
            for name in _names_in(node, ast.Store):
                if assigned.count(name) > 1 or read.count(name) > inside.count(name):
                    changing.add(name)
    return changing


@cache
def _returns_of(definition: ast.FunctionDef) -> list[ast.Return]:
    return [node for node in ast.walk(definition) if isinstance(node, ast.Return)]


def _names_in(node: ast.AST, use: type[ast.expr_context]) -> list[str]:
    """Return the names that a statement assigns (ast.Store) or reads (ast.Load), in any order."""
    return [
        name.id
        for name in ast.walk(node)
        if isinstance(name, ast.Name) and isinstance(name.ctx, use)
    ]
