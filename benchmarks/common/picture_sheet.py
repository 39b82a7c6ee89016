"""Contact sheets: pictures in rows with a caption under each, as WebP or PNG files."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import matplotlib
import numpy as np
from PIL import Image, ImageDraw, ImageFont

from rasteriser import FloatArray

CAPTION = 26  # pixels
GAP = 6
LARGEST = 400_000  # bytes of a WebP file
QUALITIES = (92, 86, 78, 68)
PAPER = (255, 255, 255)
Panel = tuple[FloatArray, str]


def save_sheet(rows: Sequence[Sequence[Panel]], path: Path) -> None:
    """Write the rows as one picture; all pictures of a row have the same height."""
    widths = [sum(picture.shape[1] + GAP for picture, _ in row) + GAP for row in rows]
    heights = [max(picture.shape[0] for picture, _ in row) + CAPTION + GAP for row in rows]
    sheet = Image.new("RGB", (max(widths), sum(heights) + GAP), PAPER)
    pen = ImageDraw.Draw(sheet)
    font = ImageFont.truetype(str(Path(matplotlib.get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf"), 15)
    top = GAP
    for row, height in zip(rows, heights, strict=True):
        left = GAP
        for picture, caption in row:
            sheet.paste(Image.fromarray((np.clip(picture, 0, 1) * 255).round().astype(np.uint8)), (left, top))
            centre = (left + picture.shape[1] // 2, top + picture.shape[0] + CAPTION // 2)
            pen.text(centre, caption, fill=(20, 20, 20), font=font, anchor="mm")
            left += picture.shape[1] + GAP
        top += height
    if path.suffix == ".png":
        sheet.save(path)
    else:
        save_webp(sheet, path)


def save_webp(picture: Image.Image, path: Path) -> None:
    """Write the picture with the best quality that is small enough; path ends in .webp."""
    path.parent.mkdir(parents=True, exist_ok=True)
    for quality in QUALITIES:
        picture.convert("RGB").save(path, "WEBP", quality=quality, method=6)
        if path.stat().st_size <= LARGEST:
            return
    raise ValueError(f"{path} has more than {LARGEST} bytes: draw fewer or smaller tiles")
