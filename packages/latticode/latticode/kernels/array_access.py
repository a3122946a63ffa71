"""Code for elements, rows and fields of contiguous arrays.

numba's own code has several times as many instructions, because it copies all fields of an array to
memory. LLVM removes them, but that took a third of the time to compile a kernel.
"""

from collections.abc import Sequence
from functools import reduce
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils


def field_of(
    context: Any, builder: ir.IRBuilder, kind: types.Type, struct: ir.Value, name: str
) -> ir.Value:
    """Return a field of an array or of another struct of numba."""
    position = context.data_model_manager.lookup(kind).get_field_position(name)
    return builder.extract_value(struct, position)


def counted_from_start(
    builder: ir.IRBuilder, index: ir.Value, kind: types.Integer, length: ir.Value
) -> ir.Value:
    """Return an index that is not negative; a negative one counts from the end."""
    if not kind.signed:
        return index
    is_negative = builder.icmp_signed("<", index, index.type(0))
    return builder.select(is_negative, builder.add(index, length), index)


def address_of(
    context: Any,
    builder: ir.IRBuilder,
    kind: types.Array,
    array: ir.Value,
    indices: Sequence[tuple[ir.Value, types.Integer]],
) -> ir.Value:
    """Return the address of the element or row that typed indices choose."""
    lengths = cgutils.unpack_tuple(builder, field_of(context, builder, kind, array, "shape"))
    place = counted_from_start(builder, *indices[0], lengths[0])
    for axis, length in enumerate(lengths[1:], 1):
        place = builder.mul(place, length)
        if axis < len(indices):
            place = builder.add(place, counted_from_start(builder, *indices[axis], length))
    return builder.gep(field_of(context, builder, kind, array, "data"), [place])


def view_of(
    context: Any,
    builder: ir.IRBuilder,
    kind: types.Array,
    array: ir.Value,
    data: ir.Value,
    dimensions: int,
) -> tuple[types.Array, ir.Value]:
    """Return the type and struct of the array at `data` with the last dimensions of another one.

    With no dimensions it has one: all elements.
    """
    fields = {
        name: field_of(context, builder, kind, array, name)
        for name in ("meminfo", "parent", "itemsize", "nitems")
    }
    for name, of_all in (("shape", "nitems"), ("strides", "itemsize")):
        values = cgutils.unpack_tuple(builder, field_of(context, builder, kind, array, name))
        chosen = values[-dimensions:] if dimensions else [fields[of_all]]
        fields[name] = cgutils.pack_array(builder, chosen)
        if name == "shape":
            fields["nitems"] = reduce(builder.mul, chosen)
    view = kind.copy(ndim=max(1, dimensions))
    model = context.data_model_manager.lookup(view)
    struct = ir.Constant(context.get_value_type(view), ir.Undefined)
    for name, value in {**fields, "data": data}.items():
        struct = builder.insert_value(struct, value, model.get_field_position(name))
    return view, struct
