"""What the tutorial begins with: eight objects, and what of them is selected."""

from collections.abc import Callable
from itertools import pairwise
from typing import Any, NamedTuple

import bmesh
import bpy
import numpy as np

import demo_pictures as pictures
import demo_scenes as scenes
import hard
import rivals
import tools
from rows import Chosen, Points, moved, placed

HOLES = 13
SWELLING = (0.45, -0.75, 0.5)  # direction of it, from the middle of the ball


class Scene(NamedTuple):
    """Makes and activates the object; kind: "verts", "edges" or "faces", of which what it returns chooses."""

    make: Callable[[], Chosen]
    kind: str


def nothing(_: Any) -> bool:
    """Choose none."""
    return False


def scan() -> Chosen:
    """A head of triangles of one size, with holes in it as a scanner leaves them."""
    head = scenes.suzanne()
    head.data.remesh_voxel_size = 0.035
    bpy.ops.object.voxel_remesh()
    while head.data.uv_layers:
        head.data.uv_layers.remove(head.data.uv_layers[0])
    rivals.rewritten(lambda bm: bmesh.ops.triangulate(bm, faces=bm.faces[:]))
    for _ in range(4):
        rivals.rewritten(lambda bm: bmesh.ops.smooth_vert(bm, verts=bm.verts[:], factor=0.5, use_axis_x=True,
                                                          use_axis_y=True, use_axis_z=True))  # fmt: skip
    rivals.rewritten(with_holes)
    head.data.shade_smooth()
    pictures.add_camera((0.0, 0.0, 0.0), (0.55, -1.0, 0.25), 3.1)
    return nothing


def with_holes(bm: Any) -> None:
    """Cut HOLES ragged holes out of a closed mesh: where it is smooth, as far from each other as they come."""
    random = np.random.default_rng(13)
    bm.normal_update()
    points = np.array([vertex.co for vertex in bm.verts])
    normals = np.array([vertex.normal for vertex in bm.verts])
    radii = np.linspace(0.09, 0.17, HOLES)
    turned = [np.linalg.norm(normals[np.linalg.norm(points - at, axis=1) < 0.24].mean(axis=0)) for at in points]
    smooth = np.flatnonzero(np.array(turned) > 0.93)
    seeds = [int(smooth[points[smooth, 1].argmin()])]
    while len(seeds) < HOLES:
        distance = np.linalg.norm(points[smooth, None] - points[seeds], axis=2).min(axis=1)
        seeds.append(int(smooth[distance.argmax()]))
    bm.faces.ensure_lookup_table()
    centres = np.array([face.calc_center_median() for face in bm.faces])
    gone = np.zeros(len(centres), dtype=bool)
    for seed, radius in zip(seeds, radii, strict=True):
        ragged = radius * random.uniform(0.9, 1.1, len(centres))
        gone |= np.linalg.norm(centres - points[seed], axis=1) < ragged
    bmesh.ops.delete(bm, geom=[bm.faces[k] for k in np.flatnonzero(gone)], context="FACES")
    drop_loose_corners(bm)


def drop_loose_corners(bm: Any) -> None:
    """Remove faces at which a border touches itself, or that hang by one edge, until there are none."""
    while True:
        pinched = {v for v in bm.verts if sum(edge.is_boundary for edge in v.link_edges) > 2}
        hanging = [f for f in bm.faces if sum(e.is_boundary for e in f.edges) > 1 or pinched & set(f.verts)]
        if not hanging:
            return
        bmesh.ops.delete(bm, geom=hanging, context="FACES")


def pores() -> Chosen:
    """A ball with pores all over, and a swelling."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=7, radius=1.0)
    bpy.context.object.data.shade_smooth()
    towards = np.array(SWELLING) / np.linalg.norm(SWELLING)

    def swollen(points: Points) -> Points:
        unit = points / np.linalg.norm(points, axis=1, keepdims=True)
        away = np.arccos(np.clip(unit @ towards, -1.0, 1.0))
        return unit * (1.0 + 0.12 * np.exp(-((away / 0.32) ** 2)) - pore_depths(unit))[:, None]

    moved(swollen)
    pictures.add_camera((0.0, 0.0, 0.05), (0.95, -1.0, 0.45), 2.4)
    return lambda face: bool(np.array(face.calc_center_median()) @ towards > 0.62 * face.calc_center_median().length)


def pore_depths(unit: Points) -> Points:
    """How deep pores go at (n, 3) points of the unit sphere: dimples a little off Fibonacci's spiral."""
    random = np.random.default_rng(6)
    count = 1500
    height = 1.0 - (2.0 * np.arange(count) + 1.0) / count
    turn = np.pi * (1.0 + 5.0**0.5) * np.arange(count)
    flat = np.sqrt(1.0 - height**2)
    middles = np.column_stack([flat * np.cos(turn), flat * np.sin(turn), height])
    middles += random.normal(0.0, 0.012, middles.shape)
    depths = np.zeros(len(unit))
    for middle, depth in zip(middles, random.uniform(0.006, 0.014, count), strict=True):
        distance2 = ((unit - middle) ** 2).sum(axis=1)
        near = distance2 < 0.01
        depths[near] += depth * np.exp(-distance2[near] / 0.024**2)
    return depths


def bottle() -> Chosen:
    """A bottle, its shoulder selected."""
    radii = [(0.8, -1.3), (0.8, -0.2), (0.3, 0.6), (0.3, 1.3)]
    counts = (24, 16, 16)
    profile = [
        (r0 + (r1 - r0) * k / count, z0 + (z1 - z0) * k / count)
        for ((r0, z0), (r1, z1)), count in zip(pairwise(radii), counts, strict=True)
        for k in range(count)
    ]
    around = 64
    angles = 2.0 * np.pi * np.arange(around) / around
    points = [(r * np.cos(a), r * np.sin(a), z) for r, z in [*profile, radii[-1]] for a in angles]
    faces = [
        (k * around + j, k * around + (j + 1) % around, (k + 1) * around + (j + 1) % around, (k + 1) * around + j)
        for k in range(len(profile))
        for j in range(around)
    ]
    mesh = bpy.data.meshes.new("Bottle")
    mesh.from_pydata(points, [], faces)
    placed(mesh)
    pictures.add_camera((0.1, 0.0, 0.15), (0.35, -1.0, 0.35), 3.5)
    return lambda face: bool(-0.2 < face.calc_center_median().z < 0.6)


SCENES = {
    "ear": Scene(rivals.ear, "faces"),
    "panel": Scene(rivals.panel, "faces"),
    "scan": Scene(scan, "faces"),
    "seam": Scene(rivals.seam, "edges"),
    "pipes": Scene(rivals.pipes, "edges"),
    "pores": Scene(pores, "faces"),
    "edge": Scene(hard.box_edge, "edges"),
    "bottle": Scene(bottle, "faces"),
}


def begin(name: str, *, camera: bool = False) -> None:
    """Make one lesson's object in the open file, select, and leave edit mode; the camera is for pictures."""
    tools.select(SCENES[name].kind, SCENES[name].make())
    bpy.ops.object.mode_set(mode="OBJECT")
    if not camera:
        bpy.data.objects.remove(bpy.context.scene.camera)
