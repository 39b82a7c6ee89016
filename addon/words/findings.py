"""The engine's errors and warnings in terms of the mesh: its vertices, its faces. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import fairing

from ..arrays.types import Ints


@dataclass(frozen=True)
class Origin:
    """Which parts of the mesh the engine's p vertices and m triangles are."""

    vertices: Ints  # (p,) of the mesh
    triangles: Ints  # (m, 3) of the engine's vertices
    faces: Ints  # (m,) of the mesh


@dataclass(frozen=True)
class Finding:
    """What the engine found, with its own figures and the mesh's elements."""

    code: str
    figures: dict[str, float]
    kind: str  # "vertex" or "triangle": what the engine named
    named: Ints  # mesh vertices in the order in which they were named; edges are pairs, triangles give their corners
    faces: Ints  # mesh faces of the triangles that were named, ascending; empty for vertices
    gone: int = 0  # elements of a mesh that was made meanwhile, which have no place in this one

    @property
    def vertices(self) -> Ints:
        """The mesh vertices that it is about, ascending."""
        return np.unique(self.named)

    @property
    def count(self) -> int:
        """How many elements of the mesh it is about: faces where the engine named triangles."""
        return len(self.faces if self.kind == "triangle" else self.vertices) + self.gone


def found(diagnostic: fairing.Diagnostic, origin: Origin) -> Finding:
    """Return the engine's diagnostic in terms of the mesh."""
    of_triangles = diagnostic.kind == "triangle"
    known = diagnostic.elements < len(origin.triangles if of_triangles else origin.vertices)
    elements: Ints = diagnostic.elements[known].astype(np.int64)
    corners = origin.triangles[elements].ravel() if of_triangles else elements
    return Finding(
        code=diagnostic.code,
        figures=diagnostic.figures,
        kind=diagnostic.kind,
        named=origin.vertices[corners],
        faces=np.unique(origin.faces[elements]) if of_triangles else elements[:0],
        gone=int(np.count_nonzero(~known)),
    )
