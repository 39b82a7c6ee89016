"""From polygons and a selection to the patch that the engine solves. Plain numpy, no bpy."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

import fairing

from ..words.findings import Finding, Origin
from ..words.sentences import refusal
from ..words.words import said
from .places import numbers_in
from .triangulation import split_quads, zigzag
from .types import Floats, Ints, Mask


@dataclass(frozen=True)
class Reflection:
    """A plane across which a Mirror modifier shows the mesh once more, joined with it."""

    matrix: Floats  # (4, 4) affine, its own inverse, in the mesh's own coordinates
    reach: float  # as far from its image a vertex may be to be one with it

    def of(self, positions: Floats) -> Floats:
        """Return the images of positions (k, 3)."""
        images: Floats = positions @ self.matrix[:3, :3].T + self.matrix[:3, 3]
        return images

    def on_plane(self, positions: Floats) -> Mask:
        """Return which of the positions (k, 3) are one with their image."""
        with np.errstate(invalid="ignore", over="ignore"):
            there: Mask = np.linalg.norm(self.of(positions) - positions, axis=1) <= self.reach
        return there


@dataclass(frozen=True)
class MeshArrays:
    """A polygon mesh: n vertices, e edges, f faces, c corners, t triangles of Blender's own."""

    positions: Floats  # (n, 3)
    edges: Ints  # (e, 2)
    corner_vertices: Ints  # (c,)
    corner_edges: Ints  # (c,) the edge from this corner to the next one
    corner_faces: Ints  # (c,)
    triangles: Ints  # (t, 3) vertices, counter-clockwise from outside
    triangle_faces: Ints  # (t,)
    in_patch: Mask  # (f,) selected and visible
    pinned: Mask  # (n,)
    free_slopes: Mask | None = None  # (n,) where the boundary's position alone is kept; None: nowhere
    continued: Mask | None = None  # (n,) where the curvature outside is continued; None: everywhere or nowhere
    creases: Mask | None = None  # (e,) pinned edges on whose sides the surface finds slopes of their own
    smooth_curves: Mask | None = None  # (e,) pinned edges through which it runs with a slope that it finds
    fair_border: bool = False  # open borders inside the patch move, too
    corner_normals: Floats | None = None  # (c, 3), where they were asked for
    mirrored: bool = False  # the corners go clockwise, seen from outside
    mirror_x: bool = False  # the mesh asks for symmetric results
    textured: bool = False  # the patch has a UV map
    sharp: Mask | None = None  # (e,) edges marked sharp; None: none is
    hard: Mask | None = None  # (e,) edges that may run through the patch: marked, or by their angle; None: none
    held_by_angle: Mask | None = None  # (n,) pinned vertices on edges that nobody has marked; None: none
    hidden: Mask | None = None  # (f,); None: nothing is
    notes: tuple[str, ...] = ()  # what turned out odd when it was read
    # (e,) edges that a new mesh keeps, by the attribute that says so; none where that is not asked for
    lines: Mapping[str, Mask] = field(default_factory=dict)
    reflections: tuple[Reflection, ...] = ()  # that make it whole; see reflected.py
    shown_offsets: Floats | None = (
        None  # (n, 3) from the Basis to the keys that are shown; None: it is shown, or no Basis
    )
    keys: Mapping[str, Floats] = field(default_factory=dict)  # (n, 3) of each shape key that is to be faired as well
    parts: Floats | None = None  # (n,) each vertex's own factor, 0 … 1; None: 1 inside, 0 outside

    def transformed(self, matrix: Floats) -> MeshArrays:
        """Return the mesh under a 4×4 affine map, wound so that outside stays outside.

        Raises ValueError where the map flattens the mesh: it has no inverse then.
        """
        linear = matrix[:3, :3]
        if not np.isfinite(matrix).all() or np.linalg.cond(linear) > 1e7:
            raise ValueError(said("flat_object"))
        mirrored = np.linalg.det(linear) < 0.0
        normals = self.corner_normals
        return replace(
            self,
            positions=self.positions @ linear.T + matrix[:3, 3],
            triangles=self.triangles[:, ::-1] if mirrored else self.triangles,
            corner_normals=None if normals is None else normals @ np.linalg.inv(linear),
            mirrored=self.mirrored != mirrored,
        )


# The masks and factors of MeshArrays, by what they are of.
OF_VERTICES = ("pinned", "free_slopes", "continued", "parts", "held_by_angle")
OF_EDGES = ("creases", "smooth_curves", "sharp", "hard")
OF_FACES = ("in_patch", "hidden")


def chosen_of(mesh: MeshArrays, names: tuple[str, ...], choose: Callable[[Mask], Mask]) -> dict[str, Any]:
    """Return these masks as `choose` makes them; None stays None."""
    masks = {name: getattr(mesh, name) for name in names}
    return {name: None if mask is None else choose(mask) for name, mask in masks.items()}


def nothing() -> Ints:
    return np.empty(0, dtype=np.int64)


@dataclass(frozen=True)
class Patch:
    """The selected faces alone, vertices numbered 0 … p−1 in the order of the mesh."""

    vertices: Ints  # (p,) mesh indices, ascending
    triangles: Ints  # (m, 3) patch indices
    faces: Ints  # (m,) the mesh's face that each triangle is of
    free: Ints  # patch indices, ascending
    fixed: Ints  # patch indices, ascending: all that are not free
    boundary: Ints  # patch indices of the vertices on edges with one face of the patch
    neighbours: Ints | None  # (e, 2) patch indices; None where all faces are triangles
    creases: Ints = field(default_factory=nothing)  # patch indices of fixed vertices on creases
    smooth_curves: Ints = field(default_factory=nothing)  # and on smooth curves
    free_slopes: Ints = field(default_factory=nothing)  # and on the boundary, where its position alone is kept
    continued: Mask | None = None  # (k,) of `fixed`, where the curvature outside is continued; None: all or none

    @property
    def slopes_found(self) -> Ints:
        """Where the surface finds its slope, on each side of a crease one."""
        return np.union1d(self.creases, self.free_slopes)

    @property
    def origin(self) -> Origin:
        """Where the patch's vertices and triangles are in the mesh."""
        return Origin(self.vertices, self.triangles, self.faces)


def vertices_of(mesh: MeshArrays, faces: Mask) -> Mask:
    """Return the (n,) mask of the vertices of the faces in the (f,) mask."""
    touched = np.zeros(len(mesh.positions), dtype=bool)
    touched[mesh.corner_vertices[faces[mesh.corner_faces]]] = True
    return touched


def reversed_corners(corner_faces: Ints) -> tuple[Ints, Ints]:
    """Return (c,) the corners of each face in the opposite order, and those whose edges lead from each to the next."""
    _, starts, sizes = np.unique(corner_faces, return_index=True, return_counts=True)
    start, size = np.repeat(starts, sizes), np.repeat(sizes, sizes)
    place = np.arange(len(corner_faces)) - start
    return start + size - 1 - place, start + (2 * size - 2 - place) % size


def _ends(mesh: MeshArrays, edges: Mask) -> Mask:
    ends = np.zeros(len(mesh.positions), dtype=bool)
    ends[mesh.edges[edges]] = True
    return ends


def _edge_uses(mesh: MeshArrays, corners: Mask | slice) -> Ints:
    return np.bincount(mesh.corner_edges[corners], minlength=len(mesh.edges))


def free_vertices(mesh: MeshArrays) -> Mask:
    """Return the (n,) mask of vertices with only patch faces, not pinned, and on no open border that stays."""
    inside = vertices_of(mesh, mesh.in_patch)
    outside = vertices_of(mesh, ~mesh.in_patch)
    free = inside & ~outside & ~mesh.pinned
    return free if mesh.fair_border else free & ~_ends(mesh, _edge_uses(mesh, slice(None)) == 1)


def fins(mesh: MeshArrays) -> Mask:
    """Return the (f,) mask of patch faces without free vertices at edges with more than two faces.

    They stand on the boundary; without the faces outside they would look like corners of the patch.
    """
    many = _edge_uses(mesh, slice(None)) > 2
    hang = np.zeros(len(mesh.in_patch), dtype=bool)
    if not many.any():
        return hang
    hang[mesh.corner_faces[many[mesh.corner_edges]]] = True
    hang[mesh.corner_faces[free_vertices(mesh)[mesh.corner_vertices]]] = False
    return hang & mesh.in_patch


def _check_edges(mesh: MeshArrays) -> None:
    """Refuse edges where three faces of the patch meet: a fin's foot lies on an open border, which is no excuse."""
    many = _edge_uses(mesh, mesh.in_patch[mesh.corner_faces]) > 2
    offenders = mesh.edges[many & ~mesh.pinned[mesh.edges].all(axis=1)]
    if len(offenders):
        figures = {"edges": float(len(offenders))}
        raise refusal(Finding("NONMANIFOLD_EDGE", figures, "vertex", offenders.ravel(), offenders.ravel()[:0]))


def make_patch(mesh: MeshArrays, by_connectivity: bool = True) -> Patch:
    """Cut the selected visible faces out of the mesh.

    by_connectivity: split quads and n-gons as `triangulation` does, not by present shape.
    Raises MeshRefusal where more than two of them meet at an edge.
    """
    _check_edges(mesh)
    inside = vertices_of(mesh, mesh.in_patch)
    vertices = np.flatnonzero(inside)
    number = numbers_in(vertices, len(inside))
    free = free_vertices(mesh)
    mesh = replace(mesh, in_patch=mesh.in_patch & ~fins(mesh))
    uses = _edge_uses(mesh, mesh.in_patch[mesh.corner_faces])
    edges = mesh.edges[uses > 0]
    triangles, faces = _triangles(mesh, edges, free, by_connectivity)
    boundary = _ends(mesh, uses == 1)
    return Patch(
        vertices=vertices,
        triangles=number[triangles],
        faces=faces,
        free=number[free],
        fixed=number[inside & ~free],
        boundary=number[boundary],
        neighbours=None if _all_triangles(mesh) else number[edges],
        creases=number[_curve(mesh, mesh.creases, uses > 0)],
        # Where such a curve reaches the boundary, the slope there is the boundary's.
        smooth_curves=number[_curve(mesh, mesh.smooth_curves, uses > 0) & ~boundary],
        free_slopes=nothing() if mesh.free_slopes is None else number[boundary & ~free & mesh.free_slopes],
        continued=None if mesh.continued is None else (boundary & mesh.continued)[inside & ~free],
    )


def _curve(mesh: MeshArrays, marked: Mask | None, edges: Mask) -> Mask:
    """Return the (n,) mask of the ends of those marked edges that are in the (e,) mask."""
    return _ends(mesh, edges if marked is None else edges & marked) & (marked is not None)


def _triangles(mesh: MeshArrays, edges: Ints, free: Mask, by_connectivity: bool) -> tuple[Ints, Ints]:
    """Return the triangles of the patch (m, 3), as vertices of the mesh, and their faces (m,)."""
    sizes = face_sizes(mesh) * by_connectivity
    by_shape = mesh.in_patch.copy()  # faces that stay split as they are
    pieces, origins = [], []
    for size in np.unique(sizes[mesh.in_patch & (sizes > 4)]):
        faces, polygons = _polygons(mesh, mesh.in_patch & (sizes == size))
        movable = free[polygons].all(axis=1)  # the shape of the others counts
        by_shape[faces[movable]] = False
        pieces.append(zigzag(polygons[movable]))
        origins.append(np.repeat(faces[movable], size - 2))
    faces, quads = _polygons(mesh, mesh.in_patch & (sizes == 4))
    movable = free[quads].any(axis=1)
    by_shape[faces[movable]] = False
    as_they_are = by_shape[mesh.triangle_faces]
    pieces += [mesh.triangles[as_they_are], split_quads(quads[movable], edges, free)]
    origins += [mesh.triangle_faces[as_they_are], np.repeat(faces[movable], 2)]
    return np.concatenate(pieces), np.concatenate(origins)


def _polygons(mesh: MeshArrays, faces: Mask) -> tuple[Ints, Ints]:
    """Return the chosen faces (k,) and their vertices (k, n), counter-clockwise from outside.

    All of them must have the same number n of corners.
    """
    chosen = np.flatnonzero(faces)
    size = np.count_nonzero(mesh.corner_faces == chosen[0]) if len(chosen) else 4
    polygons = mesh.corner_vertices[faces[mesh.corner_faces]].reshape(-1, size)
    return chosen, polygons[:, ::-1] if mesh.mirrored else polygons


def face_sizes(mesh: MeshArrays) -> Ints:
    """Return (f,): the corners of each face."""
    return np.bincount(mesh.corner_faces, minlength=len(mesh.in_patch)).astype(np.int64)


def _all_triangles(mesh: MeshArrays) -> bool:
    return bool((face_sizes(mesh)[mesh.in_patch] == 3).all())


def to_local(positions: Floats, matrix: Floats) -> Floats:
    """Take world positions (k, 3) back; raises SolverError rather than pass on a NaN."""
    local: Floats = np.linalg.solve(matrix[:3, :3], (positions - matrix[:3, 3]).T).T
    if not np.isfinite(local).all():
        raise fairing.SolverError(said("not_finite"))
    return local
