"""Properties of Blender's collections to arrays."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from ..arrays.types import Ints, Mask


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
