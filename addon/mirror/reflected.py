"""Half a mesh that a Mirror modifier makes whole: it is faired with its image, and only the half is moved."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol, Self, TypeVar

import numpy as np

import fairing

from ..arrays.places import edge_keys
from ..arrays.region import (
    OF_EDGES,
    OF_FACES,
    OF_VERTICES,
    MeshArrays,
    Reflection,
    chosen_of,
    free_vertices,
    reversed_corners,
    vertices_of,
)
from ..arrays.types import Floats, Ints, Mask
from ..verdict.outcome import Fairing, leading_part
from ..verdict.quality import Join, Quality
from ..verdict.verdict import Verdict
from ..words.sentences import in_numbers_of
from ..words.words import said

_IN_PLANE = said("face_in_plane")


@dataclass(frozen=True)
class Copy:
    """One copy of the half's n vertices within the whole; the half is one itself."""

    vertices: Ints  # (n,) of the whole; both sides share those on the plane
    back: Floats  # (4, 4) affine: from their places to the half's, in the mesh's own coordinates


class Found(Protocol):
    """New faces, in numbers of the mesh that they were found for."""

    def for_half(self, whole: Whole) -> Self:
        """Return what was found for a whole, to be written to its half."""


Answer = TypeVar("Answer", bound=Found)


@dataclass(frozen=True)
class Whole:
    """The half and its images. The half's own vertices, edges and faces come first."""

    half: MeshArrays
    mesh: MeshArrays
    copies: tuple[Copy, ...]
    planes: tuple[Reflection, ...] = ()

    @classmethod
    def of(cls, mesh: MeshArrays) -> Whole:
        """Return a mesh that is half of nothing."""
        return cls(mesh, mesh, (Copy(np.arange(len(mesh.positions)), np.eye(4)),))

    def found(self, find: Callable[[MeshArrays], Answer]) -> Answer:
        """Return the new faces that are found for the whole, to be written to the half; raises what `find` does."""
        if not self.planes:
            return find(self.mesh)
        with in_numbers_of(self.own):
            return find(self.mesh).for_half(self)

    @property
    def free_count(self) -> int:
        """How many of the half's vertices are free to move."""
        return int(np.count_nonzero(free_vertices(self.mesh)[: len(self.half.positions)]))

    @cached_property
    def sources(self) -> Ints:
        """(n',) the half's vertex of each of the whole."""
        sources = np.empty(len(self.mesh.positions), dtype=np.int64)
        for copy in reversed(self.copies):
            sources[copy.vertices] = np.arange(len(copy.vertices))
        return sources

    def own(self, vertices: Ints) -> Ints:
        """Return the half's vertices for some of the whole, each once, in the order of their first."""
        found = self.sources[vertices]
        first: Ints = found[np.sort(np.unique(found, return_index=True)[1])]
        return first

    def vertices(self, chosen: Mask) -> Mask:
        """Return the (n',) mask of the half's vertices in the (n,) mask and their images."""
        return chosen[self.sources]

    def edges(self, chosen: Mask) -> Mask:
        """Return the (e',) mask of the half's edges in the (e,) mask and their images."""
        return np.isin(edge_keys(self.sources[self.mesh.edges]), edge_keys(self.half.edges[chosen]))

    def about_half(self, verdict: Verdict) -> Verdict:
        """Return the verdict about the half's vertices."""
        return replace(verdict, spots=self.own(verdict.spots))

    def moved(self, vertices: Ints, positions: Floats) -> tuple[Ints, Floats]:
        """Return the half's vertices for those (k,) of the whole, and where they go: the mean of all copies."""
        after = self.mesh.positions.copy()
        after[vertices] = positions
        places = [after[copy.vertices] @ copy.back[:3, :3].T + copy.back[:3, 3] for copy in self.copies]
        own = np.unique(self.sources[vertices])
        mean: Floats = sum(places[1:], places[0]) / len(places)
        return own, mean[own]

    def half_of(self, found: Fairing) -> Fairing:
        """Return what was found for the whole in terms of the half."""
        assert isinstance(found.result, fairing.FairResult)  # the whole's own vertices
        count = len(self.half.positions)
        vertices, positions = self.moved(found.vertices, found.positions)
        inside = np.flatnonzero(vertices_of(self.mesh, self.mesh.in_patch))
        return replace(
            found,
            vertices=vertices,
            positions=positions,
            result=leading_part(found.result, int(np.count_nonzero(inside < count))),
            before=self._quality(found.before),
            after=self._quality(found.after),
            join=_leading_join(found.join, count),
            verdict=self.about_half(found.verdict),
            free_count=self.free_count,
        )

    def _quality(self, of: Quality) -> Quality:
        count = len(self.half.in_patch)
        return Quality(of.folded[of.folded < count], None if of.crossing is None else of.crossing[of.crossing < count])


def whole_of(mesh: MeshArrays, touched: Mask | None = None) -> Whole | None:
    """Return the mesh with its images where what is worked on ends at a plane of reflection, else None.

    touched: (n,) vertices that are worked on; None: the patch, which has edges there.
    """
    whole, planes = mesh, []
    copies = [Copy(np.arange(len(mesh.positions)), np.eye(4))]
    for reflection in mesh.reflections:
        seam = reflection.on_plane(whole.positions)
        if not _ends_there(whole, seam, touched):
            continue
        whole, image = _with_image(whole, reflection, seam)
        touched = None if touched is None else np.concatenate([touched, touched[~seam]])
        planes.append(reflection)
        copies += [Copy(image[copy.vertices], copy.back @ reflection.matrix) for copy in copies]
    return Whole(mesh, whole, tuple(copies), tuple(planes)) if planes else None


def with_image(mesh: MeshArrays, touched: Mask | None = None) -> Whole:
    """Return the mesh with its images, as `whole_of` does, for new faces; the mesh alone where it has none.

    Raises ValueError where the mesh can't have its images.
    """
    whole = whole_of(mesh, touched) or Whole.of(mesh)
    for plane in whole.planes:
        off = ~plane.on_plane(mesh.positions)
        if not np.bincount(mesh.corner_faces, off[mesh.corner_vertices]).all():
            raise ValueError(_IN_PLANE)
    return whole


def _ends_there(mesh: MeshArrays, seam: Mask, touched: Mask | None) -> bool:
    """Return whether it reaches the seam, and no edge there has two faces: with images they would be four."""
    sides = np.bincount(mesh.corner_edges, minlength=len(mesh.edges))
    on_seam = seam[mesh.edges].all(axis=1)
    if touched is None:
        chosen = mesh.in_patch[mesh.corner_faces]
        on_seam &= np.bincount(mesh.corner_edges[chosen], minlength=len(mesh.edges)) > 0
        return bool(on_seam.any() and (sides[on_seam] == 1).all())
    near = on_seam & touched[mesh.edges].any(axis=1)
    return bool((touched & seam).any() and (sides[near] <= 1).all())


def _with_image(mesh: MeshArrays, reflection: Reflection, seam: Mask) -> tuple[MeshArrays, Ints]:
    """Return the mesh with its image after it, and (n,) the image of each vertex."""
    off, apart = ~seam, ~seam[mesh.edges].all(axis=1)
    image, edge_image = _numbers_after(off), _numbers_after(apart)
    turned, along = reversed_corners(mesh.corner_faces)
    faces, normals, offsets = len(mesh.in_patch), mesh.corner_normals, mesh.shown_offsets
    linear = reflection.matrix[:3, :3]
    if normals is not None:
        normals = np.concatenate([normals, normals[turned] @ linear.T])
    both = replace(
        mesh,
        positions=np.concatenate([mesh.positions, reflection.of(mesh.positions[off])]),
        edges=np.concatenate([mesh.edges, image[mesh.edges[apart]]]),
        corner_vertices=np.concatenate([mesh.corner_vertices, image[mesh.corner_vertices[turned]]]),
        corner_edges=np.concatenate([mesh.corner_edges, edge_image[mesh.corner_edges[along]]]),
        corner_faces=np.concatenate([mesh.corner_faces, mesh.corner_faces + faces]),
        triangles=np.concatenate([mesh.triangles, image[mesh.triangles[:, ::-1]]]),
        triangle_faces=np.concatenate([mesh.triangle_faces, mesh.triangle_faces + faces]),
        **chosen_of(mesh, OF_VERTICES, lambda mask: np.concatenate([mask, mask[off]])),
        **chosen_of(mesh, OF_EDGES, lambda mask: np.concatenate([mask, mask[apart]])),
        **chosen_of(mesh, OF_FACES, lambda mask: np.tile(mask, 2)),
        lines={name: np.concatenate([edges, edges[apart]]) for name, edges in mesh.lines.items()},
        shown_offsets=None if offsets is None else np.concatenate([offsets, offsets[off] @ linear.T]),
        corner_normals=normals,
    )
    return both, image


def _numbers_after(doubled: Mask) -> Ints:
    """Return (k,) the images' numbers, which follow on those of all k; their own for what is not doubled."""
    numbers = np.arange(len(doubled))
    numbers[doubled] = len(doubled) + np.arange(np.count_nonzero(doubled))
    return numbers


def _leading_join(join: Join, count: int) -> Join:
    """Return the join at the mesh vertices below `count`."""
    kept = join.vertices < count
    number = np.cumsum(kept) - 1
    kinks = number[join.kinks[kept[join.kinks]]]
    return replace(join, vertices=join.vertices[kept], degrees=join.degrees[kept], kinks=kinks)
