"""Lets the add-on's room of arrays be imported by itself: `core`, without the extension around it, without bpy."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "addon"))
