"""Bridges and real holes: docs/fill.md.

Real meshes lie beside the checkout, in shared/data; without them their rows are left out.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import bmesh
import bpy
import numpy as np
from mathutils import Vector

import demo_pictures as pictures
import tools
from rivals import cut_along, rewritten
from rows import Chosen, Points, Row, placed

DATA = Path(__file__).resolve().parents[3] / "shared" / "data"


UP, DOWN = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)


def tube(at: Points, towards: Points, radius: float) -> None:
    """A short open tube that begins at a place and leads away from it."""
    axis = np.array(towards) / np.linalg.norm(towards)
    middle = np.array(at) + 0.4 * axis
    bpy.ops.mesh.primitive_cylinder_add(
        vertices=40, radius=radius, depth=0.8, location=middle.tolist(),
        rotation=Vector(axis).to_track_quat("Z", "Y").to_euler(), end_fill_type="NOTHING",
    )  # fmt: skip
    bpy.ops.object.transform_apply(location=True, rotation=True)


def bridged(*tubes: tuple[Any, Any, float]) -> Callable[[], Chosen]:
    """Tubes by place, direction and radius; their loops at these places are selected."""

    def scene() -> Chosen:
        for each in tubes:
            tube(*each)
        for obj in bpy.context.scene.objects:
            obj.select_set(obj.type == "MESH")
        bpy.ops.object.join()
        cut_along(0.5, 9)
        pictures.add_camera((0.0, 0.0, 0.0), (0.5, -1.0, 0.7), 3.4)
        ends = [np.array(at) for at, _, _ in tubes]
        widest = 1.01 * max(radius for _, _, radius in tubes)

        def near(edge: Any) -> bool:
            middle = np.mean([vertex.co for vertex in edge.verts], axis=0)
            return bool(edge.is_boundary and min(np.linalg.norm(middle - end) for end in ends) < widest)

        return near

    return scene


def arms(count: int) -> Callable[[], Chosen]:
    """So many tubes around one middle."""
    turns = 2.0 * np.pi * (np.arange(count) + 0.25) / count
    rays = [np.array([np.cos(turn), np.sin(turn), 0.0]) for turn in turns]
    return bridged(*((0.75 * ray, ray, 0.4) for ray in rays))


def real(name: str, seed: int) -> bpy.types.Object:
    """A mesh of shared/data, of size 2 around the vertex `seed`."""
    lines = (DATA / f"{name}.obj").read_text().splitlines()
    points = np.array([line.split()[1:4] for line in lines if line.startswith("v ")], dtype=np.float64)
    faces = [[int(word.split("/")[0]) - 1 for word in line.split()[1:]] for line in lines if line.startswith("f ")]
    points -= points[seed]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata((2.0 * points / np.ptp(points, axis=0).max()).tolist(), [], faces)
    return placed(mesh)


def cut_out(name: str, seed: int, radius: float, direction: tuple[float, float, float]) -> Callable[[], Chosen]:
    """A real mesh with a hole around a vertex, of a radius in parts of the mesh's size; the rim is selected."""

    def scene() -> Chosen:
        real(name, seed)

        def cut(bm: Any) -> None:
            inside = [face for face in bm.faces if face.calc_center_median().length < 2.0 * radius]
            bmesh.ops.delete(bm, geom=inside, context="FACES")

        rewritten(cut)
        pictures.add_camera((0.0, 0.0, 0.0), direction, 7.0 * radius)
        return lambda edge: bool(edge.is_boundary and all(v.co.length < 2.6 * radius for v in edge.verts))

    return scene


BRIDGE, FILL = {"Fair Fill, Bridge": tools.fair_bridge}, {"Fair Fill": tools.fair_fill}
SHEETS = {
    "fill_bridges": [
        [
            Row("Two radii", bridged(((-0.5, 0, -0.4), DOWN, 0.5), ((0.4, 0, 0.4), UP, 0.3)), "edges", BRIDGE),
            Row("A gap", bridged(((0, 0, -0.5), DOWN, 0.4), ((0, 0, 0.5), UP, 0.4)), "edges", BRIDGE),
        ],
        [Row("Three tubes", arms(3), "edges", BRIDGE), Row("Four tubes", arms(4), "edges", BRIDGE)],
    ],
}  # fmt: skip
REAL = {
    "fill_holes": [
        [
            Row("A skull", cut_out("skull_low_resolution", 5112, 0.11, (0.5, 0.9, 0.6)), "edges", FILL),
            Row("A head", cut_out("ict_head", 10527, 0.15, (0.7, 1.0, 0.5)), "edges", FILL),
        ],
        [
            Row("A bust", cut_out("demosthenes-low-res", 3323, 0.11, (0.3, -0.3, 1.0)), "edges", FILL),
            Row("A shoulder", cut_out("mh_body", 8235, 0.06, (0.9, 0.7, 0.6)), "edges", FILL),
        ],
    ],
}
if DATA.exists():
    SHEETS |= REAL
