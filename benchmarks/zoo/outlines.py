"""Pictures of real patches with several outlines that no harmonic surface joins: before, by that equation, as taken.

    python benchmarks/zoo/outlines.py --seed 1                                     # build/zoo/outlines.webp
    python benchmarks/zoo/outlines.py --seed 31 --out build/zoo/31.webp

Each row: the patch before, what came of the harmonic equation alone (`otherwise="stop"`), and what is taken, from two
sides each. Stripes are lines of equal tilt, red is seen from behind. The title names the equation that holds. Needs the
meshes of shared/data beside the checkout.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "paper"))

import numpy as np
from PIL import Image, ImageDraw

import webp
from engine import LIMIT, Engine, FloatArray, Outcome
from rasteriser import View, rasterise
from real_meshes import RealPatch, random_patches
from stripes import vertex_normals

ROOT = Path(__file__).resolve().parents[2]
SIZE = 120  # pixels of a tile
TITLE = 12
PATCH, AROUND, BEHIND = (0.5, 0.75, 1.0), (0.9, 0.9, 0.9), (0.8, 0.3, 0.3)
STRIPES = 16.0
LEAST_SIDED = 0.2  # share of the patch's area that faces one way, for a view from there


@dataclass(frozen=True)
class Case:
    """A patch, what came of the harmonic equation alone, and what is taken by default."""

    patch: RealPatch
    alone: Outcome
    taken: Outcome

    @property
    def title(self) -> str:
        """One line."""
        name, start, _ = self.patch.name.split(":")
        return f"{name} {start}, {self.patch.free} free, {self.patch.loops} loops: {self.taken.equation}"


def solved(engine: Engine, patch: RealPatch, otherwise: str) -> Outcome:
    """From the vertices as they are."""
    return engine.fair(
        patch.vertices, patch.triangles, fixed=patch.fixed, fixed_normals=patch.normals,
        neighbours=patch.neighbours, otherwise=otherwise,
    )  # fmt: skip


def cases(patches: int, seed: int) -> Iterator[Case]:
    """Those that are not harmonic."""
    engine = Engine(LIMIT)
    for patch in random_patches(patches, seed):
        if patch.loops < 2:
            continue
        taken = solved(engine, patch, "least_variation")
        if taken.equation != "harmonic":
            yield Case(patch, solved(engine, patch, "stop"), taken)
    engine.close()


def views(patch: RealPatch) -> list[View]:
    """From where most of the patch is seen, and across."""
    corners = patch.vertices[patch.triangles]
    areas = 0.5 * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    mean = areas.sum(axis=0) / np.linalg.norm(areas, axis=1).sum()
    centre = patch.vertices.mean(axis=0)
    along, across, least = np.linalg.svd(patch.vertices - centre, full_matrices=False)[2]
    front = mean if np.linalg.norm(mean) > LEAST_SIDED else least + 0.2 * across
    side = np.cross(front, along) / np.linalg.norm(front) + 0.3 * front
    width = 2.3 * float(np.linalg.norm(patch.vertices - centre, axis=1).max())
    up = along if abs(along @ front) < 0.9 * np.linalg.norm(front) else across
    target = (float(centre[0]), float(centre[1]), float(centre[2]))
    return [View(target, tuple(direction), width, tuple(up)) for direction in (front, side)]


def tile(patch: RealPatch, surface: FloatArray, view: View) -> FloatArray:
    """A picture (SIZE, SIZE, 3) in 0 … 1 of one surface over the patch, with what surrounds it."""
    near = np.linalg.norm(patch.whole - np.asarray(view.target), axis=1) < 1.5 * view.width
    outside = patch.outside[near[patch.outside].all(axis=1)]
    vertices, triangles = np.vstack([surface, patch.whole]), np.vstack([patch.triangles, outside + len(surface)])
    seen = rasterise(view.project(vertices, SIZE), triangles, (SIZE, SIZE))
    which, weights = seen.triangle[seen.covered], seen.weights[seen.covered]
    normals = np.einsum("pk,pkd->pd", weights, vertex_normals(vertices, triangles)[triangles[which]]) @ view.axes.T
    normals /= np.linalg.norm(normals, axis=1)[:, None].clip(1e-12)
    colours = np.where((which < len(patch.triangles))[:, None], PATCH, AROUND)
    colours = colours * np.where(np.sin(STRIPES * np.arcsin(normals[:, 1].clip(-1, 1))) > 0, 1.0, 0.75)[:, None]
    colours = np.where((normals[:, 2] < 0)[:, None], BEHIND, colours)
    light = 0.25 + 0.75 * np.abs(normals @ (0.33, 0.5, 0.8)).clip(0, 1)
    image = np.ones((SIZE, SIZE, 3))
    image[seen.covered] = colours * light[:, None]
    return image


def row(case: Case) -> Image.Image:
    """The six tiles of a case under its title; white where the equation alone came to nothing."""
    sides = views(case.patch)
    surfaces = [case.patch.vertices, case.alone.vertices, case.taken.vertices]
    white = np.ones((SIZE, SIZE, 3))
    tiles = [tile(case.patch, s, view) if len(s) else white for s in surfaces for view in sides]
    picture = Image.new("RGB", (SIZE * len(tiles), SIZE + TITLE), "white")
    picture.paste(Image.fromarray((255 * np.hstack(tiles).clip(0, 1)).astype(np.uint8)), (0, TITLE))
    ImageDraw.Draw(picture).text((2, 0), case.title, fill="black")
    return picture


def sheet(rows: list[Image.Image]) -> Image.Image:
    """All rows, two side by side."""
    half = (len(rows) + 1) // 2
    width, height = rows[0].size
    picture = Image.new("RGB", (2 * width + TITLE, half * height), "white")
    for k, one in enumerate(rows):
        picture.paste(one, ((k // half) * (width + TITLE), (k % half) * height))
    return picture


def main() -> int:
    """Write the picture; 2 without cases."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--patches", type=int, default=120, help="number of random patches, of all outlines")
    parser.add_argument("--seed", type=int, default=1, help="of the random patches")
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "zoo" / "outlines.webp", help="the picture")
    options = parser.parse_args()
    rows = [row(case) for case in cases(options.patches, options.seed)]
    if not rows:
        print("every patch has a harmonic surface", file=sys.stderr)
        return 2
    webp.save(sheet(rows), options.out)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
