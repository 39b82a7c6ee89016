"""Holes and selections cut at random into surfaces that are known."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import fairing
import real_meshes
import solids
from solids_at_random import FloatArray, IntArray, Mesh, blocks, plate, raised, swept

LARGEST = 400  # triangles of a part
LEAST = 6


@dataclass(frozen=True)
class Problem:
    """A part of a mesh, and what it should be.

    kind: what it is made of; is_hole: `inside` is to be filled, else to be faired; vertices, inside, outside: the mesh
    as it is given; truth: the part's surface.
    """

    name: str
    kind: str
    is_hole: bool
    vertices: FloatArray
    inside: IntArray
    outside: IntArray
    truth: Mesh

    @property
    def rim(self) -> IntArray:
        """The vertices of the boundary."""
        return np.intersect1d(self.inside, self.outside)

    @property
    def size(self) -> float:
        """The length of the box around them."""
        return float(np.linalg.norm(np.ptp(self.vertices[self.rim], axis=0)))


def problems(count: int, seed: int) -> Iterator[Problem]:
    """So many, one kind after the other."""
    holes = (_hole_in_swept, _hole_in_blocks, _hole_in_real, _hole_in_swept, _hole_in_blocks)
    makers = (*holes, _top, _boss, _dented, _pressed)
    for number in range(count):
        rng = np.random.default_rng([seed, number])
        made = None
        while made is None:
            made = makers[number % len(makers)](rng)
        yield Problem(f"{seed}.{number}", *made)


Parts = tuple[str, bool, FloatArray, IntArray, IntArray, Mesh]


def _hole_in_swept(rng: Any) -> Parts | None:
    return _hole("swept", swept(rng), rng)


def _hole_in_blocks(rng: Any) -> Parts | None:
    return _hole("blocks", blocks(rng), rng)


def _hole_in_real(rng: Any) -> Parts | None:
    whole = real_meshes.mesh(str(rng.choice(real_meshes.RANDOM_MESHES)))
    return _hole("real mesh", (whole.vertices, whole.triangles), rng)


def _hole(kind: str, mesh: Mesh, rng: Any) -> Parts | None:
    """Around a vertex, more often one at which the mesh bends; noise of up to .05 edges on every third mesh."""
    vertices, triangles = mesh
    part = ball(mesh, rng)
    if part is None:
        return None
    given = vertices
    if kind != "real mesh" and rng.random() < 1 / 3:
        given = _shaken(mesh, rng.uniform(0.01, 0.05), rng)
    return kind, True, given, triangles[part], triangles[~part], (vertices, triangles[part])


def _top(rng: Any) -> Parts | None:
    """A whole smooth side of a solid, up to its hard edges, dented; noise of up to .05 edges on every other one."""
    clean = _solid(rng)
    part = side_of(clean, rng)
    if not LEAST < part.sum() < 3 * LARGEST or part.all():
        return None
    return _worsened("side", clean, part, rng)


def _solid(rng: Any) -> Mesh:
    if rng.random() < 0.5:
        return blocks(rng)
    return solids.domed(int(rng.integers(12, 40)), int(rng.integers(4, 9)), rng.uniform(0.0, 0.7))


def _dented(rng: Any) -> Parts | None:
    """A part of a real mesh or a plate, dented or noisy."""
    if rng.random() < 0.5:
        mesh = plate(rng)
        kind = "plate"
    else:
        whole = real_meshes.mesh(str(rng.choice(real_meshes.RANDOM_MESHES)))
        mesh, kind = (whole.vertices, whole.triangles), "real mesh, dented"
    part = ball(mesh, rng)
    return None if part is None else _worsened(kind, mesh, part, rng)


def _worsened(kind: str, clean: Mesh, part: NDArray[np.bool_], rng: Any) -> Parts | None:
    vertices, triangles = clean
    rim = np.intersect1d(triangles[part], triangles[~part])
    free = np.setdiff1d(triangles[part], triangles[~part])
    if len(free) < 4:
        return None
    given = _shaken(clean, rng.uniform(0.01, 0.05), rng) if rng.random() < 0.5 else vertices.copy()
    normals = fairing.vertex_normals(vertices, triangles[part], normals="averaged")
    size = np.linalg.norm(np.ptp(vertices[rim], axis=0))
    middle = vertices[free[int(rng.integers(len(free)))]]
    reach = size * rng.uniform(0.1, 0.3)
    share = np.exp(-(((vertices[free] - middle) ** 2).sum(axis=1) / reach**2))
    inwards = np.min([np.linalg.norm(vertices[free] - place, axis=1) for place in vertices[rim]], axis=0)
    share *= np.clip(4.0 * inwards / size - 0.2, 0.0, 1.0) ** 2  # what is beside the boundary is as it should be
    given[free] += (rng.uniform(-0.25, 0.25) * size * share)[:, None] * normals[free]
    return kind, False, given, triangles[part], triangles[~part], (vertices, triangles[part])


def _boss(rng: Any) -> Parts:
    """A boss or a pocket, selected with its walls up to the plate; the plate is right."""
    made = raised(rng)
    vertices, triangles = made.mesh
    return (
        "boss", False, vertices, triangles[made.part], triangles[~made.part],
        (made.plate[0], made.plate[1][made.under]),
    )  # fmt: skip


def _pressed(rng: Any) -> Parts | None:
    """A dent or a swelling of a plate that ends in a crease, along a jagged outline; the plate is right."""
    vertices, triangles = plate(rng)
    centre, reach = rng.uniform(0.35, 0.65, 2), rng.uniform(0.15, 0.3)
    away = np.linalg.norm(vertices[:, :2] - centre, axis=1) / reach
    part = (away < 1.0)[triangles].all(axis=1)
    free = np.setdiff1d(triangles[part], triangles[~part])
    if len(free) < 4:
        return None
    given = vertices.copy()
    slope = np.tan(np.radians(rng.uniform(20, 70))) * rng.choice([-1, 1])
    given[free, 2] += 0.5 * slope * reach * (1.0 - away[free] ** 2)
    return "pressed", False, given, triangles[part], triangles[~part], (vertices, triangles[part])


def _shaken(mesh: Mesh, share: float, rng: Any) -> FloatArray:
    vertices, triangles = mesh
    edge = np.linalg.norm(vertices[triangles[:, 0]] - vertices[triangles[:, 1]], axis=1).mean()
    return vertices + rng.normal(scale=share * edge, size=vertices.shape)


def bends(mesh: Mesh) -> tuple[IntArray, FloatArray]:
    """(e, 2) triangles beside each inner edge, and the degrees (e,) between them."""
    vertices, triangles = mesh
    sides = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    order = np.lexsort(sides.T)
    same = (sides[order][1:] == sides[order][:-1]).all(axis=1)
    pairs = np.column_stack([order[:-1][same] // 3, order[1:][same] // 3])
    corners = vertices[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    cosines = (normals[pairs[:, 0]] * normals[pairs[:, 1]]).sum(axis=1)
    return pairs, np.degrees(np.arccos(np.clip(cosines, -1, 1)))


def side_of(mesh: Mesh, rng: Any) -> NDArray[np.bool_]:
    """The triangles that hang together with one of them over edges that bend by less than 20°."""
    pairs, angles = bends(mesh)
    return _reached(len(mesh[1]), pairs[angles < 20.0], int(rng.integers(len(mesh[1]))))


def _reached(count: int, pairs: IntArray, start: int) -> NDArray[np.bool_]:
    found = np.zeros(count, dtype=bool)
    found[start] = True
    while True:
        more = pairs[found[pairs].any(axis=1)]
        if found[more].all():
            return found
        found[more] = True


def ball(mesh: Mesh, rng: Any) -> NDArray[np.bool_] | None:
    """Triangles around a vertex, bounded by one loop; None where there are too many, too few or several loops."""
    vertices, triangles = mesh
    pairs, angles = bends(mesh)
    centre = pairs[int(rng.choice(len(pairs), p=(weights := 5.0 + angles) / weights.sum()))][0]
    middle = vertices[triangles[centre, 0]]
    corners = np.linalg.norm(vertices[triangles] - middle, axis=2).max(axis=1)
    wanted = int(np.exp(rng.uniform(np.log(2 * LEAST), np.log(0.7 * LARGEST))))
    near = corners < np.partition(corners, min(wanted, len(corners) - 1))[min(wanted, len(corners) - 1)]
    if not near[centre]:
        return None
    part = _reached(len(triangles), pairs[near[pairs].all(axis=1)], int(centre))
    loops = fairing.boundary_loops(triangles[part])
    rim = np.concatenate(loops) if loops else np.empty(0, int)
    closed = np.isin(rim, triangles[~part]).all() and len(np.unique(rim)) == len(rim)
    border = np.concatenate([*fairing.boundary_loops(triangles), np.empty(0, int)])
    if len(loops) != 1 or not closed or np.isin(rim, border).any() or not LEAST < part.sum() < LARGEST:
        return None
    return part
