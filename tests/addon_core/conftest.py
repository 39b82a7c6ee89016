"""Lets the add-on's modules of arrays be imported by themselves, without the extension around them, without bpy."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "scripts"))

import plain_addon  # noqa: F401
