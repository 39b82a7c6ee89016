"""Lets the add-on's room of arrays be imported by itself: `core`, without the extension around it, without bpy.

The script that draws the rooms can be imported, too: it knows how to read imports.
"""

from __future__ import annotations

import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "scripts")]
