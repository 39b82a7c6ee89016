"""What Blender shows where the native module doesn't load."""

from __future__ import annotations

import importlib
import platform
import sys
from collections.abc import Iterator
from types import ModuleType

import bpy
import pytest
from extension import ID, module
from test_panel import Layout

Modules = dict[str, ModuleType]


def take_out() -> Modules:
    """Forget the extension's modules and the engine's, as a new Blender has none; return them."""
    names = [name for name in sys.modules if name.split(".")[0] == "fairing" or f"{name}.".startswith(f"{ID}.")]
    return {name: sys.modules.pop(name) for name in names}


@pytest.fixture
def disabled() -> Iterator[None]:
    """Disable the extension; enable it again, as it was, at the end."""
    bpy.ops.preferences.addon_disable(module=ID)
    taken = take_out()
    yield
    bpy.ops.preferences.addon_disable(module=ID)
    take_out()
    sys.modules.update(taken)
    bpy.ops.preferences.addon_enable(module=ID)
    assert bpy.ops.mesh.fair_region.get_rna_type().identifier == "MESH_OT_fair_region"


def drawn() -> str:
    class Shown:
        layout = Layout()

    shown = Shown()
    module("loading_panel").VIEW3D_PT_fairing_loading.draw(shown, bpy.context)
    return " ".join(shown.layout.told)


def enable() -> None:
    assert bpy.ops.preferences.addon_enable(module=ID) == {"FINISHED"}
    assert ID in bpy.context.preferences.addons
    assert hasattr(bpy.types, "VIEW3D_PT_fairing_loading")
    assert not hasattr(bpy.types, "VIEW3D_PT_fairing")


def test_module_is_missing(disabled: None, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]) -> None:
    """No traceback: a panel, and lines in the console, with platform, Python and wheel."""
    monkeypatch.setitem(sys.modules, "fairing", None)
    enable()
    told = drawn()
    wheel = importlib.import_module(f"{ID}.loading").manifest()["wheels"][0].removeprefix("./wheels/")
    for text in ("fairing", platform.machine(), platform.python_version(), "linux-x64", wheel):
        assert text in told
    printed, errors = capfd.readouterr()
    assert "Traceback" not in printed + errors
    assert wheel in printed


def test_native_part_cannot_be_loaded(disabled: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """The package is there, its compiled part isn't: what a wheel for another system does."""
    monkeypatch.setitem(sys.modules, "fairing._core", None)
    enable()
    assert "fairing._core" in drawn()


def test_module_of_another_version(disabled: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """After an update without a restart Blender still holds the old module."""
    held = ModuleType("fairing")
    held.__version__ = "0.0.9"  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "fairing", held)
    enable()
    told = drawn()
    assert "0.0.9" in told
    assert "Restart Blender" in told
