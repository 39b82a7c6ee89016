"""Properties of Blender's collections to arrays."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from ..core.arrays import Ints


def column(items: Any, name: str, width: int, dtype: Any) -> Any:
    """Read one property of a Blender collection: (k,) for width 1, else (k, width)."""
    values = np.empty(len(items) * width, dtype=dtype)
    items.foreach_get(name, values)
    return values if width == 1 else values.reshape(-1, width)


def indices(items: Any, name: str, width: int = 1) -> Ints:
    values: Ints = column(items, name, width, np.int32).astype(np.int64)
    return values


def stored(mesh: bpy.types.Mesh, attribute: str, otherwise: tuple[Any, str], width: int = 1) -> Any:
    """Read a property from the attribute that stores it, a hundred times as quick as from the collection's items.

    otherwise: the items and the name of the same property there, for an attribute that is absent.
    """
    dtype: Any = bool if attribute in (".select_poly", ".hide_poly") else np.int32
    if attribute in mesh.attributes:
        values = column(mesh.attributes[attribute].data, "value", width, dtype)
    else:
        values = column(*otherwise, width, dtype)
    return values if dtype is bool else values.astype(np.int64)
