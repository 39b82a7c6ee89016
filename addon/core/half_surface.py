"""A surface over half of a hole, as the whole would be: see core.halves. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np

import fairing

from .arrays import Floats, Ints
from .engine import Progress
from .fill_verdict import Surface, judge
from .halves import Curve, Half, curve_on_plane, spread
from .option_shared import LEAST_SPACING
from .quality import join_at
from .region import MeshArrays, nothing, to_local
from .verdict import Verdict

_FINER = 0.25  # of the edges wanted: the curve is cut from a mesh on which its chords are a sixteenth as far off


class Near(Protocol):
    """What is around some boundaries; see core.filling."""

    @property
    def vertices(self) -> Ints:
        """Of the mesh."""

    @property
    def around(self) -> Ints:
        """Triangles, in numbers of these."""

    def numbers(self, vertices: Ints) -> Ints:
        """Return mesh vertices in numbers of these."""


class Fills(Protocol):
    """Makes surfaces over the loops of one mesh; see core.filling."""

    @property
    def world(self) -> MeshArrays:
        """The mesh in world space."""

    @property
    def matrix(self) -> Floats:
        """(4, 4) to world space."""

    @property
    def options(self) -> Any:
        """Those of filling."""

    def over(self, mesh: MeshArrays, spacing: float) -> Fills:
        """Return the same over another mesh."""

    def local(self, outline: Ints) -> Any:
        """Return what is Near."""

    def filled(self, local: Any, loops: list[Ints], progress: Progress | None) -> fairing.FillResult:
        """Fill them."""


@dataclass(frozen=True)
class HalfSurface:
    """What was found over a half: see the fields of the same names of core.filling.Piece."""

    surface: Surface
    positions: Floats
    verdict: Verdict
    on_plane: Ints


def half_surface(job: Fills, mesh: MeshArrays, half: Half, progress: Progress | None) -> HalfSurface:
    """Make the surface over a half, in the mesh's own numbers. Raises what a whole one does, and ValueError.

    mesh: in its own coordinates; job: over it.
    """
    whole, loop = half.whole(mesh)
    with np.errstate(invalid="ignore", over="ignore"):
        other = job.over(whole, max(LEAST_SPACING, _FINER * job.options.spacing))
    local: Near = other.local(loop)
    found = other.filled(local, [loop], progress)
    rim = half.chain
    places = other.world.positions
    edges = np.linalg.norm(places[rim[1:]] - places[rim[:-1]], axis=1)
    new = found.triangles.astype(np.int64)
    around = np.concatenate([local.around, new])
    points = np.concatenate([places[local.vertices], found.vertices])
    curve = _curve(half, (points, around, new), local.numbers(rim[[0, -1]]), job.matrix)
    curve = spread(curve, job.options.spacing * float(edges[[0, -1]].mean()))
    slopes = fairing.surrounding_normals(places[local.vertices], local.around, local.numbers(rim)).normals
    own = np.concatenate([places[rim], curve.places[::-1]])
    result = fairing.fill(
        own, np.empty((0, 3), dtype=np.int64), [np.arange(len(own))[:: -1 if other.world.mirrored else 1]],
        fairing.Options(fairing.Surface(job.options.equation.lower())),
        normals=np.concatenate([slopes, curve.normals[::-1]]), edges="ignored",
        spacing=0.0 if job.options.spacing == 1.0 else job.options.spacing * float(edges.mean()),
        inner=job.options.inner.lower(),
        max_vertices=job.options.max_vertices,
    )  # fmt: skip
    inside = np.concatenate([curve.places[::-1], result.vertices])
    numbers = np.concatenate([local.numbers(rim), len(local.vertices) + np.arange(len(inside))])
    joined = np.concatenate([places[local.vertices], inside])
    triangles = result.triangles.astype(np.int64)
    at = np.sort(local.numbers(rim))
    join = join_at(local.vertices[at], fairing.visible_join(joined, numbers[triangles], local.around, at))
    surface = Surface(np.concatenate([places[rim], inside]), triangles, result, join, nothing())
    verdict = judge(other.world, rim, surface, local.vertices[local.around])
    positions = to_local(inside, job.matrix)
    on = len(curve.places)
    positions[:on] = 0.5 * (positions[:on] + half.reflection.of(positions[:on]))
    on_plane = np.concatenate([[0, len(rim) - 1], len(rim) + np.arange(on)])
    return HalfSurface(surface, positions, verdict, on_plane)


def _curve(half: Half, surface: tuple[Floats, Ints, Ints], ends: Ints, matrix: Floats) -> Curve:
    """Return where the new triangles meet the plane, in world space; surface: points, all and the new triangles."""
    points, everything, new = surface
    local = to_local(points, matrix)
    away = local - half.reflection.of(local)
    axis = away[int(np.linalg.norm(away, axis=1).argmax())]
    heights = 0.5 * (away @ axis) / float(np.linalg.norm(axis))
    heights[half.reflection.on_plane(local)] = 0.0
    normals = fairing.vertex_normals(points, everything, normals="averaged")
    curve = curve_on_plane(points, normals, new, heights, (int(ends[0]), int(ends[1])))
    return replace(curve, normals=_mean_with_image(curve.normals, half, matrix))


def _mean_with_image(normals: Floats, half: Half, matrix: Floats) -> Floats:
    """Return directions (c, 3) in world space without their part across the plane."""
    linear = matrix[:3, :3] @ half.reflection.matrix[:3, :3] @ np.linalg.inv(matrix[:3, :3])
    mean: Floats = 0.5 * (normals + normals @ np.linalg.inv(linear))
    return mean
