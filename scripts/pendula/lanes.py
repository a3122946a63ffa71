"""What passes between the four lanes of a vector, and choices lane by lane.

Comparisons are of whole numbers: the bits of doubles without their sign are in the order of the
numbers, and NaN comes last, so that it is never lost on the way to the largest.
"""

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from .vectors import LANES, VECTOR, vector

WHOLE = ir.IntType(64)
BITS = ir.VectorType(WHOLE, LANES)
LANE = ir.IntType(32)


def constant(kind, values):
    return ir.Constant(ir.VectorType(kind, LANES), list(values))


def magnitudes(builder, value):
    """Return the bits of four doubles without their signs."""
    return builder.and_(builder.bitcast(value, BITS), constant(WHOLE, [(1 << 63) - 1] * LANES))


def larger_of(builder, a, b):
    return builder.select(builder.icmp_signed(">", a, b), a, b)


@intrinsic
def larger(typing_context, one, other):
    """Return in each lane the larger of two magnitudes."""

    def generate(context, builder, signature, arguments):
        bits = larger_of(builder, *(magnitudes(builder, value) for value in arguments))
        return builder.bitcast(bits, VECTOR)

    return vector(one, other), generate


@intrinsic
def largest_lane(typing_context, value):
    """Return the largest magnitude among the lanes."""

    def generate(context, builder, signature, arguments):
        bits = magnitudes(builder, arguments[0])
        lanes = [builder.extract_element(bits, LANE(lane)) for lane in range(LANES)]
        while len(lanes) > 1:
            lanes.append(larger_of(builder, lanes.pop(0), lanes.pop(0)))
        return builder.bitcast(lanes[0], ir.DoubleType())

    return types.float64(value), generate


@intrinsic
def keep(typing_context, value, count, other):
    """Return the first `count` lanes of a vector, and the number `other` in the rest."""

    def generate(context, builder, signature, arguments):
        value, count, other = arguments
        for lane in range(LANES):
            inside = builder.icmp_signed("<", WHOLE(lane), count)
            number = builder.select(inside, builder.extract_element(value, LANE(lane)), other)
            value = builder.insert_element(value, number, LANE(lane))
        return value

    return vector(value, types.int64, types.float64), generate


def define_shift(first):
    """Return the function that takes four lanes in a row, from `first` on, of two vectors."""

    @intrinsic
    def shift(typing_context, one, other):
        def generate(context, builder, signature, arguments):
            return builder.shuffle_vector(*arguments, constant(LANE, range(first, first + LANES)))

        return vector(one, other), generate

    return shift


seen_right = define_shift(1)
"""Return each site's right neighbour, given a block and the next."""
seen_left = define_shift(LANES - 1)
"""Return each site's left neighbour, given the block before and the block."""
