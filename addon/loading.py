"""Whether the engine's native module loads here; where it doesn't, what is to be known about it."""

from __future__ import annotations

import platform
import sys
import tomllib
from functools import cache
from pathlib import Path
from typing import Any


def manifest() -> dict[str, Any]:
    """Return the extension's manifest."""
    return tomllib.loads((Path(__file__).parent / "blender_manifest.toml").read_text(encoding="utf-8"))


@cache
def problem() -> str:
    """Return why the module can't be used, or nothing."""
    try:
        import fairing  # noqa: F401
    except ImportError as error:  # a missing wheel, or one that this system can't load
        return str(error)
    return ""


def system() -> str:
    """Return the platform, with its C library where that matters."""
    library = " ".join(platform.libc_ver()) if sys.platform == "linux" else ""
    return " ".join(part for part in (platform.platform(terse=True), platform.machine(), library) if part)


def details() -> tuple[tuple[str, str], ...]:
    """Return what a report of the problem has to hold, as pairs of label and value."""
    said = manifest()
    wheels = [Path(wheel).name for wheel in said.get("wheels", ())] or ["none"]
    return (
        ("Reason", problem()),
        ("Platform", system()),
        ("Python", platform.python_version()),
        ("Made for", ", ".join(said["platforms"])),
        *(("Wheel", wheel) for wheel in wheels),
    )
