"""Objects to fair, selections, and the bytes of a mesh."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from itertools import product
from typing import Any

import bmesh
import bpy
import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

# How each attribute type is read: name of the value, numbers per element, numpy type.
LAYOUT: dict[str, tuple[str, int, Any]] = {
    "FLOAT": ("value", 1, np.float32),
    "INT": ("value", 1, np.int32),
    "INT8": ("value", 1, np.int32),
    "BOOLEAN": ("value", 1, bool),
    "FLOAT2": ("vector", 2, np.float32),
    "FLOAT4": ("vector", 4, np.float32),  # since Blender 5.2
    "FLOAT_VECTOR": ("vector", 3, np.float32),
    "FLOAT_COLOR": ("color", 4, np.float32),
    "BYTE_COLOR": ("color", 4, np.float32),
    "INT32_2D": ("value", 2, np.int32),
    "INT16_2D": ("value", 2, np.int32),
    "QUATERNION": ("value", 4, np.float32),
    "FLOAT4X4": ("value", 16, np.float32),
}


def add(points: Any, faces: Sequence[Sequence[int]], name: str = "Patch", edges: Any = ()) -> bpy.types.Object:
    """Add a mesh object, with edges that have no faces, and make it the active one."""
    mesh = bpy.data.meshes.new(name)
    # Not from_pydata: setting the selection of the edges that it makes crashes Blender 5.0.1.
    bm = bmesh.new()
    vertices = [bm.verts.new(tuple(map(float, point))) for point in points]
    for face in faces:
        bm.faces.new([vertices[v] for v in face])
    for a, b in edges:
        bm.edges.new((vertices[a], vertices[b]))
    bm.to_mesh(mesh)
    bm.free()
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    for other in bpy.context.view_layer.objects:
        other.select_set(other == obj)
    bpy.context.view_layer.objects.active = obj
    return obj


@contextmanager
def rebuilt(obj: bpy.types.Object, write: bool = True) -> Iterator[Any]:
    """The bmesh of an object in object mode; what is changed in it becomes the object's mesh, if wanted."""
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    for elements in (bm.verts, bm.edges, bm.faces):
        elements.ensure_lookup_table()
    try:
        yield bm
        if write:
            bm.to_mesh(obj.data)
    finally:
        bm.free()


def remove(obj: bpy.types.Object, gone: Callable[[Any], bool]) -> bpy.types.Object:
    """Delete the faces whose centre is accepted, and what hangs on them alone; return the object."""
    with rebuilt(obj) as bm:
        bmesh.ops.delete(bm, geom=[face for face in bm.faces if gone(face.calc_center_median())], context="FACES")
    return obj


def sphere(rim: int = 48) -> bpy.types.Object:
    """Add a unit sphere of quads, a blown-up cube, with `rim` (a multiple of 8) edges at z = 0."""
    size = rim // 4
    steps = np.tan(np.linspace(-0.25, 0.25, size + 1) * np.pi)
    numbers: dict[tuple[float, ...], int] = {}
    faces = []
    for axis, side in product(range(3), (-1.0, 1.0)):
        for i, j in product(range(size), repeat=2):
            face = []
            for u, v in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                point = np.roll([side, steps[u], steps[v]], axis)
                key = tuple(np.round(point / np.linalg.norm(point), 9) + 0.0)
                face.append(numbers.setdefault(key, len(numbers)))
            faces.append(face if side > 0.0 else face[::-1])
    return add(list(numbers), faces, "Sphere")


def grid_points(size: int = 8) -> Floats:
    """Return the vertices of a flat square grid of size × size quads over [−1, 1]²."""
    steps = np.linspace(-1.0, 1.0, size + 1)
    return np.array([(x, y, 0.0) for y in steps for x in steps])


def grid(size: int = 8) -> bpy.types.Object:
    """Add the grid of `grid_points`."""
    row = size + 1
    starts = [row * j + i for j in range(size) for i in range(size)]
    faces = [(start, start + 1, start + row + 1, start + row) for start in starts]
    return add(grid_points(size), faces, "Grid")


def domed_grid() -> tuple[bpy.types.Object, Mask]:
    """Add a grid with a bumpy surface without hard edges; return it and a selection away from the border."""
    obj = grid()
    points = positions(obj)
    points[:, 2] = 0.2 * np.cos(2.0 * points[:, 0]) + 0.1 * np.sin(5.0 * points[:, 1])
    move(obj, points)
    return obj, faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.7)


def bumpy_grid(size: int = 16) -> bpy.types.Object:
    """Add a grid with a hill as wide as it is."""
    obj = grid(size)
    points = positions(obj)
    points[:, 2] = 0.3 * np.cos(2.0 * points[:, 0]) * np.cos(1.5 * points[:, 1])
    move(obj, points)
    return obj


def select_edges(obj: bpy.types.Object, chosen: Callable[[Any], Any]) -> None:
    """Enter edit mode with exactly those of its bmesh's edges selected that `chosen` accepts."""
    bpy.context.tool_settings.mesh_select_mode = (False, True, False)
    enter(obj, np.zeros(len(obj.data.polygons), dtype=bool))
    bm = bmesh.from_edit_mesh(obj.data)
    for edge in bm.edges:
        edge.select_set(bool(chosen(edge)))
    bm.select_flush_mode()
    bmesh.update_edit_mesh(obj.data)


def positions(obj: bpy.types.Object) -> Floats:
    """Return the (n, 3) positions of a mesh in object mode."""
    flat = np.empty(3 * len(obj.data.vertices), dtype=np.float32)
    obj.data.vertices.foreach_get("co", flat)
    return flat.reshape(-1, 3).astype(np.float64)


def move(obj: bpy.types.Object, points: Any) -> None:
    """Set all positions of a mesh in object mode."""
    obj.data.vertices.foreach_set("co", np.asarray(points, dtype=np.float32).ravel())
    obj.data.update()


def faces_where(obj: bpy.types.Object, chosen: Callable[[Any], bool]) -> Mask:
    """Return the mask of the polygons whose centre `chosen` accepts."""
    return np.array([bool(chosen(polygon.center)) for polygon in obj.data.polygons])


def select(obj: bpy.types.Object, faces: Mask) -> None:
    """Select exactly these faces of a mesh in object mode, and their edges and vertices."""
    data = obj.data
    vertices = np.zeros(len(data.vertices), dtype=bool)
    edges = np.zeros(len(data.edges), dtype=bool)
    corners = [
        (data.loops[i].vertex_index, data.loops[i].edge_index)
        for face in np.flatnonzero(faces)
        for i in data.polygons[face].loop_indices
    ]
    for vertex, edge in corners:
        vertices[vertex] = edges[edge] = True
    data.polygons.foreach_set("select", faces.tolist())
    data.edges.foreach_set("select", edges.tolist())
    data.vertices.foreach_set("select", vertices.tolist())


def free_vertices(obj: bpy.types.Object, faces: Mask) -> Mask:
    """Return the vertices with chosen faces only, for a mesh without open border in them."""
    inside = np.zeros(len(obj.data.vertices), dtype=bool)
    outside = inside.copy()
    for polygon, chosen in zip(obj.data.polygons, faces, strict=True):
        (inside if chosen else outside)[list(polygon.vertices)] = True
    return inside & ~outside


def enter(obj: bpy.types.Object, faces: Mask) -> None:
    """Enter edit mode with exactly these faces selected."""
    select(obj, faces)
    edit(obj)


def edit(*objects: bpy.types.Object) -> None:
    """Enter edit mode with these objects."""
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj in objects)
    bpy.context.view_layer.objects.active = objects[0]
    bpy.ops.object.mode_set(mode="EDIT")


def leave() -> None:
    """Go back to object mode."""
    bpy.ops.object.mode_set(mode="OBJECT")


def fair(obj: bpy.types.Object, faces: Mask, **properties: Any) -> set[str]:
    """Run the operator on the faces, from and to object mode."""
    select(obj, faces)
    edit(obj)
    try:
        return run(**properties)
    finally:
        leave()


def run(**properties: Any) -> set[str]:
    """Run the operator in edit mode, with an undo step as from the user interface."""
    status: set[str] = bpy.ops.mesh.fair_region("EXEC_DEFAULT", True, **properties)
    return status


def report() -> Any:
    """Return the last run's report."""
    return bpy.context.window_manager.fairing_report


def contents(obj: bpy.types.Object) -> dict[str, bytes]:
    """Return every attribute, weight and shape key of a mesh in object mode as bytes."""
    data = {f"{a.domain} {a.name}": _bytes(a.data, *LAYOUT[a.data_type]) for a in obj.data.attributes}
    sizes = np.empty(len(obj.data.polygons), dtype=np.int32)
    obj.data.polygons.foreach_get("loop_total", sizes)
    data["sizes"] = sizes.tobytes()
    groups = [[(g.group, g.weight) for g in v.groups] for v in obj.data.vertices]
    data["weights"] = repr(groups).encode()
    for block in _blocks(obj.data):
        data[f"key {block.name}"] = _bytes(block.data, "co", 3, np.float32)
    return data


def _blocks(mesh: bpy.types.Mesh) -> Iterable[Any]:
    return mesh.shape_keys.key_blocks if mesh.shape_keys else ()


def _bytes(items: Any, name: str, width: int, dtype: Any) -> bytes:
    values = np.empty(len(items) * width, dtype=dtype)
    items.foreach_get(name, values)
    return values.tobytes()


def in_edit_mode_once(obj: bpy.types.Object, faces: Mask) -> dict[str, bytes]:
    """Return the contents after selecting and a visit to edit mode, which may add layers."""
    select(obj, faces)
    edit(obj)
    leave()
    return contents(obj)


def moved(before: dict[str, bytes], after: dict[str, bytes], name: str = "POINT position") -> Any:
    """Return which vertices changed a bit, asserting that no other layer did."""
    assert before.keys() == after.keys()
    assert [key for key in before if key != name and before[key] != after[key]] == []
    old, new = (np.frombuffer(c[name], np.uint32).reshape(-1, 3) for c in (before, after))
    return (old != new).any(axis=1)


def contents_in_edit_mode(name: str = "Grid") -> dict[str, bytes]:
    """Undo replaces objects: look this one up again, and visit object mode to read it."""
    assert bpy.context.mode == "EDIT_MESH"
    leave()
    found = contents(bpy.data.objects[name])
    bpy.ops.object.mode_set(mode="EDIT")
    return found
