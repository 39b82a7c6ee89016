"""Colours along the boundary of new faces, as the images around have them. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import fairing

from .arrays import Floats, Ints, Mask, Pixels
from .colours import Coding
from .textured_mesh import TexturedMesh, pieces

REACH = 2  # texels from the one of a place, along rows and columns, whose colours count there
NO_SLOPE = 1e-9  # of the colours' weights: where all texels lie on one line, colours don't change across it


@dataclass(frozen=True)
class Picture:
    """An image."""

    pixels: Pixels  # as it stores them
    coding: Coding

    @property
    def width(self) -> int:
        """In texels."""
        return int(self.pixels.shape[1])

    @property
    def height(self) -> int:
        """In texels."""
        return int(self.pixels.shape[0])


@dataclass(frozen=True)
class Samples:
    """Places on images where colours are known, and the vertices of a graded mesh there."""

    vertices: Ints  # (s,)
    places: Floats  # (s, 2) in texels
    triangles: Ints  # (s,) the old triangles that they are at the edge of

    @classmethod
    def along(cls, mesh: TexturedMesh, graded: fairing.GradedMesh) -> Samples:
        """Return both ends of all sides of a graded mesh that lie on chosen ones."""
        rows, side = np.nonzero(graded.chosen)
        weights = graded.weights[rows]
        ends = np.stack([side, (side + 1) % 3], axis=1)
        at = weights[np.arange(len(rows))[:, None], ends]  # (s, 2, 3)
        parent = graded.parent[rows]
        opposite = (at == 0.0).all(axis=1).argmax(axis=1)  # the corner of the parent across
        first = (opposite + 1) % 3
        second = (opposite + 2) % 3
        old = mesh.sides_around[parent, first]
        tail, head = mesh.triangles[mesh.chosen[parent], first], old // 3
        begins = mesh.triangles[head, old % 3] == tail
        there = np.stack([mesh.places[head, old % 3], mesh.places[head, (old % 3 + 1) % 3]], axis=1)
        there = np.where(begins[:, None, None], there, there[:, ::-1])
        each = np.arange(len(rows))
        along = np.stack([at[each, :, first], at[each, :, second]], axis=2)  # (s, 2 ends, 2)
        places = np.einsum("sek,skx->sex", along, there)
        vertices = graded.triangles[rows[:, None], ends]
        return cls(vertices.ravel(), places.reshape(-1, 2), np.repeat(head, 2))


def colours_at(mesh: TexturedMesh, samples: Samples, pictures: list[Picture]) -> Floats:
    """Return (s, 4) colours: of the linear function that fits the texels around best which the same island covers."""
    label = np.full(len(mesh.triangles), -1)
    label[mesh.near] = pieces(mesh.triangles[mesh.near], mesh.places[mesh.near])
    found = np.zeros((len(samples.places), 4))
    for number, picture in enumerate(pictures):
        own = np.flatnonzero(mesh.image[samples.triangles] == number)
        near = mesh.near[mesh.image[mesh.near] == number]
        if not len(own):
            continue
        owners, _ = fairing.texel_owners(mesh.places[near], picture.width, picture.height)
        texels, x, y = _around(samples.places[own])
        x, y = x % picture.width, y % picture.height
        beside = owners[y, x]
        same = (beside >= 0) & (label[near[beside]] == label[samples.triangles[own]][:, None])
        colours = picture.coding.decoded(picture.pixels[y, x])
        found[own] = _fitted(texels - samples.places[own][:, None], same, colours)
    return found


def _around(places: Floats) -> tuple[Floats, Ints, Ints]:
    """Return the centres (s, k, 2), the columns and the rows (s, k) of the texels around places (s, 2)."""
    steps = np.arange(-REACH, REACH + 1)
    texel = np.floor(places).astype(np.int64)
    x = texel[:, :1] + np.tile(steps, len(steps))
    y = texel[:, 1:] + np.repeat(steps, len(steps))
    return np.stack([x, y], axis=2) + 0.5, x, y


def _fitted(away: Floats, usable: Mask, colours: Floats) -> Floats:
    """Return (s, 4): at (0, 0) the linear function that fits colours (s, k, 4) at places (s, k, 2) best.

    Near ones count more. Where none is usable, all are.
    """
    usable = usable | ~usable.any(axis=1, keepdims=True)
    distance = np.linalg.norm(away, axis=2)
    weights = usable * np.maximum(1.0 - distance / (REACH + 1.0), 1e-3)
    terms = np.concatenate([np.ones((*distance.shape, 1)), away], axis=2)
    matrix = np.einsum("sk,ski,skj->sij", weights, terms, terms)
    matrix[:, [1, 2], [1, 2]] += NO_SLOPE * weights.sum(axis=1)[:, None]
    right = np.einsum("sk,ski,skc->sic", weights, terms, colours)
    found: Floats = np.linalg.solve(matrix, right)[:, 0]
    return found
