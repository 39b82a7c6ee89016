"""The ear and the face of Table 1: a boundary drawn on a head, and the mesh inside it at the paper's size."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

import fairing
import measures
import meshing
import polygon_mesh
from boundaries import Cut, Drawn, cut_along, ordered_loop
from polygon_mesh import FloatArray, IntArray, Mask
from polygons import read_polygons
from thinning import Thinner, flip_to_delaunay, thin, thin_curve

HEXAGON = 0.5 * np.sqrt(3)  # area per vertex of equilateral triangles with edges of length 1
SEEN = 6.0  # boundary edges: how far around the boundary the mesh is thinned too


@dataclass(frozen=True)
class Drawing:
    """What is cut out of a head: boundary, vertices wanted in all and on the boundary, subdivisions before.

    shown: how much of the head is kept round the boundary, as a multiple of its radius.
    """

    boundary: Drawn
    vertices: int
    on_boundary: int
    steps: int
    shown: float = np.inf


@dataclass(frozen=True)
class Region:
    """A head with a region to be faired.

    vertices (n, 3); normals (n, 3): averages of the adjacent triangles' before the mesh was thinned out; triangles
    (m, 3); own (k,) the region's triangles; loop (b,) its boundary in order.
    """

    vertices: FloatArray
    normals: FloatArray
    triangles: IntArray
    own: IntArray
    loop: IntArray


# Of ict_head.obj in (z, y), from its left, and of demosthenes-low-res.obj in (x, y), from the front; the files' units.
EAR = Drawing(
    Drawn(
        np.array([[2.5, 1.0], [2.2, 2.8], [1.2, 3.9], [-0.4, 4.2], [-1.7, 3.4], [-2.2, 1.7], [-1.7, -0.3],
                  [-0.4, -2.0], [1.0, -2.9], [2.2, -2.3], [2.6, -0.7]]),
        (2, 1), (9.19654, 2.67161, -1.26616),
    ),
    4665, 108, 2, 3.2,
)  # fmt: skip
FACE = Drawing(
    Drawn(
        np.array([[0.195, 1.7], [0.45, 1.62], [0.58, 1.35], [0.56, 1.05], [0.42, 0.78], [0.195, 0.66], [-0.03, 0.78],
                  [-0.17, 1.05], [-0.19, 1.35], [-0.06, 1.62]]),
        (0, 1), (0.195, 1.2, 0.95),
    ),
    2926, 130, 2,
)  # fmt: skip


def subdivided_head(path: Path, steps: int) -> tuple[FloatArray, IntArray]:
    """The head in the file; holes closed, Catmull–Clark steps, triangles."""
    vertices, faces = read_polygons(path)
    faces = polygon_mesh.closed(faces)
    for _ in range(steps):
        vertices, faces = polygon_mesh.catmull_clark(vertices, faces)
    return vertices, polygon_mesh.triangulated(vertices, faces)


def boundaryd(path: Path, drawing: Drawing) -> Region:
    """The head with the boundary in it, both sides of it thinned out to the wanted size."""
    vertices, triangles = subdivided_head(path, drawing.steps)
    cut = _around(cut_along(vertices, triangles, drawing.boundary), drawing.shown)
    keep = _evenly(cut, drawing.on_boundary)
    mesh = Thinner(cut.vertices, cut.triangles, [cut.curve])
    kept = set(keep.tolist())
    size = _sizes(cut, drawing)
    inside = np.setdiff1d(np.unique(cut.triangles[cut.inside]), cut.curve).tolist()
    outside, too_many = _outside(cut, drawing)
    thin_curve(mesh, kept)
    thin(mesh, outside, size, too_many)
    surplus = len(inside) + drawing.on_boundary - drawing.vertices
    gone = thin(mesh, inside, size, round(0.9 * surplus))
    flip_to_delaunay(mesh, {*mesh.along, *inside, *outside})
    thin_curve(mesh, kept)
    thin(mesh, inside, size, surplus - gone)
    flip_to_delaunay(mesh, {*mesh.along, *inside, *outside})
    return _packed(mesh, cut)


def _around(cut: Cut, reach: float) -> Cut:
    """Only the triangles near the boundary."""
    if not np.isfinite(reach):
        return cut
    rim = cut.vertices[cut.curve]
    centre = rim.mean(axis=0)
    radius = np.linalg.norm(rim - centre, axis=1).max()
    near = (np.linalg.norm(cut.vertices[cut.triangles] - centre, axis=2) < reach * radius).all(axis=1)
    return Cut(cut.vertices, cut.triangles[near | cut.inside], cut.inside[near | cut.inside], cut.curve)


def _evenly(cut: Cut, count: int) -> IntArray:
    """Curve vertices nearest to evenly spaced places."""
    rim = cut.vertices[cut.curve]
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.roll(rim, -1, axis=0) - rim, axis=1))])
    places = np.arange(count) * along[-1] / count
    return np.asarray(cut.curve[np.unique(np.abs(along[:-1, None] - places).argmin(axis=0))])


def _area(vertices: FloatArray, triangles: IntArray) -> float:
    return float(0.5 * np.linalg.norm(meshing.face_normals(vertices, triangles), axis=1).sum())


def _spacing(cut: Cut, drawing: Drawing) -> float:
    """Edge length of the boundary."""
    rim = cut.vertices[cut.curve]
    return float(np.linalg.norm(np.roll(rim, -1, axis=0) - rim, axis=1).sum() / drawing.on_boundary)


def _sizes(cut: Cut, drawing: Drawing) -> FloatArray:
    """Edge length wanted at each vertex: the outline's at the boundary, that of the wanted number inside."""
    rim = _spacing(cut, drawing)
    inner = np.sqrt(_area(cut.vertices, cut.triangles[cut.inside]) / (HEXAGON * drawing.vertices))
    away = cKDTree(cut.vertices[cut.curve]).query(cut.vertices)[0]
    within = np.zeros(len(cut.vertices), dtype=bool)
    within[cut.triangles[cut.inside]] = True
    return np.where(within, inner + (rim - inner) * np.exp(-((away / (2 * rim)) ** 2)), rim)


def _outside(cut: Cut, drawing: Drawing) -> tuple[list[int], int]:
    """Vertices outside near the boundary, and how many of them are too many for the outline's spacing."""
    rim = _spacing(cut, drawing)
    away = cKDTree(cut.vertices[cut.curve]).query(cut.vertices)[0]
    outer = cut.triangles[~cut.inside]
    near = (away[outer] < SEEN * rim).all(axis=1)
    free = np.setdiff1d(np.unique(outer[near]), np.concatenate([cut.curve, np.unique(outer[~near])]))
    wanted = _area(cut.vertices, outer[near]) / (HEXAGON * rim**2)
    return free.tolist(), max(0, len(free) - round(wanted))


def _packed(mesh: Thinner, cut: Cut) -> Region:
    """The mesh that is left, numbered afresh."""
    left = [k for k, face in enumerate(mesh.faces) if face]
    triangles = np.array([mesh.faces[k] for k in left])
    used, local = np.unique(triangles, return_inverse=True)
    local = local.reshape(-1, 3)
    own = np.flatnonzero(cut.inside[left])
    border = _curve_edges(local[own], np.isin(used, list(mesh.along)))
    normals = fairing.vertex_normals(cut.vertices, cut.triangles, normals="averaged")[used]
    return Region(cut.vertices[used], normals, local, own, ordered_loop(border))


def _curve_edges(triangles: IntArray, on_curve: Mask) -> IntArray:
    """Directed border edges of the region."""
    border = measures.border_edges(triangles)
    if not on_curve[border].all():
        raise ValueError("the region has a border beside its outline")
    return border
