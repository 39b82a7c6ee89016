"""Colours for new faces: closed forms, whatever the triangles, the seams and the places of the faces on the image."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from core.boundary_colours import Picture
from core.colours import Coding
from core.textured_mesh import TexturedMesh
from core.texturing import Textured, textured

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]
LIGHT = Coding(srgb=False, straight=False, clipped=False)
BYTES = Coding(srgb=True, straight=True, clipped=True)
SIZE = 256  # texels
LOW, HIGH = 0.1, 0.7  # where the sheet lies on the image

Field = Callable[[Floats, Floats], Floats]


def sheet(cells: int = 12, seed: int = 0, turned: bool = True) -> tuple[Floats, NDArray[np.int64]]:
    """(n, 2) in the unit square, shaken inside, and triangles whose diagonals go either way."""
    rng = np.random.default_rng(seed)
    steps = np.linspace(0.0, 1.0, cells + 1)
    points = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    inside = (np.abs(points - 0.5) < 0.49).all(axis=1)
    points[inside] += rng.uniform(-0.25, 0.25, (np.count_nonzero(inside), 2)) / cells
    row, column = np.divmod(np.arange(cells**2), cells)
    a = row * (cells + 1) + column
    b, c, d = a + 1, a + cells + 2, a + cells + 1
    other = (rng.random(cells**2) < 0.5)[:, None] & turned
    first = np.where(other, np.stack([a, b, d], 1), np.stack([a, b, c], 1))
    second = np.where(other, np.stack([b, c, d], 1), np.stack([a, c, d], 1))
    return points, np.concatenate([first, second])


def textured_sheet(cells: int = 12, seed: int = 0) -> TexturedMesh:
    """A flat sheet with a hole of new triangles in its middle, as large on the image as around."""
    points, triangles = sheet(cells, seed)
    new = (np.abs(points[triangles].mean(axis=1) - 0.5) < 0.25).all(axis=1)
    places = SIZE * (LOW + (HIGH - LOW) * points[triangles])
    space = np.column_stack([points @ [[3.0, 0.0], [0.0, 3.0]], np.zeros(len(points))])
    return TexturedMesh(space, triangles, places, np.zeros(len(triangles), np.int64), new)


def centres() -> tuple[Floats, Floats]:
    """The places on the sheet of all texels."""
    steps = ((np.arange(SIZE) + 0.5) / SIZE - LOW) / (HIGH - LOW)
    x, y = np.meshgrid(steps, steps)
    return x, y


def picture_of(field: Field, mesh: TexturedMesh, coding: Coding = LIGHT) -> Picture:
    """The field in all channels where old triangles are, and something else elsewhere."""
    x, y = centres()
    light = np.repeat(field(x, y)[..., None], 4, axis=2)
    light[..., 3] = 1.0
    light[~covered(mesh, ~mesh.new)] = [1.0, 0.0, 1.0, 1.0]
    stored = coding.encoded(light)
    return Picture((np.round(stored * 255) / 255 if coding.clipped else stored).astype(np.float32), coding)


def covered(mesh: TexturedMesh, of: Mask) -> Mask:
    """The texels with their centres in these triangles, by a test of all pairs near."""
    found = np.zeros((SIZE, SIZE), dtype=bool)
    y, x = np.mgrid[:SIZE, :SIZE] + 0.5
    for corners in mesh.places[of]:
        low, high = np.floor(corners.min(axis=0)).astype(int), np.ceil(corners.max(axis=0)).astype(int)
        part = np.s_[low[1] : high[1] + 1, low[0] : high[0] + 1]
        to = corners - np.stack([x[part], y[part]], axis=-1)[..., None, :]
        ahead = np.roll(to, -1, axis=2)
        turns = to[..., 0] * ahead[..., 1] - to[..., 1] * ahead[..., 0]
        found[part] |= (turns > 0).all(axis=2) | (turns < 0).all(axis=2)
    return found


def error(result: Textured, field: Field, mesh: TexturedMesh) -> float:
    """The largest difference at texels of new triangles that did not move."""
    x, y = centres()
    inside = covered(mesh, mesh.new)
    assert np.count_nonzero(inside) > 1000
    return float(np.abs(result.pixels[0][inside, 0] - field(x, y)[inside]).max())


def ramp(x: Floats, y: Floats) -> Floats:
    return 0.2 + 0.5 * x - 0.3 * y * 0.5


def saddle(x: Floats, y: Floats) -> Floats:
    return 0.5 + (x - 0.4) ** 2 - (y - 0.5) ** 2


def wave(x: Floats, y: Floats) -> Floats:
    """Harmonic: z⁴, three turns around the middle of the hole."""
    z = 2.0 * (x - 0.5 + 1j * (y - 0.5))
    return 0.5 + 0.5 * np.real(z**4)


def test_a_ramp_goes_on() -> None:
    mesh = textured_sheet()
    result = textured(mesh, [picture_of(ramp, mesh)])
    assert not result.moved.any()
    assert error(result, ramp, mesh) < 1e-5


def test_a_ramp_of_light_goes_on_in_bytes() -> None:
    """To the last step of what sRGB stores."""
    mesh = textured_sheet()
    picture = picture_of(ramp, mesh, BYTES)
    result = textured(mesh, [picture])
    x, y = centres()
    inside = covered(mesh, mesh.new)
    wanted = BYTES.encoded(np.stack([ramp(x, y)] * 3 + [np.ones_like(x)], axis=-1))[inside, 0]
    assert np.abs(result.pixels[0][inside, 0] - wanted).max() < 1.0 / 255.0


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("cells", [4, 12, 48])
@pytest.mark.parametrize("field", [saddle, wave])
def test_harmonic_fields_go_on(field: Field, cells: int, seed: int) -> None:
    """However few triangles there are, and however they are cut."""
    mesh = textured_sheet(cells, seed)
    result = textured(mesh, [picture_of(field, mesh)])
    assert error(result, field, mesh) < 0.5 / 255.0
