"""Pictures of holes and bridges before and after, with reflection stripes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

import bridges
import fairing
import quad_sheet
import real_meshes
import webp
from holes import FloatArray, IntArray
from looks import AROUND, NEW, TILE, eye_of, reach_of
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
        view = facing(self.eye, centre, self.reach, TILE)
        yield render([around], view)
        yield render([around, Layer(points, result.triangles, NEW, striped=True)], view)
        yield render([around, Layer(points, result.triangles, NEW, wire=True)], view)


def real_holes() -> Iterator[Shown]:
    for patch in real_meshes.listed_patches():
        if patch.name not in HOLES:
            continue
        loops = [patch.vertices_in_mesh[loop] for loop in fairing.boundary_loops(patch.triangles)]
        yield Shown(patch.name, patch.whole, patch.outside, loops, eye_of(patch), reach_of(patch))


def gaps() -> Iterator[Shown]:
    for name, (vertices, triangles, loops) in bridges.all_of_them().items():
        yield Shown(name, vertices, triangles, loops, np.array([0.5, -1.0, 0.7]), 1.9)


def save(shown: list[Any], path: Path) -> None:
    """Two in each row, three tiles each."""
    lines = (len(shown) + 1) // 2
    figure, axes = plt.subplots(lines, 6, figsize=(6 * 1.6, lines * 1.75), squeeze=False, dpi=130)
    for axis in axes.ravel():
        axis.axis("off")
    for k, one in enumerate(shown):
        row = axes[k // 2, 3 * (k % 2) : 3 * (k % 2) + 3]
        for axis, image in zip(row, one.tiles(), strict=True):
            axis.imshow(image)
        row[0].set_title(one.name, fontsize=7, loc="left", pad=2)
    figure.subplots_adjust(0, 0, 1, 0.97, 0.01, 0.1)
    figure.canvas.draw()
    picture = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())[:, :, :3])  # type: ignore[attr-defined]
    webp.save(picture, path)
    plt.close(figure)


def write_all(folder: Path) -> Iterator[str]:
    """All pictures; the names of the files."""
    sheets = ("fill_holes.webp", real_holes), ("fill_bridges.webp", gaps), ("fill_meshes.webp", quad_sheet.new_meshes)
    for name, kind in sheets:
        shown = list(kind())
        save(shown, folder / name)
        yield f"{folder / name}: {(folder / name).stat().st_size // 1000} kB"
