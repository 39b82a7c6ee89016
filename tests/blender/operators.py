"""The operators as rows of a table: a scene with its selection in edit mode, and options of three runs."""

import numpy as np

import meshes
from changes import Kind
from test_denoise import every, rough_ball
from test_fill import open_sphere, select_vertices, tubes
from test_fillet import cube, edge_mask, upright
from test_fillet import enter as enter_fillet
from test_from_curves import circles, wired


def _fillet() -> None:
    obj = cube()
    enter_fillet(obj, edge_mask(obj, upright))


def _curves() -> None:
    obj = wired(circles(16))
    meshes.select_edges(obj, lambda _: True)


def _keys() -> None:
    obj, faces = meshes.domed_grid()
    obj.shape_key_add(name="Basis")
    points = meshes.positions(obj)
    points[:, 2] += 0.3 * np.cos(3.0 * points[:, 0])
    obj.shape_key_add(name="Bent").data.foreach_set("co", points.ravel())
    meshes.enter(obj, faces)


def _denoise() -> None:
    obj = rough_ball()
    meshes.enter(obj, every(obj))


KINDS = {
    "region": Kind(refused={"shape": "HARMONIC", "bulge": 5.0}),
    "fill": Kind(
        "fair_fill", "fill.operator", lambda: select_vertices(open_sphere(), lambda _: True), {}, {"spacing": 1.5},
        {"quads": True}, {"longest": 1},
    ),
    "fillet": Kind(
        "fair_fillet", "fillet.operator", _fillet, {"width": 0.3}, {"width": 0.4}, {"profile": 0.5}, {"width": 1e3},
    ),
    "curves": Kind(
        "fair_from_curves", "curves.operator", _curves, {}, {"spacing": 1.5}, {"quads": True},
    ),
    "new mesh": Kind(
        first={"remesh": True}, second={"spacing": 1.5}, third={"quads": True},
    ),
    "all keys": Kind(enter=_keys, first={"all_keys": True}),
    "denoise": Kind("fair_denoise", "denoise.operator", _denoise, {}, {"amount": 0.5}, {"size": 0.5}),
}  # fmt: skip
BRIDGE = Kind(
    "fair_fill", "fill.operator", lambda: select_vertices(tubes(), lambda co: abs(co.z) < 0.6), {"bridge": True}
)
EVERY = {**KINDS, "bridge": BRIDGE}
