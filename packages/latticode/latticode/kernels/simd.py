"""Vectors of eight doubles in compiled code: each holds the numbers of eight neighbouring sites.

Operations. A `Vector` is eight doubles in a vector register. These are its lanes, numbered 0 to 7.
`load` and `store` move a vector between a register and an array, and `fill` repeats one number.
+ - * / and unary - work lane by lane. `left_neighbours` and `right_neighbours` shift lanes, so that
each site gets its neighbour's number. `keep_lanes` replaces the lanes after the last site,
`zero_below` replaces tiny numbers, and `larger_magnitude` and `largest_lane` find the largest
absolute value. A `VectorView` gives access to a state (row, column) by vectors: `view[row, j]`
reads or writes the vector that begins at column j. A formula in `y[row, j]` is thus written once:
it computes one site if `y` is the array, and eight sites if `y` is the view.

Why eight. A processor with AVX-512 operates on eight doubles in one instruction. For AVX2, LLVM
generates two independent instructions. These gain a little speed on long rows, and lose a little on
rows of few vectors.

Why not LLVM's auto-vectoriser. It vectorises a loop over sites only if it can prove that arrays do
not overlap. It keeps the partial sums of a nested loop, such as a Cauchy product over orders of a
power series, in memory instead of registers. It computes the last sites of a row, up to fifteen,
one by one; in the paper's half chain these are half of all sites. The speed of a kernel written
with vectors does not depend on what the compiler can prove.

Bits. Each lane executes the IEEE operations of one site in the order written. No operation has a
fast-math flag, so LLVM neither reorders them nor contracts them to fused multiply-adds. Results
have the same bits with one site or eight at a time, and on any processor. For a processor with
shorter vectors, LLVM splits each operation into several.

Why magnitudes are compared as integers. Without their sign bits, doubles read as integers are in
the order of their values, and NaN comes after infinity. A maximum of such integers never loses a
NaN; a floating-point maximum may. LLVM may reorder and thus vectorise the integer comparisons.

Dependencies: `numba.extending`, `numba.types`, and the functions of `numba.core.cgutils` that
numba's guide to extensions uses. Arrays must be contiguous with the last index fastest, and bounds
are not checked. `llvmlite.ir` is public but follows LLVM: the `bitcast` to a typed pointer before
each load or store was needed before LLVM had opaque pointers. If an upgrade of numba breaks an
operation, tests/kernels/test_simd.py names it. tests/test_same_bits.py detects a changed order of
operations.
"""

import operator
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import (
    intrinsic,
    lower_builtin,
    make_attribute_wrapper,
    models,
    register_model,
    type_callable,
)

from .array_access import field_of
from .compiled import kernel

LANES = 8
"""Numbers in a vector: 512 bits, the width of AVX-512."""

VECTOR = ir.VectorType(ir.DoubleType(), LANES)
INT64 = ir.IntType(64)
BITS = ir.VectorType(INT64, LANES)
LANE = ir.IntType(32)
Type, Value, Builder = types.Type, ir.Value, ir.IRBuilder
Values = Sequence[Value]
Generated = tuple[Any, Callable]
"""A signature, and the function that generates the code."""
MAGNITUDE = 0x7FFF_FFFF_FFFF_FFFF
"""All bits of a double except its sign."""


# --- The type; loads and stores -----------------------------------------------------------------


class Vector(types.Type):
    """The type of eight doubles in a register; there are no arrays of vectors."""

    def __init__(self) -> None:
        super().__init__("Vector")


vector = Vector()


@register_model(Vector)
class VectorModel(models.PrimitiveModel):
    def __init__(self, manager: Any, fe_type: Type) -> None:
        super().__init__(manager, fe_type, VECTOR)


def constant(kind: ir.Type, values: Iterable) -> ir.Constant:
    return ir.Constant(ir.VectorType(kind, LANES), list(values))


def address_in_array(
    context: Any, builder: Builder, array_type: Type, array: Value, index: Value
) -> Value:
    """Return the address of the vector that starts at the flat `index` of an array."""
    data = field_of(context, builder, array_type, array, "data")
    return builder.bitcast(builder.gep(data, [index]), VECTOR.as_pointer())


def repeat(builder: Builder, number: Value) -> Value:
    """Return a vector with a double or an integer in all lanes."""
    nothing = ir.Constant(ir.VectorType(number.type, LANES), ir.Undefined)
    first_lane = builder.insert_element(nothing, number, LANE(0))
    return builder.shuffle_vector(first_lane, nothing, constant(LANE, [0] * LANES))


def as_vectors(builder: Builder, signature: Any, arguments: Values) -> list[Value]:
    """Return the arguments as vectors; a number is repeated in all lanes."""
    typed = zip(signature.args, arguments, strict=True)
    return [value if kind == vector else repeat(builder, value) for kind, value in typed]


@intrinsic
def fill(typing_context: Any, number: Type) -> Generated:
    """Return a vector with the number in all lanes; a vector is returned as it is."""

    def generate(context: Any, builder: Builder, signature: Any, arguments: Values) -> Value:
        return as_vectors(builder, signature, arguments)[0]

    return vector(vector if number == vector else types.float64), generate


@intrinsic
def fill_from(typing_context: Any, array: Type, index: Type) -> Generated:
    """Return a vector with the number at the flat `index` of a contiguous array in all lanes.

    The index must not be negative, unlike that of `array[index]`: this saves four instructions.
    """

    def generate(context: Any, builder: Builder, signature: Any, arguments: Values) -> Value:
        data = field_of(context, builder, signature.args[0], arguments[0], "data")
        return repeat(builder, builder.load(builder.gep(data, [arguments[1]])))

    return vector(array, types.intp), generate


@intrinsic
def load(typing_context: Any, array: Type, index: Type) -> Generated:
    """Return the vector at the flat `index` of a contiguous array; bounds are not checked."""

    def generate(context: Any, builder: Builder, signature: Any, arguments: Values) -> Value:
        place = address_in_array(context, builder, signature.args[0], *arguments)
        return builder.load(place, align=8)

    return vector(array, types.intp), generate


@intrinsic
def store(typing_context: Any, array: Type, index: Type, value: Type) -> Generated:
    """Write a vector at the flat `index` of a contiguous array; bounds are not checked."""

    def generate(context: Any, builder: Builder, signature: Any, arguments: Values) -> Value:
        array, index, value = arguments
        place = address_in_array(context, builder, signature.args[0], array, index)
        builder.store(value, place, align=8)
        return context.get_dummy_value()

    return types.void(array, types.intp, vector), generate


# --- Arithmetic, lane by lane -------------------------------------------------------------------


def define_operator(symbol: Callable, instruction: str) -> None:
    """Define an operator on two vectors, or on a vector and a number, by an LLVM instruction."""

    @type_callable(symbol)
    def type_of_result(context: Any) -> Callable:
        def typed(first: Type, second: Type) -> Type | None:
            known = {first, second} <= {vector, types.float64} and vector in (first, second)
            return vector if known else None

        return typed

    @lower_builtin(symbol, vector, vector)
    @lower_builtin(symbol, types.float64, vector)
    @lower_builtin(symbol, vector, types.float64)
    def generate(context: Any, builder: Builder, signature: Any, arguments: Values) -> Value:
        return getattr(builder, instruction)(*as_vectors(builder, signature, arguments))


define_operator(operator.add, "fadd")
define_operator(operator.sub, "fsub")
define_operator(operator.mul, "fmul")
define_operator(operator.truediv, "fdiv")


@type_callable(operator.neg)
def type_of_negative(context: Any) -> Callable:
    return lambda value: vector if value == vector else None


@lower_builtin(operator.neg, vector)
def negate(context: Any, builder: Builder, signature: Any, arguments: Values) -> Value:
    return builder.fneg(arguments[0])


def of_either(generated: Callable) -> Callable:
    """Return a compiled function of one vector or one number, defined by LLVM instructions.

    generated(builder, value, wide) writes the instructions; wide(number) is a constant with as many
    lanes as `value`.
    """

    @intrinsic
    def function(typing_context: Any, value: Type) -> Generated | None:
        if value not in (vector, types.float64):
            return None

        def generate(context: Any, builder: Builder, signature: Any, arguments: Values) -> Value:
            lanes = signature.args[0] == vector

            def wide(value: ir.Constant) -> ir.Constant:
                return constant(value.type, [value.constant] * LANES) if lanes else value

            return generated(builder, arguments[0], wide)

        return value(value), generate

    return function


def call_llvm(builder: Builder, name: str, value: Value) -> Value:
    """Return the value of an LLVM function of a vector or a number."""
    suffix = "v8f64" if value.type == VECTOR else "f64"
    kind = ir.FunctionType(value.type, [value.type])
    function = cgutils.get_or_insert_function(builder.module, kind, f"llvm.{name}.{suffix}")
    return builder.call(function, [value])


@of_either
def square_root(builder: Builder, value: Value, wide: Callable) -> Value:
    """Return the correctly rounded square root; NaN below zero."""
    return call_llvm(builder, "sqrt", value)


@of_either
def power_of_two(builder: Builder, value: Value, wide: Callable) -> Value:
    """Return 2^k for an integer k, which is clipped to -1022..1023."""
    double = ir.DoubleType()
    for limit, compare in ((double(1023.0), ">"), (double(-1022.0), "<")):
        beyond = builder.fcmp_ordered(compare, value, wide(limit))
        value = builder.select(beyond, wide(limit), value)
    integer_type = BITS if value.type == VECTOR else INT64
    # k + 1023 + 2^52 has k + 1023 in its last bits
    bits = builder.bitcast(builder.fadd(value, wide(double(2.0**52 + 1023.0))), integer_type)
    return builder.bitcast(builder.shl(bits, wide(INT64(52))), value.type)


@of_either
def whole_exponent(builder: Builder, value: Value, wide: Callable) -> Value:
    """Return the integer k of x = m 2^k with sqrt(1/2) <= m < sqrt(2), for normal x > 0."""
    integer_type = BITS if value.type == VECTOR else INT64
    bits = builder.bitcast(value, integer_type)
    moved = builder.sub(bits, wide(INT64(0x3FE6_A09E_667F_3BCD)))
    exponent = builder.ashr(moved, wide(INT64(52)))
    return builder.sitofp(exponent, value.type)


@intrinsic
def select_positive(
    typing_context: Any, condition: Type, if_positive: Type, otherwise: Type
) -> Generated:
    """Return in each lane `if_positive` where the condition is positive, else `otherwise`.

    Each argument is a vector or a number; the result is a number only if all of them are numbers.
    """
    arguments = condition, if_positive, otherwise
    if not {*arguments} <= {vector, types.float64}:
        return None
    kind = vector if vector in arguments else types.float64

    def generate(context: Any, builder: Builder, signature: Any, values: Values) -> Value:
        if kind == vector:
            values = as_vectors(builder, signature, values)
        zero = ir.Constant(values[0].type, [0.0] * LANES if kind == vector else 0.0)
        above = builder.fcmp_ordered(">", values[0], zero)
        return builder.select(above, values[1], values[2])

    return kind(*arguments), generate


# --- Numbers too small to compute with ----------------------------------------------------------

TINY = 1e-150
"""Squares of numbers of at least this size are normal doubles. Smaller factors count as zero."""


@intrinsic
def zero_below(typing_context: Any, level: Type, value: Type) -> Generated:
    """Return a number or vector with zero where its absolute value is below `level`.

    NaN stays NaN. The level of a vector may be a vector too.
    """
    if value not in (vector, types.float64):
        return None
    lanes = value == vector == level

    def generate(context: Any, builder: Builder, signature: Any, arguments: Values) -> Value:
        level, value = arguments
        size = call_llvm(builder, "fabs", value)
        if value.type != level.type:
            level = repeat(builder, level)
        is_below = builder.fcmp_ordered("<", size, level)
        return builder.select(is_below, ir.Constant(value.type, None), value)

    return value(vector if lanes else types.float64, value), generate


# --- Moves between lanes ------------------------------------------------------------------------


def define_shift(first: int) -> Callable:
    """Return a compiled function that joins two vectors and returns LANES lanes from `first` on."""

    @intrinsic
    def shift(typing_context: Any, value: Type, neighbour: Type) -> Generated:
        def generate(context: Any, builder: Builder, signature: Any, arguments: Values) -> Value:
            return builder.shuffle_vector(*arguments, constant(LANE, range(first, first + LANES)))

        return vector(value, neighbour), generate

    return shift


right_neighbours = define_shift(1)
"""Given a block of sites and the next block, return each site's right neighbour."""
left_neighbours = define_shift(LANES - 1)
"""Given the previous block and a block of sites, return each site's left neighbour."""


@intrinsic
def keep_lanes(typing_context: Any, value: Type, count: Type, replacement: Type) -> Generated:
    """Return a vector with the lanes of another one, `replacement`, from lane `count` on."""

    def generate(context: Any, builder: Builder, signature: Any, arguments: Values) -> Value:
        value, count, replacement = arguments
        inside = builder.icmp_signed("<", constant(INT64, range(LANES)), repeat(builder, count))
        return builder.select(inside, value, replacement)

    return vector(value, types.int64, replacement), generate


# --- The largest absolute value -----------------------------------------------------------------


def magnitudes(builder: Builder, value: Value) -> Value:
    """Return the bits of a vector of doubles without their signs, as integers."""
    return builder.and_(builder.bitcast(value, BITS), constant(INT64, [MAGNITUDE] * LANES))


def larger_bits(builder: Builder, a: Value, b: Value) -> Value:
    return builder.select(builder.icmp_signed(">", a, b), a, b)


@intrinsic
def larger_magnitude(typing_context: Any, first: Type, second: Type) -> Generated:
    """Return in each lane the larger of two absolute values; NaN is larger than infinity."""

    def generate(context: Any, builder: Builder, signature: Any, arguments: Values) -> Value:
        bits = larger_bits(builder, *(magnitudes(builder, value) for value in arguments))
        return builder.bitcast(bits, VECTOR)

    return vector(first, second), generate


@intrinsic
def largest_lane(typing_context: Any, value: Type) -> Generated:
    """Return the largest absolute value among the lanes; NaN is larger than infinity."""

    def generate(context: Any, builder: Builder, signature: Any, arguments: Values) -> Value:
        bits = magnitudes(builder, arguments[0])
        kind = ir.FunctionType(INT64, [BITS])
        name = f"llvm.vector.reduce.smax.v{LANES}i64"
        largest = cgutils.get_or_insert_function(builder.module, kind, name)
        return builder.bitcast(builder.call(largest, [bits]), ir.DoubleType())

    return types.float64(value), generate


@intrinsic
def magnitude_bits(typing_context: Any, number: Type) -> Generated:
    """Return the bits of a double without its sign, as an integer."""

    def generate(context: Any, builder: Builder, signature: Any, arguments: Values) -> Value:
        return builder.and_(builder.bitcast(arguments[0], INT64), INT64(MAGNITUDE))

    return types.int64(types.float64), generate


@intrinsic
def from_bits(typing_context: Any, bits: Type) -> Generated:
    """Return the double with these bits."""

    def generate(context: Any, builder: Builder, signature: Any, arguments: Values) -> Value:
        return builder.bitcast(arguments[0], ir.DoubleType())

    return types.float64(types.int64), generate


@kernel
def largest_magnitude(values: np.ndarray) -> float:
    """Return the largest absolute value of a contiguous array; NaN is larger than infinity.

    LLVM vectorises this loop, because integer comparisons may be reordered.
    """
    top = np.int64(0)
    for i in range(values.size):
        top = max(top, magnitude_bits(values[i]))
    return from_bits(top)


@kernel
def largest_in_rows(scratch: np.ndarray, rows: int) -> float:
    """Return the largest absolute value in the first rows of a state, without ghost columns.

    The ghost columns are set to zero.
    """
    columns = scratch.shape[1]
    for row in range(rows):
        scratch[row, 0] = scratch[row, columns - 1] = 0.0
    return largest_magnitude(scratch.reshape(-1)[: rows * columns])


# --- Access to a state by vectors ---------------------------------------------------------------

INDEX = types.UniTuple(types.intp, 2)


class VectorView(types.Type):
    """The type of a view: an address and a shape, without a reference to the array."""

    def __init__(self) -> None:
        super().__init__("VectorView")


view_type = VectorView()


@register_model(VectorView)
class VectorViewModel(models.StructModel):
    def __init__(self, manager: Any, fe_type: Type) -> None:
        members = [("data", types.CPointer(types.float64)), ("shape", INDEX)]
        super().__init__(manager, fe_type, members)


def make_view(context: Any, builder: Builder, array_type: Type, state: Value) -> Value:
    view = ir.Constant(context.get_value_type(view_type), ir.Undefined)
    for position, name in enumerate(("data", "shape")):
        part = field_of(context, builder, array_type, state, name)
        view = builder.insert_value(view, part, position)
    return view


@intrinsic
def vector_views(typing_context: Any, states: Type) -> Generated:
    """Return views of a tuple of contiguous (row, column) states; they do not check bounds."""

    def generate(context: Any, builder: Builder, signature: Any, arguments: Values) -> Value:
        values = cgutils.unpack_tuple(builder, arguments[0])
        pairs = zip(signature.args[0], values, strict=True)
        views = [make_view(context, builder, array_type, state) for array_type, state in pairs]
        return cgutils.pack_array(builder, views)

    return types.UniTuple(view_type, len(states))(states), generate


make_attribute_wrapper(VectorView, "shape", "shape")


@type_callable(operator.getitem)
def type_of_read(context: Any) -> Callable:
    return lambda view, index: vector if view == view_type else None


@type_callable(operator.setitem)
def type_of_write(context: Any) -> Callable:
    return lambda view, index, value: types.void if view == view_type else None


def address_in_view(context: Any, builder: Builder, view: Value, index: Value) -> Value:
    """Return the address of the vector that starts at `index`, (row, column), of a view."""
    data, shape = (builder.extract_value(view, position) for position in range(2))
    row, column = (builder.extract_value(index, i) for i in range(2))
    place = builder.add(builder.mul(row, builder.extract_value(shape, 1)), column)
    return builder.bitcast(builder.gep(data, [place]), VECTOR.as_pointer())


@lower_builtin(operator.getitem, VectorView, types.UniTuple)
def read_vector(context: Any, builder: Builder, signature: Any, arguments: Values) -> Value:
    return builder.load(address_in_view(context, builder, *arguments), align=8)


@lower_builtin(operator.setitem, VectorView, types.UniTuple, Vector)
def write_vector(context: Any, builder: Builder, signature: Any, arguments: Values) -> Value:
    view, index, value = arguments
    builder.store(value, address_in_view(context, builder, view, index), align=8)
    return context.get_dummy_value()
