"""How the benchmarks write the docs' pictures: 24 bits a pixel, as WebP, 400 kB at most."""

from __future__ import annotations

from pathlib import Path

from PIL import Image

LARGEST = 400_000  # bytes
QUALITIES = (92, 86, 78, 68)


def save(picture: Image.Image, path: Path) -> None:
    """Write the picture with the best quality that is small enough; path ends in .webp."""
    path.parent.mkdir(parents=True, exist_ok=True)
    for quality in QUALITIES:
        picture.convert("RGB").save(path, "WEBP", quality=quality, method=6)
        if path.stat().st_size <= LARGEST:
            return
    raise ValueError(f"{path} has more than {LARGEST} bytes: draw fewer or smaller tiles")
