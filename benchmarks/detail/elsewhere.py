"""Skin from elsewhere: a sphere with pores whose patch was smoothed; discs copied, and the way that was not taken."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw
from scipy.sparse import coo_array, diags_array
from scipy.sparse.linalg import splu
from scipy.spatial import cKDTree

import cases
import fairing
import webp
from cases import Case
from engine import FloatArray
from meshing import IntArray
from sheets import GREY, TILE, TINT
from stripes import Layer, facing, render

SIZE = 0.15  # of D: wider than a pore
DEPTH, WIDTH, APART = 0.012, 0.035, 0.11  # of the pores of a unit sphere


def with_pores() -> Case:
    """A unit sphere with pores everywhere; `skin` has them in the patch, too, `vertices` not."""
    case = cases.sphere(20000, 0.0, 3, along_normal=True)
    sphere = case.skin / np.linalg.norm(case.skin, axis=1)[:, None]
    middles: list[FloatArray] = []
    for place in np.random.default_rng(1).normal(size=(900, 3)):
        middle = place / np.linalg.norm(place)
        if all(np.linalg.norm(middle - other) > APART for other in middles):
            middles.append(middle)
    depth = DEPTH * np.exp(-((cKDTree(np.array(middles)).query(sphere)[0] / WIDTH) ** 2))
    skin = sphere * (1 - depth)[:, None]
    bare = skin.copy()
    bare[case.free] = sphere[case.free]
    normals = fairing.surrounding_normals(bare, case.outside, case.outline).normals
    return replace(case, name="from", vertices=bare, skin=skin, normals=normals)


def sample(case: Case) -> IntArray:
    """The lower part of the sphere."""
    return np.asarray(case.outside[(case.skin[case.outside, 2] < 0.1).all(axis=1)])


def low_pass(points: FloatArray, triangles: IntArray, wavelength: float, field: FloatArray) -> FloatArray:
    """What is longer than the wavelength; borders are free."""
    rows, columns, values = fairing.cotan_laplacian(points, triangles)
    stiffness = coo_array((values, (rows, columns)), shape=(len(points), len(points)))
    corners = points[triangles]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 6
    mass = np.full(len(points), 1e-12)
    np.add.at(mass, triangles, area[:, None])
    bending = (wavelength / (2 * np.pi)) ** 2 / 2 * (np.sqrt(2) - 1)
    factor = splu((diags_array(mass) + bending * stiffness).tocsc())
    return np.asarray(factor.solve(mass * factor.solve(mass * field)))


def bands(points: FloatArray, triangles: IntArray, wavelengths: FloatArray, field: FloatArray) -> FloatArray:
    """The field in bands of wavelengths, a row each."""
    parts = []
    for wavelength in wavelengths:
        longer = low_pass(points, triangles, wavelength, field)
        parts.append(field - longer)
        field = longer
    return np.array([*parts, field])


def noise_of_the_same_spectrum(case: Case, base: FloatArray) -> FloatArray:
    """White noise on the base whose bands get the sample's root mean squares: the way that was not taken."""
    wavelengths = SIZE * case.diameter / np.array([4.0, 2.0, 1.0])
    up = base / np.linalg.norm(base, axis=1)[:, None]
    heights = np.linalg.norm(case.skin, axis=1) - 1
    there = np.unique(sample(case))
    wanted = bands(case.skin, sample(case), wavelengths, heights - heights[there].mean())[:, there]
    noise = np.random.default_rng(0).normal(size=len(base))
    noise[np.setdiff1d(np.arange(len(base)), case.free)] = 0
    for _ in range(6):
        parts = bands(base, case.inside, wavelengths, noise)
        gains = np.sqrt((wanted**2).mean(axis=1) / (parts[:, case.free] ** 2).mean(axis=1))
        noise = gains @ parts
    result = base.copy()
    result[case.free] += (noise[:, None] * up)[case.free]
    return result


def write(folder: Path) -> None:
    """The picture of docs/detail.md."""
    case = with_pores()
    copied = case.fair(detail=1.0, detail_size=SIZE, detail_from=sample(case))
    assert copied.base is not None
    shown = {
        "before it was smoothed": case.skin,
        "fair": case.fair().vertices,
        "discs copied from below": copied.vertices,
        "noise of the same spectrum": noise_of_the_same_spectrum(case, copied.base),
    }
    picture = Image.new("RGB", (len(shown) * TILE, TILE + 16), "white")
    draw = ImageDraw.Draw(picture)
    view = facing(case.facing, np.array([0.0, -0.1, 0.6]), 0.55 * case.diameter, TILE)
    for k, (name, points) in enumerate(shown.items()):
        draw.text((k * TILE + 6, 2), name, fill="black")
        image = render([Layer(points, case.outside, GREY), Layer(points, case.inside, TINT)], view)
        picture.paste(Image.fromarray((255 * image.clip(0, 1)).astype(np.uint8)), (k * TILE, 16))
    webp.save(picture, folder / "detail_from.webp")
