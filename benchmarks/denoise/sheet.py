"""A picture: given, and what each filter made of it, whole and close up."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

import webp
from engine import FloatArray
from stripes import Layer, facing, render

TILE, HEAD = 330, 26  # pixels
GREY = (0.82, 0.82, 0.82)


def upright(points: FloatArray) -> FloatArray:
    """Turn y, which is up in the meshes, into z."""
    return points[:, [0, 2, 1]] * (1.0, -1.0, 1.0)


def write(made: dict[str, FloatArray], triangles: np.ndarray, path: Path) -> None:
    """Draw one column for each of the surfaces."""
    picture = Image.new("RGB", (len(made) * TILE, 2 * TILE + HEAD), "white")
    draw = ImageDraw.Draw(picture)
    font = ImageFont.load_default(16)
    clean = upright(made["clean"])
    low, high = clean.min(axis=0), clean.max(axis=0)
    for column, (name, surface) in enumerate(made.items()):
        points = upright(surface)
        draw.text((column * TILE + 8, 4), name, fill="black", font=font)
        for row, share in enumerate((0.56, 0.16)):
            centre = (low + high) / 2 + (0.0, 0.0, 0.0 if row == 0 else 0.2) * (high - low)
            view = facing(np.array([0.4, -1.0, 0.25]), centre, share * float((high - low).max()), TILE)
            image = render([Layer(points, triangles, GREY)], view)
            tile = Image.fromarray((255 * image.clip(0, 1)).astype(np.uint8))
            picture.paste(tile, (column * TILE, HEAD + row * TILE))
    webp.save(picture, path)
