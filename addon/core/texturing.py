"""Colours for new faces on images: harmonic from what is around. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

import fairing

from .arrays import Floats, Ints, Mask, Pixels
from .boundary_colours import Picture, Samples, colours_at
from .charts import NO_SPACE, Chart, Taken, charts_of, flattened, lies_over_itself, move_to_free_space
from .fill_options import TEXTURE
from .grain import TOO_NARROW, Grain
from .option_table import fields_of
from .texels import MARGIN, Window, spread
from .textured_mesh import TexturedMesh

NOTHING_AROUND = "None of the faces around the selection has colours of an image: select new faces within textured ones"


@dataclass(frozen=True)
class Textured:
    """What has become of the new triangles."""

    places: Floats  # (m, 3, 2) in texels of their images
    moved: Mask  # (m,) whether they have other places than before
    pixels: dict[int, Pixels]  # by the number of the image
    left: Mask  # (m,) those that hang together with no textured face


@dataclass(frozen=True)
class _Coloured:
    """The new triangles, finer, with colours."""

    graded: fairing.GradedMesh
    colours: Floats  # (q, 4)


@dataclass(frozen=True)
class TextureOptions:
    """What the options of `mesh.fair_texture` (fill_options.py) come to."""

    detail: float = 0.0  # 0 … 1
    detail_from: str = ""  # name of a vertex group

    @classmethod
    def of(cls, properties: Any) -> TextureOptions:
        """Read every option from an object that has them as attributes."""
        return cls(**fields_of(TEXTURE, partial(getattr, properties)))


def textured(mesh: TexturedMesh, pictures: list[Picture], detail: float = 0.0) -> Textured:
    """Continue the colours around over the new triangles; detail: how much of the texture's fine part they get, 0 … 1.

    Raises ValueError where there are none, and where the image has no room.
    """
    texel = mesh.texel_length()
    if not texel > 0.0:
        raise ValueError(NOTHING_AROUND)
    coloured = _coloured(mesh, pictures, texel)
    painted = np.isfinite(coloured.colours[coloured.graded.triangles]).all(axis=(1, 2))
    left = np.zeros(len(mesh.chosen), dtype=bool)
    left[coloured.graded.parent[~painted]] = True
    places = mesh.places[mesh.chosen].copy()
    moved = np.zeros(len(places), dtype=bool)
    pixels = {}
    for number, picture in enumerate(pictures):
        rows = np.flatnonzero((mesh.image[mesh.chosen] == number) & ~left)
        if not len(rows):
            continue
        taken = _taken(mesh, number, picture)
        charts = _laid_out(mesh, rows, taken, texel)
        pixels[number] = picture.pixels.copy()
        grain = _grain(mesh, number, picture) if detail > 0.0 else None
        for chart in charts:
            places[chart.rows] = chart.corners
            moved[chart.rows] = chart.moved
            window, stored, written = _painted(coloured, chart, taken.all, picture)
            if grain is not None:
                stored[..., :3] += detail * grain.on(window, chart.coarser)
            y, x = np.broadcast_arrays(*window.of(picture.pixels))
            pixels[number][y[written], x[written]] = picture.coding.clip(stored[written])
    return Textured(places, moved, pixels, left)


def _coloured(mesh: TexturedMesh, pictures: list[Picture], texel: float) -> _Coloured:
    used, triangles = np.unique(mesh.triangles[mesh.chosen], return_inverse=True)
    graded = fairing.graded_mesh(mesh.points[used], triangles.reshape(-1, 3), mesh.sides_around >= 0, texel)
    samples = Samples.along(mesh, graded)
    known, at = np.unique(samples.vertices, return_inverse=True)
    colours = colours_at(mesh, samples, pictures)
    count = np.bincount(at)
    given = np.stack([np.bincount(at, weights=column) / count for column in colours.T], axis=1)
    return _Coloured(graded, fairing.harmonic_extension(graded.vertices, graded.triangles, known, given))


def _taken(mesh: TexturedMesh, number: int, picture: Picture) -> Taken:
    old = np.flatnonzero(~mesh.new & (mesh.image == number))
    owners, _ = fairing.texel_owners(mesh.places[old], picture.width, picture.height)
    is_other = np.append(~np.isin(old, mesh.near), False)  # the last one, −1, is for texels without an owner
    return Taken(owners >= 0, is_other[owners])


def _laid_out(mesh: TexturedMesh, rows: Ints, taken: Taken, texel: float) -> list[Chart]:
    """Return charts of new triangles (their rows among these), none over old faces or over another one."""
    stay, move = [], []
    on_surface, _ = mesh.areas(mesh.chosen)
    triangles = mesh.triangles[mesh.chosen]
    masks = Taken(taken.all.copy(), taken.others.copy())
    for chart in charts_of(triangles[rows], mesh.places[mesh.chosen][rows]):
        chart.rows = rows[chart.rows]
        if lies_over_itself(chart, float(on_surface[chart.rows].sum()) / texel**2):
            move += flattened(mesh.points, triangles, chart, texel)
        elif masks.accepts(chart):
            masks.add(chart)
            stay.append(chart)
        else:
            move.append(chart)
    if move and not move_to_free_space(move, masks.all):
        # As large as on the surface: they may have been stretched.
        move = [part for chart in move for part in flattened(mesh.points, triangles, chart, texel)]
        if not move_to_free_space(move, masks.all):
            raise ValueError(NO_SPACE)
    return stay + move


def _painted(coloured: _Coloured, chart: Chart, taken: Mask, picture: Picture) -> tuple[Window, Pixels, Mask]:
    """Return a window around a chart, what the image is to store there, and where: not on what is taken."""
    graded = coloured.graded
    number = np.full(int(graded.parent.max()) + 1, -1)
    number[chart.rows] = np.arange(len(chart.rows))
    rows = np.flatnonzero(number[graded.parent] >= 0)
    corners = np.einsum("skw,swx->skx", graded.weights[rows], chart.corners[number[graded.parent[rows]]])
    window = Window.around(chart.corners, MARGIN)
    colours = window.values(corners, coloured.colours[graded.triangles[rows]])
    free = ~taken[window.of(taken)]
    written = spread(colours, np.isfinite(colours[..., 0]) & free, ~free)
    stored = np.zeros_like(colours)
    stored[written] = picture.coding.encoded(colours[written])
    return window, stored, written


def _grain(mesh: TexturedMesh, number: int, picture: Picture) -> Grain:
    """Raises ValueError where all samples are too narrow."""
    for sample in mesh.samples():
        of = sample & (mesh.image == number)
        owners, _ = fairing.texel_owners(mesh.places[of], picture.width, picture.height)
        grain = Grain.of(picture.pixels, owners >= 0)
        if grain is not None:
            return grain
    raise ValueError(TOO_NARROW)
