"""Blender meshes to arrays and positions back; with live_mesh and selecting all that touches bmesh."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any

import bmesh
import bpy
import numpy as np

from ..arrays.region import MeshArrays, free_vertices
from ..arrays.types import Floats, Ints, Mask
from ..fair.held_curves import with_pinned_edges
from ..mirror.symmetry import with_image
from ..options.options import FairOptions
from ..selection.selection import enclosed_faces
from ..words.words import said
from .all_keys import follows, shown_offsets
from .columns import column, elements_of, flags, indices, stored
from .free_normals import put_at, renew_at, renew_mesh
from .levels import reflections
from .marked_lines import lines
from .set_aside import has_unreached
from .weights import group_index, group_weights, weighed

FEW = 8  # times as many vertices as were moved: normals of the whole mesh take longer than theirs, one by one

# Read and written as float32, which is what Blender stores; doubles in between.


@contextmanager
def snapshot(mesh: bpy.types.Mesh) -> Iterator[bpy.types.Mesh]:
    """Give a temporary object-mode copy of a mesh in edit mode, active shape key included."""
    copy = bpy.data.meshes.new("fairing snapshot")
    try:
        bmesh.from_edit_mesh(mesh).to_mesh(copy)
        yield copy
    finally:
        bpy.data.meshes.remove(copy)


def is_editable(mesh: bpy.types.Mesh) -> bool:
    """Return whether changes of the mesh are kept: not in one that is linked from another file, overridden or not."""
    return bool(mesh.is_editable and mesh.override_library is None)


def read_edit_mesh(
    obj: bpy.types.Object, options: FairOptions, faces: Ints | None = None, *, widens: bool = True
) -> MeshArrays:
    """Read the mesh of an object in edit mode; the patch is its selected, visible faces.

    faces: that stand in for the selection.
    widens: whether faces that selected edges enclose, or that X mirror adds, are selected as well.
    Raises ValueError where `options` name a vertex group that the object does not have.
    """
    with snapshot(obj.data) as mesh:
        group = group_index(obj, options.pin_group, "pin_group")
        if faces is not None:
            selected = np.isin(np.arange(len(mesh.polygons)), faces)
            arrays = _arrays(mesh, selected, group, options)
        elif widens:
            arrays = _selected(mesh, group, options)
        else:
            arrays = _arrays(mesh, flags(mesh, ".select_poly", mesh.polygons), group, options)
        arrays = replace(weighed(arrays, mesh, obj, options), mirror_x=obj.data.use_mirror_x)
        arrays = replace(arrays, reflections=reflections(obj), shown_offsets=shown_offsets(obj))
        return with_image(arrays) if widens and faces is None else arrays


def _selected(mesh: bpy.types.Mesh, group: int | None, options: FairOptions) -> MeshArrays:
    """Read a mesh with its selected faces, or with those that its selected edges enclose where no vertex is free."""
    arrays = _arrays(mesh, flags(mesh, ".select_poly", mesh.polygons), group, options)
    if free_vertices(arrays).any():
        return arrays
    enclosed = enclosed_faces(arrays, column(mesh.edges, "select", 1, bool))
    return _arrays(mesh, enclosed, group, options) if enclosed.any() else arrays


def read_shown_mesh(obj: bpy.types.Object, options: FairOptions) -> MeshArrays:
    """Read what is seen of an object: in edit mode its own mesh, else the one that its modifiers make."""
    if obj.data.is_editmode:
        return read_edit_mesh(obj, options)
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    try:
        return _arrays(mesh, np.ones(len(mesh.polygons), dtype=bool), None, options)
    finally:
        evaluated.to_mesh_clear()


def writable_key(obj: bpy.types.Object) -> str:
    """Return the name of the shape key that an object in edit mode shows; empty for the Basis, and without keys.

    Raises ValueError where that key is locked.
    """
    key = obj.active_shape_key
    if key is not None and key.lock_shape:
        raise ValueError(said("active_key_locked", name=key.name))
    return "" if key is None or key == obj.data.shape_keys.reference_key else key.name


def check_new_faces(obj: bpy.types.Object | None) -> None:
    """Raise ValueError where an object has something that new faces can't be given."""
    if obj is not None:
        has_unreached(obj.data)
    if obj is not None and any(modifier.type == "MULTIRES" for modifier in obj.modifiers):
        raise ValueError(said("multires"))


def edit_positions(mesh: bpy.types.Mesh) -> Floats:
    """Return the (n, 3) positions of a mesh in edit mode."""
    return shape_of(mesh).positions


@dataclass(frozen=True)
class Shape:
    """What tells whether a mesh has changed."""

    positions: Floats  # (n, 3)
    edges: Ints  # (e, 2)
    corner_vertices: Ints  # (c,)


def shape_of(mesh: bpy.types.Mesh) -> Shape:
    """Return that of a mesh in edit mode."""
    with snapshot(mesh) as now:
        return Shape(
            column(now.vertices, "co", 3, np.float32).astype(np.float64),
            stored(now, ".edge_verts", (now.edges, "vertices"), 2),
            stored(now, ".corner_vert", (now.loops, "vertex_index")),
        )


def is_unchanged(mesh: bpy.types.Mesh, before: Shape | MeshArrays) -> bool:
    """Return whether a mesh in edit mode still has the positions and corners that it had."""
    now = shape_of(mesh)
    same = np.array_equal(now.positions, before.positions, equal_nan=True) and len(now.edges) == len(before.edges)
    return bool(same and np.array_equal(now.corner_vertices, before.corner_vertices))


def read_mesh(mesh: bpy.types.Mesh, faces: Ints, options: FairOptions) -> MeshArrays:
    """Read a mesh in object mode; the patch is those of the polygons `faces` that are visible.

    Raises IndexError for a polygon that is not there, ValueError for a mesh that is in edit mode or not editable.
    """
    if not is_editable(mesh):
        raise ValueError(f"{mesh.name} can't be edited: it is linked from another file. Make it local first")
    if mesh.is_editmode:
        raise ValueError(f"{mesh.name} is in edit mode: leave it, or use bpy.ops.mesh.fair_region")
    selected = np.zeros(len(mesh.polygons), dtype=bool)
    if faces.size and not 0 <= faces.min() <= faces.max() < len(selected):
        raise IndexError(f"faces: expected polygon indices below {len(selected)}")
    selected[faces] = True
    user = user_of(mesh)
    arrays = _arrays(mesh, selected, group_index(user, options.pin_group, "pin_group"), options)
    arrays = replace(weighed(arrays, mesh, user, options), mirror_x=mesh.use_mirror_x)
    return replace(arrays, reflections=reflections(user))


def user_of(mesh: bpy.types.Mesh) -> bpy.types.Object | None:
    """Return an object that shows the mesh: vertex groups have their names there."""
    return next((obj for obj in bpy.data.objects if obj.data == mesh), None)


def _arrays(mesh: bpy.types.Mesh, selected: Mask, group: int | None, options: FairOptions) -> MeshArrays:
    sizes = indices(mesh.polygons, "loop_total")
    corner_vertices = stored(mesh, ".corner_vert", (mesh.loops, "vertex_index"))
    corner_faces = np.repeat(np.arange(len(sizes), dtype=np.int64), sizes)
    hidden = flags(mesh, ".hide_poly", mesh.polygons)
    in_patch = selected & ~hidden
    edges = stored(mesh, ".edge_verts", (mesh.edges, "vertices"), 2)
    custom = options.boundary_normals == "CUSTOM"
    sharp = _marked_edges(mesh, "SHARP")
    triangles, triangle_faces = _triangles(mesh, sizes, corner_vertices)
    arrays = MeshArrays(
        positions=column(mesh.vertices, "co", 3, np.float32).astype(np.float64),
        edges=edges,
        corner_vertices=corner_vertices,
        corner_edges=stored(mesh, ".corner_edge", (mesh.loops, "edge_index")),
        corner_faces=corner_faces,
        triangles=triangles,
        triangle_faces=triangle_faces,
        in_patch=in_patch,
        pinned=np.zeros(len(mesh.vertices), dtype=bool),
        corner_normals=_corner_normals(mesh) if custom else None,
        hidden=hidden if hidden.any() else None,
        textured=_is_textured(mesh, in_patch[corner_faces]) if options.inner_fairness == "AUTOMATIC" else False,
        sharp=sharp if sharp.any() else None,
    )
    if options.remesh:
        arrays = replace(arrays, lines=lines(mesh, arrays))
    return _pinned(arrays, mesh, group, options)


def _triangles(mesh: bpy.types.Mesh, sizes: Ints, corner_vertices: Ints) -> tuple[Ints, Ints]:
    """Return the triangles (t, 3) that Blender makes of the faces, and the faces (t,) they are of."""
    if (sizes == 3).all():  # Blender's own list takes a while to read
        return corner_vertices.reshape(-1, 3), np.arange(len(sizes), dtype=np.int64)
    mesh.calc_loop_triangles()
    return indices(mesh.loop_triangles, "vertices", 3), indices(mesh.loop_triangle_polygons, "value")


def _pinned(arrays: MeshArrays, mesh: bpy.types.Mesh, group: int | None, options: FairOptions) -> MeshArrays:
    """Return the arrays with their pins, and a note on a vertex group that holds none of the vertices inside."""
    arrays = with_pinned_edges(arrays, options, _marked_edges(mesh, options.pin_edges))
    arrays = replace(arrays, fair_border=options.fair_open_borders)
    if group is None:
        return arrays
    touched = np.unique(arrays.corner_vertices[arrays.in_patch[arrays.corner_faces]])
    pinned = arrays.pinned.copy()
    pins = np.flatnonzero(group_weights(mesh, group) > 0.0)
    pins = pins if options.moves_band else np.intersect1d(pins, touched)
    pinned[pins] = True
    if arrays.held_by_angle is not None:
        arrays = replace(arrays, held_by_angle=arrays.held_by_angle & ~np.isin(np.arange(len(pinned)), pins))
    if not len(touched) or free_vertices(arrays)[pins].any():
        return replace(arrays, pinned=pinned)
    return replace(arrays, pinned=pinned, notes=(said("pin_group_empty", name=options.pin_group),))


def _is_textured(mesh: bpy.types.Mesh, corners: Mask) -> bool:
    """Return whether the corners in the (c,) mask have places of their own on a UV map."""
    layer = mesh.uv_layers.active
    if layer is None or not corners.any():
        return False
    places = column(layer.uv, "vector", 2, np.float32)
    return all(bool(np.ptp(places[:, k][corners]) > 0.0) for k in range(2))  # rows of two take numpy many times longer


def _corner_normals(mesh: bpy.types.Mesh) -> Floats:
    normals: Floats = column(mesh.corner_normals, "vector", 3, np.float32).astype(np.float64)
    return normals


def _marked_edges(mesh: bpy.types.Mesh, kind: str) -> Mask:
    """Return the (e,) mask of the edges that one of the choices of pin_edges names."""
    if kind == "SHARP":
        return flags(mesh, "sharp_edge", mesh.edges)
    if kind == "SEAM":
        seams: Mask = column(mesh.edges, "use_seam", 1, bool)  # whose attribute has another name in some versions
        return seams
    crease = mesh.attributes.get("crease_edge") if kind == "CREASE" else None
    if crease is None:
        return np.zeros(len(mesh.edges), dtype=bool)
    positive: Mask = column(crease.data, "value", 1, np.float32) > 0.0
    return positive


def write_edit_mesh(mesh: bpy.types.Mesh, vertices: Ints, positions: Floats, normals: Floats | None = None) -> None:
    """Move the vertices (k,) of a mesh in edit mode to `positions` (k, 3), and only them.

    normals: free custom normals of the whole mesh, from which those there are taken; None: those of the new surface.
    """
    bm = bmesh.from_edit_mesh(mesh)
    bm.verts.ensure_lookup_table()
    _move(bm, vertices, positions)
    if normals is None:
        renew_at(bm, vertices)
    else:
        put_at(bm, vertices, normals)
    bmesh.update_edit_mesh(mesh, destructive=False)


def move_vertices(mesh: bpy.types.Mesh, vertices: Ints, positions: Floats) -> None:
    """Move the vertices (k,) of a mesh in edit mode to `positions` (k, 3) for a while: custom normals stay as set."""
    bm = bmesh.from_edit_mesh(mesh)
    bm.verts.ensure_lookup_table()
    _move(bm, vertices, positions)
    bmesh.update_edit_mesh(mesh, loop_triangles=True, destructive=False)


def move_vertices_back(mesh: bpy.types.Mesh, vertices: Ints, there: Floats, before: Floats) -> None:
    """Move those of the vertices (k,) that are still at `there` (k, 3) to where they were `before` (k, 3)."""
    bm = bmesh.from_edit_mesh(mesh)
    if not len(vertices) or len(bm.verts) <= vertices.max():
        return  # another mesh by now
    bm.verts.ensure_lookup_table()
    now = np.array([vertex.co[:] for vertex in elements_of(bm.verts, vertices)])
    same = (now == there).all(axis=1)
    move_vertices(mesh, vertices[same], before[same])


def _move(bm: bmesh.types.BMesh, vertices: Ints, positions: Floats) -> None:
    """Move the vertices (k,), whose lookup table is up to date, to `positions` (k, 3), and update the normals there."""
    table = bm.verts
    # One at a time: of many objects at a time Python's collector would look through all that there are.
    for vertex, position in zip(vertices.tolist(), zip(*positions.T.tolist(), strict=True), strict=True):
        table[vertex].co = position
    if FEW * len(vertices) < len(table):
        _update_normals_at(elements_of(table, vertices))
    else:
        bm.normal_update()


def _update_normals_at(moved: list[Any]) -> None:
    """Update the normals of some vertices, of their faces, and of these faces' vertices."""
    faces = {face for vertex in moved for face in vertex.link_faces}
    for face in faces:
        face.normal_update()
    for vertex in {vertex for face in faces for vertex in face.verts}:
        vertex.normal_update()


def write_mesh(mesh: bpy.types.Mesh, vertices: Ints, positions: Floats) -> None:
    """Move the vertices of a mesh in object mode.

    With shape keys the Basis moves, and the keys relative to it follow, as they do
    when Blender's own tools edit the Basis.
    """
    before = column(mesh.vertices, "co", 3, np.float32)
    after = before.copy()
    after[vertices] = positions
    mesh.vertices.foreach_set("co", after.ravel())
    if mesh.shape_keys is not None:
        _move_keys(mesh.shape_keys, vertices, after[vertices] - before[vertices], after)
    renew_mesh(mesh, vertices)
    mesh.update()


def _move_keys(keys: bpy.types.Key, vertices: Ints, offsets: Any, basis: Any) -> None:
    keys.reference_key.data.foreach_set("co", basis.ravel())
    if not keys.use_relative:
        return
    for block in keys.key_blocks:
        if follows(block, keys.reference_key):
            moved = column(block.data, "co", 3, np.float32)
            moved[vertices] += offsets
            block.data.foreach_set("co", moved.ravel())
