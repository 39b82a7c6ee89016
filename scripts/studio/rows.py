"""A row of a picture: a scene, what is selected in it, and what is done to it, side by side."""

from collections.abc import Callable
from typing import Any, NamedTuple

import bpy
import numpy as np
from numpy.typing import NDArray

import demo_pictures as pictures
import demo_scenes as scenes

Points = NDArray[np.float64]
Chosen = Callable[[Any], bool]
Run = Callable[[], None]


class Row(NamedTuple):
    """scene makes and activates the object, and says of an element of bmesh whether it is selected.

    kind: "verts", "edges" or "faces"; runs: by their captions, each with the selection in edit mode; away: distances
    of (n, 3) points to the right surface, where it is known, and size by which they are divided;
    stripes: how many, as demo_pictures.STRIPES.
    """

    title: str
    scene: Callable[[], Chosen]
    kind: str
    runs: dict[str, Run]
    away: Callable[[Points], Points] | None = None
    size: float = 1.0
    timed: bool = False
    striped: bool = True
    stripes: float = pictures.STRIPES


def placed(mesh: bpy.types.Mesh) -> bpy.types.Object:
    """An object of the mesh, active and smooth."""
    obj = bpy.data.objects.new("Part", mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    mesh.shade_smooth()
    return obj


def moved(move: Callable[[Points], Points]) -> None:
    """Move the active mesh's vertices."""
    mesh = bpy.context.object.data
    mesh.vertices.foreach_set("co", move(scenes.positions(mesh)).astype(np.float32).ravel())
    mesh.update()


def marked(mask: NDArray[np.bool_]) -> Chosen:
    """Faces by their index."""
    return lambda face: bool(mask[face.index])


def smooth() -> None:
    """Shade the active mesh smooth, but for its hard edges; by area, as slivers around a fillet have large angles."""
    bpy.ops.object.mode_set(mode="OBJECT")
    mesh = bpy.context.object.data
    mesh.shade_smooth()
    mesh.set_sharp_from_angle(angle=0.6)
    weighted = bpy.context.object.modifiers.new("By area", "WEIGHTED_NORMAL")
    weighted.keep_sharp, weighted.mode = True, "FACE_AREA"
