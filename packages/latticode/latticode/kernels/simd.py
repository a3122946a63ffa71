"""Vectors of eight doubles in compiled code: one value that holds eight neighbouring sites.

What there is. A `Vector` is eight doubles in a vector register, its lanes, numbered 0 to 7.
`load` and `store` move one between a register and eight neighbouring numbers of an array, `fill`
repeats one number, + - * / and unary - work lane by lane. `left_neighbours` and `right_neighbours`
shift lanes, so that each site sees the one beside it. `keep_lanes` replaces the lanes behind the
last site, `zero_below` those with tiny numbers, `larger_magnitude` and `largest_lane` find the
largest absolute value. A `VectorView` is a state (row, column) seen a vector at a time: `y[row, j]`
of the view reads or writes the vector that begins at column j. A formula that is written once for
`y[row, j]` therefore serves for one site, if it is given the array, and for a vector of sites, if
it is given the view.

Why eight. A processor with AVX-512 takes eight doubles in one instruction. For one with AVX2, LLVM
makes two instructions that do not wait for each other: they gain a little on long rows, and lose a
little on rows that fill few vectors.

Why not LLVM's auto-vectoriser. It vectorises a loop over sites only where it can prove that no
array overlaps another; it keeps the partial sums of a nested loop (a Cauchy product over the orders
of a power series) in memory instead of registers; and it leaves the remainder of a row, up to
fifteen sites, to a scalar loop, which is half of the paper's half chain. A kernel that is written
with vectors says what is meant, and its speed does not depend on what a compiler proves.

What is promised of bits. Each lane does the IEEE operations of one site, in the order in which
they are written: no operation carries a fast-math flag, so LLVM neither reorders nor contracts
them to fused multiply-adds. One site alone, eight at a time, and any processor give the same bits.
Where the processor has shorter vectors, LLVM splits each operation into several.

Why magnitudes are compared as integers. Read as an integer, the bits of a double without their
sign are in the order of the numbers, and NaN comes after infinity. A maximum taken that way never
loses a NaN, as one of floating-point numbers may, and it may be reordered and so vectorised.

What it rests upon: `numba.extending`, `numba.types`, and of `numba.core.cgutils` what the guide to
extending numba uses. Besides, arrays must be contiguous with the last index fastest, and nothing
checks bounds. `llvmlite.ir` is public, but it follows LLVM: `bitcast` to a typed pointer before a
load or a store is a habit of LLVM before opaque pointers. After an upgrade of numba the tests in
tests/kernels/test_simd.py name the operation that broke, and tests/test_same_bits.py finds a
changed order of operations.
"""

import operator
from collections.abc import Callable

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import (
    intrinsic,
    lower_builtin,
    models,
    overload_attribute,
    register_model,
    type_callable,
)

from .compiled import kernel

LANES = 8
"""Numbers in a vector: 512 bits, the width of AVX-512."""

VECTOR = ir.VectorType(ir.DoubleType(), LANES)
INT64 = ir.IntType(64)
BITS = ir.VectorType(INT64, LANES)
LANE = ir.IntType(32)
MAGNITUDE = 0x7FFF_FFFF_FFFF_FFFF
"""All bits of a double but for its sign."""


# --- The type, and what passes between registers and arrays -------------------------------------


class Vector(types.Type):
    """The type of eight doubles. They live in registers only: there are no arrays of them."""

    def __init__(self):
        super().__init__("Vector")


vector = Vector()


@register_model(Vector)
class VectorModel(models.PrimitiveModel):
    def __init__(self, manager, fe_type):
        super().__init__(manager, fe_type, VECTOR)


def constant(kind, values) -> ir.Constant:
    return ir.Constant(ir.VectorType(kind, LANES), list(values))


def address_in_array(context, builder, array_type, array, index) -> ir.Value:
    """Return the address of the vector that starts at the flat `index` of an array."""
    data = cgutils.create_struct_proxy(array_type)(context, builder, array).data
    return builder.bitcast(builder.gep(data, [index]), VECTOR.as_pointer())


def repeat(builder, number) -> ir.Value:
    """Return the vector that holds a number, or a whole number, in all lanes."""
    nothing = ir.Constant(ir.VectorType(number.type, LANES), ir.Undefined)
    first_lane = builder.insert_element(nothing, number, LANE(0))
    return builder.shuffle_vector(first_lane, nothing, constant(LANE, [0] * LANES))


@intrinsic
def fill(typing_context, number) -> tuple:
    """Return the number in all lanes."""

    def generate(context, builder, signature, arguments):
        return repeat(builder, arguments[0])

    return vector(types.float64), generate


@intrinsic
def load(typing_context, array, index) -> tuple:
    """Return LANES numbers of a contiguous array from the flat `index` on; nothing is checked."""

    def generate(context, builder, signature, arguments):
        place = address_in_array(context, builder, signature.args[0], *arguments)
        return builder.load(place, align=8)

    return vector(array, types.intp), generate


@intrinsic
def store(typing_context, array, index, value) -> tuple:
    """Write LANES numbers into a contiguous array from the flat `index` on; nothing is checked."""

    def generate(context, builder, signature, arguments):
        array, index, value = arguments
        place = address_in_array(context, builder, signature.args[0], array, index)
        builder.store(value, place, align=8)
        return context.get_dummy_value()

    return types.void(array, types.intp, vector), generate


# --- Arithmetic, lane by lane -------------------------------------------------------------------


def define_operator(symbol, instruction) -> None:
    """Define an operator of two vectors, or of a vector and a number, by an instruction of LLVM."""

    @type_callable(symbol)
    def type_of_result(context):
        def typed(first, second):
            known = {first, second} <= {vector, types.float64} and vector in (first, second)
            return vector if known else None

        return typed

    @lower_builtin(symbol, vector, vector)
    def of_vectors(context, builder, signature, arguments):
        return getattr(builder, instruction)(*arguments)

    @lower_builtin(symbol, types.float64, vector)
    def of_number_and_vector(context, builder, signature, arguments):
        return getattr(builder, instruction)(repeat(builder, arguments[0]), arguments[1])

    @lower_builtin(symbol, vector, types.float64)
    def of_vector_and_number(context, builder, signature, arguments):
        return getattr(builder, instruction)(arguments[0], repeat(builder, arguments[1]))


define_operator(operator.add, "fadd")
define_operator(operator.sub, "fsub")
define_operator(operator.mul, "fmul")
define_operator(operator.truediv, "fdiv")


@type_callable(operator.neg)
def type_of_negative(context) -> Callable:
    return lambda value: vector if value == vector else None


@lower_builtin(operator.neg, vector)
def negate(context, builder, signature, arguments) -> ir.Value:
    return builder.fneg(arguments[0])


def of_either(generated) -> Callable:
    """Return a function of a vector or of one number, lane by lane, by instructions of LLVM.

    generated(builder, value, wide) writes them, where wide(one) is a constant of as many lanes.
    """

    @intrinsic
    def function(typing_context, value):
        if value not in (vector, types.float64):
            return None

        def generate(context, builder, signature, arguments):
            lanes = signature.args[0] == vector

            def wide(value):
                return constant(value.type, [value.constant] * LANES) if lanes else value

            return generated(builder, arguments[0], wide)

        return value(value), generate

    return function


def call_llvm(builder, name, value) -> ir.Value:
    """Return a function of LLVM of a vector or of one number."""
    suffix = "v8f64" if value.type == VECTOR else "f64"
    kind = ir.FunctionType(value.type, [value.type])
    function = cgutils.get_or_insert_function(builder.module, kind, f"llvm.{name}.{suffix}")
    return builder.call(function, [value])


@of_either
def square_root(builder, value, wide) -> ir.Value:
    """Return the square root, which is rounded alike everywhere; NaN below zero."""
    return call_llvm(builder, "sqrt", value)


@of_either
def power_of_two(builder, value, wide) -> ir.Value:
    """Return 2^k of a whole number k, as if k were within -1022..1023."""
    double = ir.DoubleType()
    for limit, compare in ((double(1023.0), ">"), (double(-1022.0), "<")):
        beyond = builder.fcmp_ordered(compare, value, wide(limit))
        value = builder.select(beyond, wide(limit), value)
    integer_type = BITS if value.type == VECTOR else INT64
    # k + 1023 + 2^52 has k + 1023 in its last bits
    bits = builder.bitcast(builder.fadd(value, wide(double(2.0**52 + 1023.0))), integer_type)
    return builder.bitcast(builder.shl(bits, wide(INT64(52))), value.type)


@of_either
def whole_exponent(builder, value, wide) -> ir.Value:
    """Return the k of x = m 2^k with m from sqrt(1/2) to sqrt(2), for normal x > 0."""
    integer_type = BITS if value.type == VECTOR else INT64
    bits = builder.bitcast(value, integer_type)
    moved = builder.sub(bits, wide(INT64(0x3FE6_A09E_667F_3BCD)))
    exponent = builder.ashr(moved, wide(INT64(52)))
    return builder.sitofp(exponent, value.type)


@intrinsic
def select_positive(typing_context, condition, if_positive, otherwise) -> tuple:
    """Return `if_positive` where the condition is positive, `otherwise` elsewhere, by lane.

    Each is a vector or a number; the result is a vector where one of them is.
    """
    arguments = condition, if_positive, otherwise
    if not {*arguments} <= {vector, types.float64}:
        return None
    kind = vector if vector in arguments else types.float64

    def generate(context, builder, signature, values):
        typed = zip(signature.args, values, strict=True)
        if kind == vector:
            values = [value if of == vector else repeat(builder, value) for of, value in typed]
        zero = ir.Constant(values[0].type, [0.0] * LANES if kind == vector else 0.0)
        above = builder.fcmp_ordered(">", values[0], zero)
        return builder.select(above, values[1], values[2])

    return kind(*arguments), generate


# --- Numbers too small to compute with ----------------------------------------------------------

TINY = 1e-150
"""Down to this size the square of a number is a normal double. Smaller factors count as zero."""


@intrinsic
def zero_below(typing_context, level, value) -> tuple:
    """Return a number, or a vector lane by lane, with zero where its size is below `level`.

    NaN stays.
    """
    if value not in (vector, types.float64):
        return None

    def generate(context, builder, signature, arguments):
        level, value = arguments
        size = call_llvm(builder, "fabs", value)
        if value.type == VECTOR:
            level = repeat(builder, level)
        is_below = builder.fcmp_ordered("<", size, level)
        return builder.select(is_below, ir.Constant(value.type, None), value)

    return value(types.float64, value), generate


# --- What passes between the lanes --------------------------------------------------------------


def define_shift(first) -> Callable:
    """Return the function that takes LANES lanes in a row, from `first` on, of two vectors."""

    @intrinsic
    def shift(typing_context, value, neighbour):
        def generate(context, builder, signature, arguments):
            return builder.shuffle_vector(*arguments, constant(LANE, range(first, first + LANES)))

        return vector(value, neighbour), generate

    return shift


right_neighbours = define_shift(1)
"""Given a block of sites and the next block, return each site's right neighbour."""
left_neighbours = define_shift(LANES - 1)
"""Given the block before and a block of sites, return each site's left neighbour."""


@intrinsic
def keep_lanes(typing_context, value, count, replacement) -> tuple:
    """Return the first `count` lanes of a vector, and the number `replacement` in the rest."""

    def generate(context, builder, signature, arguments):
        value, count, replacement = arguments
        inside = builder.icmp_signed("<", constant(INT64, range(LANES)), repeat(builder, count))
        return builder.select(inside, value, repeat(builder, replacement))

    return vector(value, types.int64, types.float64), generate


# --- The largest absolute value -----------------------------------------------------------------


def magnitudes(builder, value) -> ir.Value:
    """Return the bits of a vector of doubles without their signs."""
    return builder.and_(builder.bitcast(value, BITS), constant(INT64, [MAGNITUDE] * LANES))


def larger_bits(builder, a, b) -> ir.Value:
    return builder.select(builder.icmp_signed(">", a, b), a, b)


@intrinsic
def larger_magnitude(typing_context, first, second) -> tuple:
    """Return in each lane the larger of two absolute values; NaN is larger than infinity."""

    def generate(context, builder, signature, arguments):
        bits = larger_bits(builder, *(magnitudes(builder, value) for value in arguments))
        return builder.bitcast(bits, VECTOR)

    return vector(first, second), generate


@intrinsic
def largest_lane(typing_context, value) -> tuple:
    """Return the largest absolute value among the lanes; NaN is larger than infinity."""

    def generate(context, builder, signature, arguments):
        bits = magnitudes(builder, arguments[0])
        lanes = [builder.extract_element(bits, LANE(lane)) for lane in range(LANES)]
        while len(lanes) > 1:
            lanes.append(larger_bits(builder, lanes.pop(0), lanes.pop(0)))
        return builder.bitcast(lanes[0], ir.DoubleType())

    return types.float64(value), generate


@kernel
def largest_magnitude(values) -> float:
    """Return the largest absolute value of an array; NaN is larger than infinity.

    LLVM vectorises this loop by itself, since integer comparisons may be reordered. `values` is
    contiguous scratch space: its first element is overwritten, to turn bits into a number again.
    """
    bits = values.view(np.int64)
    top = np.int64(0)
    for i in range(bits.size):
        top = max(top, bits[i] & MAGNITUDE)
    bits[0] = top
    return values[0]


@kernel
def largest_in_rows(scratch, rows) -> float:
    """Return the largest absolute value in the first `rows` rows of a state, but for its ghosts.

    The ghost columns of those rows are set to zero, and the first element is overwritten.
    """
    columns = scratch.shape[1]
    for row in range(rows):
        scratch[row, 0] = scratch[row, columns - 1] = 0.0
    return largest_magnitude(scratch.reshape(-1)[: rows * columns])


# --- A state seen a vector at a time ------------------------------------------------------------

INDEX = types.UniTuple(types.intp, 2)


class VectorView(types.Type):
    """The type of a view: an address and a shape. It does not keep the state alive."""

    def __init__(self):
        super().__init__("VectorView")


view_type = VectorView()


@register_model(VectorView)
class VectorViewModel(models.StructModel):
    def __init__(self, manager, fe_type):
        members = [("data", types.CPointer(types.float64)), ("shape", INDEX)]
        super().__init__(manager, fe_type, members)


def view_of(context, builder, array_type, state) -> ir.Value:
    array = cgutils.create_struct_proxy(array_type)(context, builder, state)
    view = cgutils.create_struct_proxy(view_type)(context, builder)
    view.data, view.shape = array.data, array.shape
    return view._getvalue()


@intrinsic
def vector_views(typing_context, states) -> tuple:
    """Return views of a tuple of contiguous (row, column) states; nothing is checked on access."""

    def generate(context, builder, signature, arguments):
        values = cgutils.unpack_tuple(builder, arguments[0])
        pairs = zip(signature.args[0], values, strict=True)
        views = [view_of(context, builder, array_type, state) for array_type, state in pairs]
        return cgutils.pack_array(builder, views)

    return types.UniTuple(view_type, len(states))(states), generate


@intrinsic
def shape_of(typing_context, view) -> tuple:
    def generate(context, builder, signature, arguments):
        return cgutils.create_struct_proxy(view_type)(context, builder, arguments[0]).shape

    return INDEX(view), generate


@overload_attribute(VectorView, "shape")
def shape(view) -> Callable:
    """Let `view.shape` be the shape of the state."""
    return lambda view: shape_of(view)


@type_callable(operator.getitem)
def type_of_read(context) -> Callable:
    return lambda view, index: vector if view == view_type else None


@type_callable(operator.setitem)
def type_of_write(context) -> Callable:
    return lambda view, index, value: types.void if view == view_type else None


def address_in_view(context, builder, view, index) -> ir.Value:
    """Return the address of the vector that starts at (row, column) of a view."""
    view = cgutils.create_struct_proxy(view_type)(context, builder, view)
    row, column = (builder.extract_value(index, i) for i in range(2))
    columns = builder.extract_value(view.shape, 1)
    place = builder.add(builder.mul(row, columns), column)
    return builder.bitcast(builder.gep(view.data, [place]), VECTOR.as_pointer())


@lower_builtin(operator.getitem, VectorView, types.UniTuple)
def read_vector(context, builder, signature, arguments) -> ir.Value:
    return builder.load(address_in_view(context, builder, *arguments), align=8)


@lower_builtin(operator.setitem, VectorView, types.UniTuple, Vector)
def write_vector(context, builder, signature, arguments) -> ir.Value:
    view, index, value = arguments
    builder.store(value, address_in_view(context, builder, view, index), align=8)
    return context.get_dummy_value()
