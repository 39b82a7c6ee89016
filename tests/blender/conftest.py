"""Installs the packaged zip into a scratch Blender once; every test starts from an empty file."""

import importlib
import os
import shutil
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

# Before bpy is imported: it looks for its folders then.
SCRATCH = Path(tempfile.mkdtemp(prefix="fairing-blender-"))
os.environ["BLENDER_USER_RESOURCES"] = str(SCRATCH)
sys.path.insert(0, str(Path(__file__).parent))

import bpy  # noqa: E402

PACKAGES = Path(__file__).parents[2] / "build" / "package"


def _zip() -> Path:
    given = os.environ.get("FAIRING_ZIP")
    found = [Path(given)] if given else sorted(PACKAGES.glob("*-linux_x64.zip"))
    if len(found) != 1 or not found[0].is_file():
        pytest.exit("run scripts/package first: the tests use the zip that it builds", 2)
    return found[0]


def call_engine_fairing() -> None:
    """The extension's own engine has a name of its own; the tests say `import fairing`."""
    package = importlib.import_module("bl_ext.user_default.intrinsic_fairing")
    if hasattr(package, "fairing"):
        sys.modules["fairing"] = package.fairing


@pytest.fixture(scope="session", autouse=True)
def extension() -> Iterator[None]:
    """Install and enable the zip, wheel included, and make sure that this wheel is the one used."""
    bpy.ops.extensions.package_install_files(
        repo="user_default", filepath=str(_zip()), enable_on_install=True, overwrite=True
    )
    call_engine_fairing()
    assert Path(sys.modules["fairing"].__file__ or "").is_relative_to(SCRATCH)
    yield
    shutil.rmtree(SCRATCH, ignore_errors=True)


@pytest.fixture(autouse=True)
def empty_file(extension: None) -> None:
    """Start from nothing, with no report left over."""
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
