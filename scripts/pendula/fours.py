"""States seen four sites at a time: y[row, j] of a view is the vector y[row, j] to y[row, j + 3].

What is written for one site so serves for four, on the same operations in each lane.
"""

import operator

from numba import types
from numba.core import cgutils
from numba.core.datamodel import models
from numba.core.imputils import lower_builtin
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import intrinsic, overload_attribute, register_model

from .vectors import VECTOR, vector

INDEX = types.UniTuple(types.intp, 2)


class Fours(types.Type):
    """The type of such a view: an address and the shape; it does not keep the state alive."""

    def __init__(self):
        super().__init__("Fours")


fours_type = Fours()


@register_model(Fours)
class FoursModel(models.StructModel):
    def __init__(self, manager, fe_type):
        members = [("data", types.CPointer(types.float64)), ("shape", INDEX)]
        super().__init__(manager, fe_type, members)


def view_of(context, builder, kind, state):
    array = context.make_array(kind)(context, builder, state)
    view = cgutils.create_struct_proxy(fours_type)(context, builder)
    view.data, view.shape = array.data, array.shape
    return view._getvalue()


@intrinsic
def fours(typing_context, states):
    """Return views of a tuple of contiguous (row, column) states; nothing is checked on access."""

    def generate(context, builder, signature, arguments):
        values = cgutils.unpack_tuple(builder, arguments[0])
        pairs = zip(signature.args[0], values, strict=True)
        views = [view_of(context, builder, kind, state) for kind, state in pairs]
        return context.make_tuple(builder, signature.return_type, views)

    return types.UniTuple(fours_type, len(states))(states), generate


@intrinsic
def shape_of(typing_context, view):
    def generate(context, builder, signature, arguments):
        return cgutils.create_struct_proxy(fours_type)(context, builder, arguments[0]).shape

    return INDEX(view), generate


@overload_attribute(Fours, "shape")
def shape(view):
    return lambda view: shape_of(view)


@infer_global(operator.getitem)
class Read(AbstractTemplate):
    def generic(self, arguments, keywords):
        if isinstance(arguments[0], Fours):
            return signature(vector, arguments[0], INDEX)
        return None


@infer_global(operator.setitem)
class Write(AbstractTemplate):
    def generic(self, arguments, keywords):
        if isinstance(arguments[0], Fours):
            return signature(types.void, arguments[0], INDEX, vector)
        return None


def address(context, builder, view, index):
    """Return where the four numbers are."""
    view = cgutils.create_struct_proxy(fours_type)(context, builder, view)
    row, column = (builder.extract_value(index, i) for i in range(2))
    columns = builder.extract_value(view.shape, 1)
    place = builder.add(builder.mul(row, columns), column)
    return builder.bitcast(builder.gep(view.data, [place]), VECTOR.as_pointer())


@lower_builtin(operator.getitem, Fours, types.UniTuple)
def read(context, builder, signature, arguments):
    return builder.load(address(context, builder, *arguments), align=8)


@lower_builtin(operator.setitem, Fours, types.UniTuple, type(vector))
def write(context, builder, signature, arguments):
    view, index, value = arguments
    builder.store(value, address(context, builder, view, index), align=8)
    return context.get_dummy_value()
