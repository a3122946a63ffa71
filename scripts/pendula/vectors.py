"""Four numbers side by side as one value in compiled code, one to a site.

numba leaves it to LLVM to find loops that the processor's vector units can take, which it does only
where it can prove that no array overlaps another, and it keeps no sums of such loops in registers.
With `Vector` values a kernel says so itself. Each lane is an IEEE double of its own, so the bits
are those of the same operations one site at a time.
"""

import operator

from llvmlite import ir
from numba import types
from numba.core.datamodel import models
from numba.core.imputils import lower_builtin
from numba.core.typing.templates import ConcreteTemplate, infer_global, signature
from numba.extending import intrinsic, register_model

LANES = 4
VECTOR = ir.VectorType(ir.DoubleType(), LANES)


class Vector(types.Type):
    """The type of four doubles; they live in registers only, there are no arrays of it."""

    def __init__(self):
        super().__init__("Vector")


vector = Vector()


@register_model(Vector)
class VectorModel(models.PrimitiveModel):
    def __init__(self, manager, fe_type):
        super().__init__(manager, fe_type, VECTOR)


def address(context, builder, array_type, array, index):
    data = context.make_array(array_type)(context, builder, array).data
    return builder.bitcast(builder.gep(data, [index]), VECTOR.as_pointer())


def repeated(builder, number):
    nothing = ir.Constant(VECTOR, ir.Undefined)
    one = builder.insert_element(nothing, number, ir.IntType(32)(0))
    lanes = ir.Constant(ir.VectorType(ir.IntType(32), LANES), [0] * LANES)
    return builder.shuffle_vector(one, nothing, lanes)


@intrinsic
def fill(typing_context, number):
    """Return the number in all lanes."""

    def generate(context, builder, signature, arguments):
        return repeated(builder, arguments[0])

    return vector(types.float64), generate


@intrinsic
def load(typing_context, array, index):
    """Return four numbers of a contiguous array from the flat `index` on; nothing is checked."""

    def generate(context, builder, signature, arguments):
        return builder.load(address(context, builder, signature.args[0], *arguments), align=8)

    return vector(array, types.intp), generate


@intrinsic
def store(typing_context, array, index, value):
    """Write four numbers into a contiguous array from the flat `index` on; nothing is checked."""

    def generate(context, builder, signature, arguments):
        place, index, value = arguments
        builder.store(value, address(context, builder, signature.args[0], place, index), align=8)
        return context.get_dummy_value()

    return types.void(array, types.intp, vector), generate


def define(symbol, instruction):
    """Give vectors an operator, and numbers with a vector to their right."""

    @infer_global(symbol)
    class Template(ConcreteTemplate):
        cases = [
            signature(vector, vector, vector),
            signature(vector, types.float64, vector),
        ]

    @lower_builtin(symbol, vector, vector)
    def of_vectors(context, builder, signature, arguments):
        return getattr(builder, instruction)(*arguments)

    @lower_builtin(symbol, types.float64, vector)
    def of_number_and_vector(context, builder, signature, arguments):
        return getattr(builder, instruction)(repeated(builder, arguments[0]), arguments[1])


define(operator.add, "fadd")
define(operator.sub, "fsub")
define(operator.mul, "fmul")


@infer_global(operator.neg)
class Negative(ConcreteTemplate):
    cases = [signature(vector, vector)]


@lower_builtin(operator.neg, vector)
def negate(context, builder, signature, arguments):
    return builder.fneg(arguments[0])
