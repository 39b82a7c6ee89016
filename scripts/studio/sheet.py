"""Sheets of pictures with a word under each, 24 bits a pixel."""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import blf
import bpy
import imbuf
import numpy as np
from numpy.typing import NDArray

from demo_pictures import pixels

Pixels = NDArray[np.float32]

GAP = 8  # pixels between tiles
LINE = 30  # pixels of a line of text
TEXT = 21.0  # its size, pixels
PAPER = 0.09  # grey of the background, and of the gaps


class Tile(NamedTuple):
    """Pictures that stand one above the other, and the lines of text below them."""

    pictures: Sequence[Path]
    lines: Sequence[str]


def save(values: Pixels, path: Path, kind: str) -> None:
    """Write (height, width, 4) pixels from the bottom to the top; kind: Blender's name of the file's format."""
    height, width, _ = values.shape
    image = bpy.data.images.new(path.stem, width, height, alpha=False)
    image.pixels.foreach_set(values.astype(np.float32).ravel())
    image.filepath_raw = str(path)
    image.file_format = kind
    image.save(quality=88)
    bpy.data.images.remove(image)


def written(values: Pixels, texts: list[tuple[int, int, str]], scratch: Path) -> Pixels:
    """Draw texts at (x, y) from the lower left; needs Blender 5.0, which draws text into images without a window."""
    save(values, scratch, "PNG")
    buffer = imbuf.load(str(scratch))
    blf.size(0, TEXT)
    blf.color(0, 0.93, 0.93, 0.93, 1.0)
    with blf.bind_imbuf(0, buffer):
        for x, y, text in texts:
            blf.position(0, x, y, 0)
            blf.draw_buffer(0, text)
    imbuf.write(buffer, filepath=str(scratch))
    return pixels(scratch)


def sheet(rows: Sequence[Sequence[Tile]], target: Path) -> None:
    """Rows of tiles from top to bottom, all pictures of one size; written as target's suffix says: .webp or .png."""
    side = pixels(rows[0][0].pictures[0]).shape[0]
    wide = max(len(row) for row in rows) * (side + GAP) + GAP
    heights = [max(len(tile.pictures) * (side + GAP) + len(tile.lines) * LINE + GAP for tile in row) for row in rows]
    values = np.full((sum(heights) + GAP, wide, 4), PAPER, dtype=np.float32)
    values[..., 3] = 1.0
    texts = []
    top = values.shape[0] - GAP
    for row, height in zip(rows, heights, strict=True):
        for column, tile in enumerate(row):
            left, at = GAP + column * (side + GAP), top
            for picture in tile.pictures:
                values[at - side : at, left : left + side] = pixels(picture)
                at -= side + GAP
            texts += [(left + 2, at - LINE * (k + 1) + GAP + 5, line) for k, line in enumerate(tile.lines)]
        top -= height
    scratch = target.with_name(f"{target.stem}_text.png")
    save(written(values, texts, scratch), target, target.suffix[1:].upper())
    scratch.unlink()
