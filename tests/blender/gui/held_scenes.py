"""What the chapters on curves, pins, borders and copies play on."""

from __future__ import annotations

import bmesh
import bpy
import numpy as np
import scenes
from spoilt_scenes import centres, move, object_positions


def box_corner(size: int = 16) -> int:
    """A cube with sharp edges, hammered at one corner: the faces around the corner are selected."""
    scenes.clear()
    bpy.ops.mesh.primitive_cube_add(size=2.0)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.subdivide(number_cuts=size - 1)
    bpy.ops.object.mode_set(mode="OBJECT")
    mesh = bpy.context.object.data
    at_side = np.isclose(np.abs(object_positions()), 1.0)
    on_edge = at_side.sum(axis=1) > 1
    ends = np.array([edge.vertices[:] for edge in mesh.edges])
    sharp = at_side[ends].all(axis=1).sum(axis=1) == 2  # both ends on the same two sides
    mesh.edges.foreach_set("use_edge_sharp", sharp)
    near = np.abs(centres() - [1.0, -1.0, 1.0]).max(axis=1) < 1.2
    inside = np.linalg.norm(object_positions() - [1.0, -1.0, 1.0], axis=1) < 1.0
    random = np.random.default_rng(7)

    def hammered(points: np.ndarray) -> np.ndarray:
        hit = inside & ~on_edge
        points[hit] += random.normal(0.0, 0.05, (np.count_nonzero(hit), 3))
        return points

    move(hammered)
    return scenes.start(near)


def lifted_pin() -> int:
    """The plain with its pinned middle lifted."""
    scenes.hill()
    bpy.ops.object.mode_set(mode="OBJECT")
    move(lambda points: points + [0.0, 0.0, 0.3] * (np.linalg.norm(points, axis=1, keepdims=True) < 1e-6))
    chosen = np.linalg.norm(centres()[:, :2], axis=1) < 0.8
    return scenes.start(chosen)


def lifted_curve(size: int = 60) -> int:
    """A plain with a wavy line of edges, marked as a seam and lifted, inside the selection."""
    scenes.clear()
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=size, y_subdivisions=size, size=3.0)
    mesh = bpy.context.object.data
    chosen = (np.abs(object_positions()[:, 0]) < 0.01) & (np.abs(object_positions()[:, 1]) < 0.52)
    ends = np.array([edge.vertices[:] for edge in mesh.edges])
    mesh.edges.foreach_set("use_seam", chosen[ends].all(axis=1))

    def lifted(points: np.ndarray) -> np.ndarray:
        y = points[chosen, 1]
        points[chosen, 2] = 0.3
        points[chosen, 0] += 0.2 * np.sin(6.0 * y)
        return points

    move(lifted)
    return scenes.start(np.abs(centres()[:, :2]).max(axis=1) < 0.9)


def porthole() -> int:
    """A ball with a round opening, crumpled around it; the faces there are selected, up to the open border."""
    scenes.clear()
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=48, rotation=(0.9, 0.0, 0.3))
    _cut(np.flatnonzero(centres()[:, 2] > 0.83))
    random = np.random.default_rng(3)

    def crumpled(points: np.ndarray) -> np.ndarray:
        near = points[:, 2] > 0.62
        points[near] += random.normal(0.0, 0.006, (np.count_nonzero(near), 3))
        return points

    chosen = centres()[:, 2] > 0.55
    move(crumpled)
    return scenes.start(chosen)


def _cut(faces: np.ndarray) -> None:
    mesh = bpy.context.object.data
    bm = bmesh.new()
    bm.from_mesh(mesh)
    bm.faces.ensure_lookup_table()
    bmesh.ops.delete(bm, geom=[bm.faces[face] for face in faces.tolist()], context="FACES")
    bm.to_mesh(mesh)
    bm.free()


def bending_bottle() -> None:
    """The bottle in object mode, its shoulder a vertex group, bent by a modifier that is animated over 20 frames."""
    scenes.bottle()
    bpy.ops.object.mode_set(mode="OBJECT")
    obj = bpy.context.object
    heights = object_positions()[:, 2]
    shoulder = np.flatnonzero((heights > -0.2001) & (heights < 0.6001))
    obj.vertex_groups.new(name="Shoulder").add(shoulder.tolist(), 1.0, "REPLACE")
    bend = obj.modifiers.new("Bend", "SIMPLE_DEFORM")
    bend.deform_method, bend.deform_axis = "BEND", "X"
    for frame, angle in ((1, 0.0), (20, 1.2)):
        bend.angle = angle
        bend.keyframe_insert("angle", frame=frame)
    bpy.ops.ed.undo_push(message="scene")
