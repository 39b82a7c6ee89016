"""Meshes that are solved although they look as if they shouldn't be: one generator for each.

An `Input` is a complete call; its `shape` is the exact or clean answer where there is one.
"""

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

import fairing
from curves import FloatArray
from meshing import IntArray
from shapes import Patch

# All kinds of requests for a surface: both methods, each kind of inner fairness.
KINDS = ("uniform", "conformal", "inverse_distance")
WAYS = [(method, kind) for method in ("global", "paper") for kind in KINDS]


@dataclass(frozen=True, repr=False)
class Input:
    """vertices (n, 3), triangles (m, 3), fixed (k,), fixed_normals (k, 3), reference (n, 3)."""

    vertices: FloatArray
    triangles: IntArray
    fixed: IntArray
    normals: FloatArray | None
    reference: FloatArray | None = None
    options: dict[str, Any] = field(default_factory=dict)

    def __repr__(self) -> str:
        return f"<{len(self.vertices)} vertices, {len(self.triangles)} triangles, {len(self.fixed)} fixed>"

    def fair(self, **options: Any) -> fairing.FairResult:
        """Solve, and see that what must stay stayed: the arrays given, and all that is not free."""
        given = [np.copy(self.vertices), np.copy(self.triangles), np.copy(self.fixed)]
        try:
            result = fairing.fair(
                given[0], given[1],
                fixed=given[2], fixed_normals=self.normals, reference=self.reference, **{**self.options, **options},
            )  # fmt: skip
        finally:
            for mine, theirs in zip((self.vertices, self.triangles, self.fixed), given, strict=True):
                assert mine.tobytes() == theirs.tobytes()
        used = np.isin(np.arange(len(self.vertices)), self.triangles)
        held = ~used
        held[result.fixed] = True
        assert result.vertices[held].tobytes() == self.vertices[held].tobytes()
        assert np.isfinite(result.vertices[used & np.isfinite(self.vertices).all(axis=1)]).all()
        return result

    def changed(self, **fields: Any) -> "Input":
        """The same with other fields."""
        return replace(self, **fields)


def of_patch(patch: Patch) -> "Input":
    """An exact patch, to be found again; weights belong to its own mesh."""
    return Input(patch.vertices, patch.triangles, patch.fixed, patch.fixed_normals, patch.vertices)


def on_sphere(free: FloatArray, rim: FloatArray, triangles: IntArray) -> "Input":
    """Points (n, 3) of the unit sphere, free ones first, then the rim."""
    vertices = np.vstack([free, rim])
    fixed = np.arange(len(free), len(vertices))
    return Input(vertices, triangles, fixed, rim, vertices)


def circle(count: int, polar: float) -> FloatArray:
    """Points (count, 3) of the unit sphere at a polar angle in radians."""
    angle = 2 * np.pi * np.arange(count) / count
    around = np.column_stack([np.cos(angle), np.sin(angle)])
    return np.column_stack([np.sin(polar) * around, np.full(count, np.cos(polar))])


POLE = np.array([[0.0, 0.0, 1.0]])


def single_fan(valence: int, polar: float = 0.5) -> "Input":
    """One free vertex, the pole of a spherical cap; its neighbours are the rim."""
    rim = 1 + np.arange(valence)
    triangles = np.column_stack([np.zeros(valence, dtype=int), rim, np.roll(rim, -1)])
    return on_sphere(POLE, circle(valence, polar), triangles)


def fan(valence: int) -> "Input":
    """A pole of the given valence, then three rings of free vertices; the rim lies 45° from the pole."""
    rings = 3
    polar = np.linspace(0.0, np.pi / 4, rings + 2)[1:]
    points = np.vstack([POLE, *(circle(valence, angle) for angle in polar)])
    index = 1 + np.arange((rings + 1) * valence).reshape(rings + 1, valence)
    ahead = np.roll(index, -1, axis=1)
    top = np.column_stack([np.zeros(valence, dtype=int), index[0], ahead[0]])
    lower = np.stack([index[:-1], index[1:], ahead[1:]], axis=-1).reshape(-1, 3)
    upper = np.stack([index[:-1], ahead[1:], ahead[:-1]], axis=-1).reshape(-1, 3)
    free = 1 + rings * valence
    return on_sphere(points[:free], points[free:], np.vstack([top, lower, upper]))


def subdivided(item: Input, rounds: int) -> "Input":
    """Every triangle split in three at its centre, projected to the unit sphere: clusters of valence 3."""
    vertices, triangles = item.vertices, item.triangles
    for _ in range(rounds):
        centres = vertices[triangles].mean(axis=1)
        centres /= np.linalg.norm(centres, axis=1)[:, None]
        new = len(vertices) + np.arange(len(triangles))
        vertices = np.vstack([vertices, centres])
        triangles = np.vstack([np.column_stack([triangles[:, [k, (k + 1) % 3]], new]) for k in range(3)])
    return replace(item, vertices=vertices, triangles=triangles, reference=vertices)


def with_fin(item: Input) -> "Input":
    """A single triangle stands on the edge between the first two fixed vertices; its third vertex is new."""
    a, b = item.fixed[:2]
    vertices = np.vstack([item.vertices, 1.5 * item.vertices[[a]]])
    triangles = np.vstack([item.triangles, [[a, b, len(item.vertices)]]])
    return replace(item, vertices=vertices, triangles=triangles, reference=None)


def with_pocket(item: Input, turned: bool) -> "Input":
    """A fin of two triangles on the same three vertices, wound alike or (`turned`) against each other."""
    fin = with_fin(item)
    other = fin.triangles[[-1]][:, [1, 0, 2]] if turned else fin.triangles[[-1]]
    return replace(fin, triangles=np.vstack([fin.triangles, other]))


def beside(item: Input, triangles: IntArray, count: int, vertices: FloatArray | None = None) -> "Input":
    """Another piece whose vertices are all fixed (a triangle's corners by default), at some distance."""
    more = np.eye(3)[:count] if vertices is None else vertices
    first, extra = len(item.vertices), np.arange(len(item.vertices), len(item.vertices) + count)
    normals = None if item.normals is None else np.vstack([item.normals, np.ones((count, 3))])
    return replace(
        item,
        vertices=np.vstack([item.vertices, more + 5.0]),
        triangles=np.vstack([item.triangles, triangles + first]),
        fixed=np.concatenate([item.fixed, extra]),
        normals=normals,
        reference=None if item.reference is None else np.vstack([item.reference, more + 5.0]),
    )


def collapsed_boundary_edge(patch: Patch) -> "Input":
    """Two neighbours on the boundary at one place, with one normal."""
    start, normals = patch.vertices.copy(), patch.fixed_normals.copy()
    start[patch.fixed[1]], normals[1] = start[patch.fixed[0]], normals[0]
    return of_patch(patch).changed(vertices=start, reference=start, normals=normals)


def flat_ear(patch: Patch) -> "Input":
    """A triangle of the boundary whose three vertices lie in a line, the middle one on the boundary."""
    a, b = patch.fixed[:2]
    middle = len(patch.vertices)
    vertices = np.vstack([patch.vertices, [0.5 * (patch.vertices[a] + patch.vertices[b])]])
    directed = {(int(t[k]), int(t[(k + 1) % 3])) for t in patch.triangles for k in range(3)}
    ear = [b, a, middle] if (int(a), int(b)) in directed else [a, b, middle]
    normal = patch.normals[a] + patch.normals[b]
    return Input(
        vertices, np.vstack([patch.triangles, [ear]]), np.append(patch.fixed, middle),
        np.vstack([patch.fixed_normals, [normal]]), vertices,
    )  # fmt: skip


def unwelded_seam(patch: Patch) -> tuple[Input, IntArray]:
    """A hemisphere whose triangles on either side of x = 0 share no free vertex; and the vertices of the seam."""
    right = patch.vertices[patch.triangles].mean(axis=1)[:, 0] > 0
    seam = np.intersect1d(np.intersect1d(patch.triangles[right], patch.triangles[~right]), patch.free)
    place = np.arange(len(patch.vertices))
    place[seam] = len(patch.vertices) + np.arange(len(seam))
    triangles = patch.triangles.copy()
    triangles[right] = place[triangles[right]]
    vertices = np.vstack([patch.vertices, patch.vertices[seam]])
    item = of_patch(patch).changed(vertices=vertices, triangles=triangles, reference=vertices)
    return item, np.concatenate([seam, place[seam]])


def one_turned(patch: Patch) -> "Input":
    """One triangle with three free corners is wound the other way."""
    triangles = patch.triangles.copy()
    inner = int(np.flatnonzero(np.isin(triangles, patch.free).all(axis=1))[0])
    triangles[inner] = triangles[inner, ::-1]
    return of_patch(patch).changed(triangles=triangles)


def with_surroundings(patch: Patch, turned: bool = False) -> "Input":
    """A collar of fixed triangles round a hemisphere, one more circle below; wound against it if `turned`."""
    rim, count = patch.fixed, len(patch.vertices)
    outer = count + np.arange(len(rim))
    vertices = np.vstack([patch.vertices, patch.vertices[rim] - np.array([0.0, 0.0, 0.3])])
    ahead = np.roll(rim, -1), np.roll(outer, -1)
    collar = np.vstack([np.column_stack([outer, ahead[1], ahead[0]]), np.column_stack([outer, ahead[0], rim])])
    collar = collar[:, [0, 2, 1]] if turned else collar
    fixed = np.concatenate([rim, outer])
    normals = np.vstack([patch.fixed_normals, patch.fixed_normals])
    return Input(vertices, np.vstack([patch.triangles, collar]), fixed, normals, vertices)


def creased(patch: Patch, degrees: float = 70.0) -> "Input":
    """Normals of a plane's boundary turned to and fro about its x-axis: a crease at every corner of the boundary."""
    normals = patch.fixed_normals.copy()
    turn = np.radians(degrees) * np.sign(patch.vertices[patch.fixed, 2] - patch.vertices[patch.fixed, 2].mean())
    axis = np.array([0.0, 0.0, 1.0])
    normals = np.cos(turn)[:, None] * normals + np.sin(turn)[:, None] * np.cross(axis, normals)
    return of_patch(patch).changed(normals=normals)
