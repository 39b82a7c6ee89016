"""Installs an extension's zip into bpy as a user would, and restores half a sphere with it.

use_zip.py ZIP
"""

import importlib
import os
import sys
import tempfile
from pathlib import Path

SCRATCH = tempfile.TemporaryDirectory(prefix="fairing-package-", ignore_cleanup_errors=True)  # a loaded .pyd stays
os.environ["BLENDER_USER_RESOURCES"] = SCRATCH.name  # before bpy looks for it
sys.path.insert(0, str(Path(__file__).parents[2] / "tests" / "blender"))

import bpy  # noqa: E402
import numpy as np  # noqa: E402

import meshes  # noqa: E402

TOLERANCE = 1e-4  # of the radius: Blender's positions are single precision, the rim has 48 edges


def main() -> int:
    """Return 0 where the upper half came back onto the sphere."""
    bpy.ops.extensions.package_install_files(
        repo="user_default", filepath=str(Path(sys.argv[1]).resolve()), enable_on_install=True, overwrite=True
    )
    wheel = Path(importlib.import_module("bl_ext.user_default.intrinsic_fairing").fairing.__file__)
    if not wheel.is_relative_to(SCRATCH.name):
        sys.exit(f"the module is not the zip's: {wheel}")
    ball = meshes.sphere()
    points = meshes.positions(ball)
    upper = meshes.faces_where(ball, lambda centre: centre.z > 0.0)
    points *= 1.0 - 0.3 * np.clip(points[:, 2:], 0.0, None) ** 2  # no hard edge at the equator
    meshes.move(ball, points)
    meshes.fair(ball, upper)
    distance = float(np.abs(np.linalg.norm(meshes.positions(ball), axis=1) - 1.0).max())
    print(f"bpy {bpy.app.version_string}, Python {sys.version.split()[0]}: half a sphere back to {distance:.1e} of it")
    return int(not distance < TOLERANCE)


if __name__ == "__main__":
    sys.exit(main())
