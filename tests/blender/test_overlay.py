"""The quality overlay's figures and switches; its pictures are for the GUI tests."""

from typing import Any

import bpy
import numpy as np
import pytest
from mathutils import Matrix

import meshes
from extension import module
from test_refusals import add_tent


@pytest.fixture
def overlay() -> Any:
    found = module("overlay.overlay")
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
    assert surface.usual("CURVATURE") == pytest.approx(1.0 / scale, rel=2e-3)
    assert len(surface.triangles) == 2 * len(obj.data.polygons)


def test_a_ball_is_red(overlay: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """As what a run has moved outwards is: the shader's colour for values above 0."""
    meshes.sphere(48)
    settings().show = True
    sent: dict[str, Any] = {}
    monkeypatch.setattr(module("overlay.overlay"), "batch_for_shader", lambda *args, **_: sent.update(args[2]))
    module("overlay.overlay")._batch(None, overlay.surfaces[0], "CURVATURE")
    assert (sent["curvature"] > 0.0).all()
    assert module("overlay.data").sense("DEVIATION") == 1.0


def test_deviation_is_the_distance_from_the_shape_before(overlay: Any) -> None:
    """A bump of a tenth on a sphere goes: its top comes down by as much, and what did not move is 0."""
    obj = meshes.sphere(48)
    points = meshes.positions(obj)
    top = points[:, 2] > 0.9
    meshes.move(obj, points * (1.0 + 0.1 * top[:, None]))
    faces = meshes.faces_where(obj, lambda centre: centre.z > 0.8)
    settings().mode = "DEVIATION"
    try:
        settings().show = True
        meshes.select(obj, faces)
        meshes.edit(obj)
        assert bpy.ops.mesh.fair_region("EXEC_DEFAULT", True) == {"FINISHED"}
        overlay.measure(bpy.context)
        (surface,) = overlay.surfaces
        highest = surface.positions[:, 2].argmax()
        assert surface.deviation[highest] == pytest.approx(-0.1, abs=5e-3)
        assert surface.largest("DEVIATION") == pytest.approx(-0.1, abs=5e-3)
        assert bpy.ops.mesh.fair_compare() == {"FINISHED"}
        overlay.measure(bpy.context)
        assert not overlay.surfaces[0].deviation.any()
        meshes.leave()
    finally:
        settings().mode = "ZEBRA"


def test_the_legend_says_what_the_colours_stand_for() -> None:
    legend = module("overlay.legend")
    assert legend.texts("DEVIATION", 0.1, -0.25) == ("Deviation   largest -0.25", "-0.1", "0", "+0.1")
    ends = legend.colours(np.array([-1.0, 0.0, 1.0]))
    np.testing.assert_allclose(ends, [legend.LOW, legend.MIDDLE, legend.HIGH])
    shader = module("overlay.shader")._FRAGMENT
    for colour in (legend.LOW, legend.HIGH):
        assert "vec3({:.2f}, {:.2f}, {:.2f})".format(*colour) in shader


def test_follows_edits(overlay: Any) -> None:
    obj, faces = meshes.domed_grid()
    meshes.enter(obj, faces)
    settings().show = True
    before = overlay.surfaces[0].curvature.copy()
    meshes.run()
    bpy.context.view_layer.update()
    module("overlay.overlay")._measure_later()  # the timer's function; a background process runs no timers
    assert np.abs(overlay.surfaces[0].curvature - before).max() > 0.1
    assert bpy.app.timers.is_registered(module("overlay.overlay")._measure_later)


def test_measuring_is_no_change(overlay: Any) -> None:
    later = module("overlay.overlay")._measure_later
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
