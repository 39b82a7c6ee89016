"""The quality overlay's figures and switches; its pictures are for the GUI tests."""

from __future__ import annotations

from typing import Any

import bpy
import meshes
import numpy as np
import pytest
from extension import module
from mathutils import Matrix
from test_refusals import add_tent


@pytest.fixture
def overlay() -> Any:
    found = module("show.overlay")
    yield found.overlay
    found.stop()


def settings() -> Any:
    return bpy.context.window_manager.fairing_overlay


@pytest.mark.parametrize("scale", [1.0, 2.5])
def test_sphere_has_its_normals_and_curvature(overlay: Any, scale: float) -> None:
    obj = meshes.sphere(96)
    obj.matrix_world = Matrix.Translation((1.0, 2.0, 3.0)) @ Matrix.Diagonal((scale, scale, scale, 1.0))
    bpy.context.view_layer.update()
    settings().show = True
    (surface,) = overlay.surfaces
    radial = surface.positions - (1.0, 2.0, 3.0)
    # exact on spheres but for float32 positions: 1e-7 over edges of 0.065 squared, times the valence
    np.testing.assert_allclose(surface.normals, radial / scale, atol=1e-4)
    np.testing.assert_allclose(surface.curvature, -1.0 / scale, rtol=2e-3)
    assert surface.largest_curvature == pytest.approx(1.0 / scale, rel=2e-3)
    assert len(surface.triangles) == 2 * len(obj.data.polygons)


def test_follows_edits(overlay: Any) -> None:
    obj, faces = meshes.domed_grid()
    meshes.enter(obj, faces)
    settings().show = True
    before = overlay.surfaces[0].curvature.copy()
    meshes.run()
    bpy.context.view_layer.update()
    module("show.overlay")._measure_later()  # the timer's function; a background process runs no timers
    assert np.abs(overlay.surfaces[0].curvature - before).max() > 0.1
    assert bpy.app.timers.is_registered(module("show.overlay")._measure_later)


def test_measuring_is_no_change(overlay: Any) -> None:
    later = module("show.overlay")._measure_later
    obj, faces = meshes.domed_grid()
    meshes.enter(obj, faces)
    settings().show = True
    bpy.context.view_layer.update()
    if bpy.app.timers.is_registered(later):
        bpy.app.timers.unregister(later)
    overlay.measure(bpy.context)
    bpy.context.view_layer.update()
    assert not bpy.app.timers.is_registered(later)  # else it would go round for ever


def test_what_is_no_surface_is_reported(overlay: Any) -> None:
    obj, _ = meshes.domed_grid()
    add_tent(obj)
    settings().show = True
    assert overlay.surfaces == ()
    assert "More than two faces" in overlay.message


def test_switching_off_leaves_nothing(overlay: Any) -> None:
    meshes.sphere()
    count = len(bpy.app.handlers.depsgraph_update_post)
    settings().show = True
    assert len(bpy.app.handlers.depsgraph_update_post) == count + 1
    settings().stripes = 12  # changes the look, not the handlers
    assert len(bpy.app.handlers.depsgraph_update_post) == count + 1
    settings().show = False
    assert len(bpy.app.handlers.depsgraph_update_post) == count
    assert (overlay.surfaces, overlay.handle) == ((), None)


def attribute(obj: bpy.types.Object) -> Any:
    layer = obj.data.attributes["mean_curvature"]
    assert (layer.data_type, layer.domain) == ("FLOAT", "POINT")
    values = np.empty(len(layer.data), dtype=np.float32)
    layer.data.foreach_get("value", values)
    return values


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_curvature_attribute(mode: str) -> None:
    obj = meshes.sphere(96)
    obj.scale = (2.0, 2.0, 2.0)
    before = meshes.contents(obj)
    bpy.ops.object.mode_set(mode=mode)
    for _ in range(2):  # the second run overwrites
        assert bpy.ops.mesh.fair_curvature() == {"FINISHED"}
    meshes.leave()
    np.testing.assert_allclose(attribute(obj), -0.5, rtol=2e-3)
    after = meshes.contents(obj)
    assert after["POINT position"] == before["POINT position"]


def test_curvature_attribute_of_another_kind_is_refused() -> None:
    obj = meshes.sphere()
    obj.data.attributes.new("mean_curvature", "FLOAT_COLOR", "CORNER")
    with pytest.raises(RuntimeError, match="another attribute"):
        bpy.ops.mesh.fair_curvature()
