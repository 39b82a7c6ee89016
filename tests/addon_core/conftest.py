"""Lets modules of the add-on be imported without the extension around them, without bpy: `addon.fair.region`.

The script that draws the modules can be imported, too: it knows how to read imports.
"""

from __future__ import annotations

import sys
from pathlib import Path
from types import ModuleType

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
_package = ModuleType("addon")  # its own __init__ would register everything with Blender
_package.__path__ = [str(ROOT / "addon")]
sys.modules["addon"] = _package
