"""Half a mesh that a Mirror modifier makes whole: it is faired with its image, and only the half is moved."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

import fairing

from .arrays import Floats, Ints, Mask
from .outcome import Fairing, leading_part
from .quality import Join, Quality
from .region import MeshArrays, Reflection, free_vertices, reversed_corners, vertices_of
from .verdict import Verdict


@dataclass(frozen=True)
class Copy:
    """One copy of the half's n vertices within the whole; the half is one itself."""

    vertices: Ints  # (n,) of the whole; both sides share those on the plane
    back: Floats  # (4, 4) affine: from their places to the half's, in the mesh's own coordinates


@dataclass(frozen=True)
class Whole:
    """The half and its images. The half's own vertices, edges and faces come first."""

    half: MeshArrays
    mesh: MeshArrays
    copies: tuple[Copy, ...]

    @property
    def free_count(self) -> int:
        """How many of the half's vertices are free to move."""
        return int(np.count_nonzero(free_vertices(self.mesh)[: len(self.half.positions)]))

    def half_of(self, found: Fairing) -> Fairing:
        """Return what was found for the whole in terms of the half: the mean of all copies."""
        assert isinstance(found.result, fairing.FairResult)  # the whole's own vertices
        sources, own = self._sources(), len(self.half.positions)
        after = self.mesh.positions.copy()
        after[found.vertices] = found.positions
        vertices = np.unique(sources[found.vertices])
        inside = np.flatnonzero(vertices_of(self.mesh, self.mesh.in_patch))
        return replace(
            found,
            vertices=vertices,
            positions=self._mean(after)[vertices],
            result=leading_part(found.result, int(np.count_nonzero(inside < own))),
            before=self._quality(found.before),
            after=self._quality(found.after),
            join=_leading_join(found.join, own),
            verdict=_about(found.verdict, sources),
            free_count=self.free_count,
        )

    def _sources(self) -> Ints:
        """Return (n',): the half's vertex of each of the whole."""
        sources = np.empty(len(self.mesh.positions), dtype=np.int64)
        for copy in reversed(self.copies):
            sources[copy.vertices] = np.arange(len(copy.vertices))
        return sources

    def _mean(self, positions: Floats) -> Floats:
        places = [positions[copy.vertices] @ copy.back[:3, :3].T + copy.back[:3, 3] for copy in self.copies]
        mean: Floats = sum(places[1:], places[0]) / len(places)
        return mean

    def _quality(self, of: Quality) -> Quality:
        count = len(self.half.in_patch)
        folded, needles = (faces[faces < count] for faces in (of.folded, of.needles))
        return Quality(folded, needles, None if of.crossing is None else of.crossing[of.crossing < count])


def whole_of(mesh: MeshArrays) -> Whole | None:
    """Return the mesh with its images where the patch reaches a plane of reflection with an open border; else None."""
    whole = mesh
    copies = [Copy(np.arange(len(mesh.positions)), np.eye(4))]
    for reflection in mesh.reflections:
        seam = reflection.on_plane(whole.positions)
        if not _is_cut_there(whole, seam):
            continue
        whole, image = _with_image(whole, reflection, seam)
        copies += [Copy(image[copy.vertices], copy.back @ reflection.matrix) for copy in copies]
    return Whole(mesh, whole, tuple(copies)) if len(copies) > 1 else None


def with_image_across(mesh: MeshArrays, reflection: Reflection) -> tuple[MeshArrays, Ints]:
    """Return the mesh with its image across a plane after it, and (n,) the image of each vertex."""
    return _with_image(mesh, reflection, reflection.on_plane(mesh.positions))


def _is_cut_there(mesh: MeshArrays, seam: Mask) -> bool:
    """Return whether the patch has edges on the seam, all of them borders: with a second face they would have four."""
    chosen = mesh.in_patch[mesh.corner_faces]
    sides = np.bincount(mesh.corner_edges, minlength=len(mesh.edges))
    own = np.bincount(mesh.corner_edges[chosen], minlength=len(mesh.edges)) > 0
    on_seam = own & seam[mesh.edges].all(axis=1)
    return bool(on_seam.any() and (sides[on_seam] == 1).all())


def _with_image(mesh: MeshArrays, reflection: Reflection, seam: Mask) -> tuple[MeshArrays, Ints]:
    """Return the mesh with its image after it, and (n,) the image of each vertex."""
    off, apart = ~seam, ~seam[mesh.edges].all(axis=1)
    image, edge_image = _numbers_after(off), _numbers_after(apart)
    turned, along = reversed_corners(mesh.corner_faces)
    faces, normals = len(mesh.in_patch), mesh.corner_normals
    if normals is not None:
        normals = np.concatenate([normals, normals[turned] @ reflection.matrix[:3, :3].T])
    both = replace(
        mesh,
        positions=np.concatenate([mesh.positions, reflection.of(mesh.positions[off])]),
        edges=np.concatenate([mesh.edges, image[mesh.edges[apart]]]),
        corner_vertices=np.concatenate([mesh.corner_vertices, image[mesh.corner_vertices[turned]]]),
        corner_edges=np.concatenate([mesh.corner_edges, edge_image[mesh.corner_edges[along]]]),
        corner_faces=np.concatenate([mesh.corner_faces, mesh.corner_faces + faces]),
        triangles=np.concatenate([mesh.triangles, image[mesh.triangles[:, ::-1]]]),
        triangle_faces=np.concatenate([mesh.triangle_faces, mesh.triangle_faces + faces]),
        in_patch=np.tile(mesh.in_patch, 2),
        hidden=None if mesh.hidden is None else np.tile(mesh.hidden, 2),
        sample=None if mesh.sample is None else np.tile(mesh.sample, 2),
        pinned=np.concatenate([mesh.pinned, mesh.pinned[off]]),
        free_slopes=_twice(mesh.free_slopes, off),
        continued=_twice(mesh.continued, off),
        tension=_twice(mesh.tension, off),
        parts=_twice(mesh.parts, off),
        creases=_twice(mesh.creases, apart),
        smooth_curves=_twice(mesh.smooth_curves, apart),
        sharp=_twice(mesh.sharp, apart),
        hard=_twice(mesh.hard, apart),
        held_by_angle=_twice(mesh.held_by_angle, off),
        corner_normals=normals,
    )
    return both, image


def _numbers_after(doubled: Mask) -> Ints:
    """Return (k,) the images' numbers, which follow on those of all k; their own for what is not doubled."""
    numbers = np.arange(len(doubled))
    numbers[doubled] = len(doubled) + np.arange(np.count_nonzero(doubled))
    return numbers


Values = TypeVar("Values", Floats, Mask)


def _twice(values: Values | None, again: Mask) -> Values | None:
    return None if values is None else np.concatenate([values, values[again]])


def _leading_join(join: Join, count: int) -> Join:
    """Return the join at the mesh vertices below `count`."""
    kept = join.vertices < count
    number = np.cumsum(kept) - 1
    kinks = number[join.kinks[kept[join.kinks]]]
    return replace(join, vertices=join.vertices[kept], degrees=join.degrees[kept], kinks=kinks)


def _about(verdict: Verdict, sources: Ints) -> Verdict:
    """Return the verdict about the half's vertices, in the same order."""
    spots = sources[verdict.spots]
    first = np.sort(np.unique(spots, return_index=True)[1])
    return replace(verdict, spots=spots[first])
