"""Properties and attributes of Blender's meshes as arrays, and back."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from ..arrays.types import Floats, Ints, Mask


def column(items: Any, name: str, width: int, dtype: Any) -> Any:
    """Read one property of a Blender collection: (k,) for width 1, else (k, width)."""
    values = np.empty(len(items) * width, dtype=dtype)
    items.foreach_get(name, values)
    return values if width == 1 else values.reshape(-1, width)


def indices(items: Any, name: str, width: int = 1) -> Ints:
    values: Ints = column(items, name, width, np.int32).astype(np.int64)
    return values


def stored(mesh: bpy.types.Mesh, attribute: str, otherwise: tuple[Any, str], width: int = 1) -> Ints:
    """Read indices from the attribute that stores it, a hundred times as quick as from the collection's items.

    otherwise: the items and the name of the same indices there, for an attribute that is absent.
    """
    if attribute in mesh.attributes:
        return indices(mesh.attributes[attribute].data, "value", width)
    return indices(*otherwise, width)


def flags(mesh: bpy.types.Mesh, attribute: str, items: Any) -> Mask:
    """Read a property of all items that is true or false; one that is true nowhere has no attribute."""
    if attribute not in mesh.attributes:
        return np.zeros(len(items), dtype=bool)
    found: Mask = column(mesh.attributes[attribute].data, "value", 1, bool)
    return found


def elements_of(table: Any, numbers: Ints) -> list[Any]:
    """Return the elements of a bmesh's sequence, whose lookup table is up to date."""
    return [table[number] for number in numbers.tolist()]


SCULPT_MASK, FACE_SET = ".sculpt_mask", ".sculpt_face_set"  # Blender's own names of what sculpt mode paints


def values(mesh: bpy.types.Mesh, name: str, dtype: Any) -> Any:
    """Return the values of an attribute of a mesh in object mode; None where there is none."""
    attribute = mesh.attributes.get(name)
    if attribute is None:
        return None
    return column(attribute.data, "value", 1, dtype)


def faces_within(mesh: bpy.types.Mesh, vertices: Mask) -> Ints:
    """Return the faces of a mesh in object mode with all vertices in the (n,) mask."""
    if not len(mesh.polygons):
        return np.empty(0, dtype=np.int64)
    inside = vertices[indices(mesh.loops, "vertex_index")]
    return np.flatnonzero(np.logical_and.reduceat(inside, indices(mesh.polygons, "loop_start")))


def write_attribute(mesh: bpy.types.Mesh, name: str, values: Floats) -> None:
    """Write one number per vertex (n,) to the vertex attribute `name` of a mesh in object mode."""
    layer = mesh.attributes.get(name) or mesh.attributes.new(name, "FLOAT", "POINT")
    layer.data.foreach_set("value", values.astype(np.float32))
    mesh.update()


_DTYPES = {"FLOAT": np.float32, "INT": np.int32, "BOOLEAN": np.bool_}  # by the type of the property


def has_numbers(attribute: Any) -> bool:
    """Return whether the values of an attribute are numbers or flags."""
    return _value_property(attribute).type in _DTYPES


def layout_of(attribute: Any) -> tuple[str, int, Any]:
    """Return the name of an attribute's values, how many numbers each is, and their type in numpy."""
    found = _value_property(attribute)
    return found.identifier, max(1, found.array_length), _DTYPES[found.type]


def values_of(attribute: Any) -> Any:
    """Return (n, w)."""
    name, width, dtype = layout_of(attribute)
    return column(attribute.data, name, width, dtype).reshape(-1, width)


def _value_property(attribute: Any) -> Any:
    properties = attribute.bl_rna.properties["data"].fixed_type.properties
    return next(each for each in properties if each.identifier != "rna_type")
