"""Pictures of new meshes: what was there, even triangles, and quads of two."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

import fairing
import real_meshes
from holes import FloatArray, IntArray
from looks import AROUND, NEW, TILE, eye_of, reach_of
from rasteriser import View
from stripes import Layer, facing, render

OLD = (0.95, 0.8, 0.6)
PATCHES = ("mh_body:nose", "mh_body:ear_left", "demosthenes-low-res:chest")
HOLES = (("goathead", 1000, 3.2),)
NONE = np.empty((0, 3), dtype=np.int64)


@dataclass(frozen=True)
class Remade:
    """A patch that gets another mesh, or a hole that gets one."""

    name: str
    patch: Any
    hole: bool

    def tiles(self) -> Iterator[FloatArray]:
        """Before; triangles; quads."""
        patch = self.patch
        points, triangles = self._filled() if self.hole else self._remeshed()
        view = facing(eye_of(patch), patch.vertices[patch.fixed].mean(axis=0), reach_of(patch))
        before = NONE if self.hole else patch.vertices_in_mesh[patch.triangles]
        yield self._picture(Layer(patch.whole, before, OLD, wire=True), view)
        yield self._picture(Layer(points, triangles, NEW, wire=True), view)
        found = fairing.paired_quads(points, triangles)
        halves = found.quads[:, [0, 1, 3, 2, 3, 1]].reshape(-1, 3)
        faces = np.concatenate([halves, found.triangles])
        yield self._picture(Layer(points, faces, NEW, wire=True, halves=len(halves)), view)

    def _picture(self, layer: Layer, view: View) -> FloatArray:
        whole = self.patch.whole
        near = np.linalg.norm(whole - view.target, axis=1) < 1.5 * view.width
        outside = self.patch.outside[near[self.patch.outside].all(axis=1)]
        return render([Layer(whole, outside, AROUND, wire=True), layer], view, TILE)

    def _filled(self) -> tuple[FloatArray, IntArray]:
        patch = self.patch
        loops = [patch.vertices_in_mesh[loop] for loop in fairing.boundary_loops(patch.triangles)]
        result = fairing.fill(patch.whole, patch.outside, loops, bridge=len(loops) > 1)
        return np.concatenate([patch.whole, result.vertices]), result.triangles

    def _remeshed(self) -> tuple[FloatArray, IntArray]:
        patch = self.patch
        result = fairing.remesh(patch.vertices, patch.triangles, fixed=patch.fixed, fixed_normals=patch.normals)
        return np.concatenate([patch.vertices, result.vertices]), result.triangles


def new_meshes() -> Iterator[Remade]:
    """Patches first, then holes."""
    listed = {patch.name: patch for patch in real_meshes.listed_patches()}
    for name in PATCHES:
        yield Remade(name, listed[name], hole=False)
    for name, *grown in HOLES:
        patch = real_meshes.make_patch(name, name, *grown) if grown else listed[name]
        yield Remade(f"{name}, a hole", patch, hole=True)
