"""Pictures of holes and bridges before and after, with reflection stripes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import bridges
import fairing
import quad_sheet
import real_meshes
from holes import FloatArray, IntArray
from looks import AROUND, NEW, TILE, eye_of, reach_of
from picture_sheet import save_pairs
from stripes import Layer, facing, render

HOLES = (
    "ict_head:nose", "ict_head:scalp", "mh_body:ear_left", "mh_body:nose", "demosthenes-low-res:chest",
    "wingnut:wing_root_blend", "skull_low_resolution:cranium", "hammer:handle_end", "hand_lowres:palm",
    "spot_low_resolution:back",
)  # fmt: skip


@dataclass(frozen=True)
class Shown:
    """A mesh, its loops, and from where to look."""

    name: str
    vertices: FloatArray
    triangles: IntArray
    loops: list[Any]
    eye: FloatArray
    reach: float

    def tiles(self) -> Iterator[FloatArray]:
        """Before; after; after with its edges."""
        result = fairing.fill(self.vertices, self.triangles, self.loops, bridge=len(self.loops) > 1)
        centre = self.vertices[np.concatenate(self.loops)].mean(axis=0)
        near = np.linalg.norm(self.vertices - centre, axis=1) < 3 * self.reach
        around = Layer(self.vertices, self.triangles[near[self.triangles].all(axis=1)], AROUND, striped=True)
        points = np.concatenate([self.vertices, result.vertices])
        view = facing(self.eye, centre, self.reach)
        yield render([around], view, TILE)
        yield render([around, Layer(points, result.triangles, NEW, striped=True)], view, TILE)
        yield render([around, Layer(points, result.triangles, NEW, wire=True)], view, TILE)


def real_holes() -> Iterator[Shown]:
    for patch in real_meshes.listed_patches():
        if patch.name not in HOLES:
            continue
        loops = [patch.vertices_in_mesh[loop] for loop in fairing.boundary_loops(patch.triangles)]
        yield Shown(patch.name, patch.whole, patch.outside, loops, eye_of(patch), reach_of(patch))


def gaps() -> Iterator[Shown]:
    for name, (vertices, triangles, loops) in bridges.all_of_them().items():
        yield Shown(name, vertices, triangles, loops, np.array([0.5, -1.0, 0.7]), 1.9)


def write_all(folder: Path) -> Iterator[str]:
    """All pictures; the names of the files."""
    sheets = ("fill_holes.webp", real_holes), ("fill_bridges.webp", gaps), ("fill_meshes.webp", quad_sheet.new_meshes)
    for name, kind in sheets:
        save_pairs(((one.name, one.tiles()) for one in kind()), folder / name)
        yield f"{folder / name}: {(folder / name).stat().st_size // 1000} kB"
