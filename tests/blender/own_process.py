"""Runs a few lines in a Blender of their own, the packaged zip installed: for what would spoil the tests' own one."""

import os
import subprocess
import sys
from pathlib import Path

INSTALL = """
import conftest  # before bpy: it sets Blender's scratch folder
import bpy

bpy.ops.extensions.package_install_files(
    repo="user_default", filepath=str(conftest._zip()), enable_on_install=True, overwrite=True
)
conftest.call_engine_fairing()
"""


def run(lines: str, scratch: Path, before: str = "", timeout: float = 120.0) -> subprocess.CompletedProcess[str]:
    """Run `before`, install and enable, run the lines; return what was printed, after a good end."""
    path = os.pathsep.join([str(Path(__file__).parent), os.environ.get("PYTHONPATH", "")])  # bpy may be found by it
    environment = {**os.environ, "PYTHONPATH": path, "TMPDIR": str(scratch)}
    ended = subprocess.run(
        [sys.executable, "-c", before + INSTALL + lines],
        env=environment,
        capture_output=True,
        text=True,
        timeout=timeout,
        check=False,
    )
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert "Traceback" not in ended.stderr
    return ended
