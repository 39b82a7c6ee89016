"""Panels, presets, languages, preferences: what is offered, and what is left behind."""

from collections.abc import Callable
from dataclasses import asdict
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest

import meshes
from extension import ID, inspect, module
from test_refusals import add_nan, add_tent


class Layout:
    """Records what a panel draws; stands in for Blender's UILayout and its children."""

    def __init__(self, reported: list[str] | None = None) -> None:
        self.reported = [] if reported is None else reported

    def label(self, text: str = "", **_rest: Any) -> None:
        self.reported.append(text)

    def operator(self, name: str, text: str = "", **_rest: Any) -> Any:
        self.reported.append(text or name)
        return SimpleNamespace()

    def prop(self, _owner: Any, name: str, **_rest: Any) -> None:
        self.reported.append(name)

    def prop_search(self, _owner: Any, name: str, *_rest: Any) -> None:
        self.reported.append(name)

    def separator(self, **_rest: Any) -> None:
        pass

    def _child(self, **_rest: Any) -> "Layout":
        return Layout(self.reported)

    def menu(self, name: str, **_rest: Any) -> None:
        self.reported.append(name)

    column = row = split = box = _child


def drawn(panel: str) -> str:
    class Shown:
        layout = Layout()

    shown = Shown()
    getattr(module("show.ui"), panel).draw(shown, bpy.context)
    return "\n".join(shown.layout.reported)


def test_inspection_counts() -> None:
    obj, faces = meshes.domed_grid()
    found = inspect(obj, faces)
    assert (found.faces, found.free_vertices) == (faces.sum(), meshes.free_vertices(obj, faces).sum())
    assert (found.loops, found.islands, found.refusal) == (1, 1, "")
    halves = faces & meshes.faces_where(obj, lambda c: abs(c.x) > 0.2)
    found = inspect(obj, halves)
    assert (found.loops, found.islands) == (2, 2)


def lock_shape_key(obj: bpy.types.Object) -> None:
    obj.shape_key_add(name="Basis").lock_shape = True


# By name: pytest keeps parameters longer than the interpreter lives. Where one is a function of another module, that
# module holds bpy, and bpy 4.2 crashes at exit when it is not let go.
SPOILERS: dict[str, Callable[[bpy.types.Object], None]] = {
    "nan": add_nan,
    "tent": add_tent,
    "group": lambda obj: None,
    "locked": lock_shape_key,
}


@pytest.mark.parametrize(
    ("spoiler", "options", "says"),
    [
        ("nan", {}, "invalid"),
        ("tent", {}, "More than two faces"),
        ("group", {"pin_group": "Missing"}, "Missing"),
        ("locked", {}, "Unlock"),
    ],
)
def test_inspection_says_what_would_be_refused(spoiler: str, options: Any, says: str) -> None:
    obj, _ = meshes.domed_grid()
    SPOILERS[spoiler](obj)
    faces = meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.7 or not np.isfinite(c.x))
    before = meshes.in_edit_mode_once(obj, faces)
    assert says in inspect(obj, faces, **options).refusal
    assert meshes.contents(obj) == before
    with pytest.raises(RuntimeError, match=says):
        meshes.fair(obj, faces, **options)


def test_drawing_the_panel_never_looks(monkeypatch: pytest.MonkeyPatch) -> None:
    watch = module("selection.watch")
    obj, faces = meshes.domed_grid()
    meshes.select(obj, faces)
    meshes.edit(obj)
    watch.watch.look(bpy.context)

    def forbidden(*_: Any) -> None:
        raise AssertionError("the panel looked at the mesh while it was drawn")

    monkeypatch.setattr(watch, "inspect", forbidden)
    text = drawn("VIEW3D_PT_fairing_selection")
    assert text == "Ready"
    assert str(int(meshes.free_vertices(obj, faces).sum())) in drawn("VIEW3D_PT_fairing_counts").splitlines()
    watch.watch.stale = True
    assert drawn("VIEW3D_PT_fairing_selection") == text
    if bpy.app.timers.is_registered(watch._look_later):
        bpy.app.timers.unregister(watch._look_later)


def test_selecting_makes_the_last_look_stale() -> None:
    watch = module("selection.watch").watch
    obj, faces = meshes.domed_grid()
    meshes.select(obj, faces)
    meshes.edit(obj)
    watch.look(bpy.context)
    assert not watch.stale
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.context.view_layer.update()
    assert watch.stale
    watch.look(bpy.context)
    assert watch.found[0].faces == 0
    bpy.context.view_layer.update()
    assert not watch.stale  # looking is no change


def test_large_meshes_are_looked_at_on_demand(monkeypatch: pytest.MonkeyPatch) -> None:
    watch = module("selection.watch")
    obj, faces = meshes.domed_grid()
    meshes.select(obj, faces)
    meshes.edit(obj)
    monkeypatch.setattr(watch, "LARGE", 10)
    watch.watch.forget()
    assert "mesh.fair_inspect" in drawn("VIEW3D_PT_fairing_selection")
    assert not bpy.app.timers.is_registered(watch._look_later)
    assert bpy.ops.mesh.fair_inspect() == {"FINISHED"}
    assert "Free Vertices" in drawn("VIEW3D_PT_fairing_counts")


def options_of(operator: str) -> Any:
    """Return the class of an operator's options."""
    others = module("options.other_options")
    return {
        "fair": module("options.options").FairOptions, "fill": others.FillOptions, "fillet": others.FilletOptions,
    }[operator]  # fmt: skip


def in_redo_panel(opened: bool, operator: str = "fair", **chosen: Any) -> list[str]:
    """Return the options that the redo panel shows, in its order."""
    obj, of = meshes.grid(), options_of(operator)
    panel = module("options.redo_panel")
    layout, manager = Layout(), bpy.context.window_manager
    setattr(manager, panel.ADVANCED, opened)
    panel.draw_options(layout, SimpleNamespace(chosen=of, **{**asdict(of()), **chosen}), obj, manager)
    return [text for text in layout.reported if module("options.table").named(of, text)]


STATES: list[dict[str, Any]] = [
    {name: value}
    for name, values in {
        "shape": ["AUTOMATIC", "HARMONIC", "MINIMAL_ENERGY", "LEAST_VARIATION"],
        "continuity": ["G0", "G1", "G2"],
        "remesh": [True],
        "detail": [0.5],
        "falloff": [0.2],
        "smooth_boundary": [True],
    }.items()
    for value in values
]


def test_redo_panel_has_every_option() -> None:
    everything = in_redo_panel(True, detail=0.5, pin_group="Pin", pin_edges="SEAM", continuity="G2")
    found = [*everything, *in_redo_panel(True, remesh=True), *in_redo_panel(True)]
    assert len(everything) == len(set(everything))
    assert set(found) == {*asdict(options_of("fair")())}


@pytest.mark.parametrize("first", STATES)
@pytest.mark.parametrize("second", STATES)
def test_what_is_hidden_has_no_effect(first: Any, second: Any) -> None:
    """Nothing that the panel hides changes what the engine is asked for, and it is reported as idle."""
    of = options_of("fair")
    chosen = {**asdict(of()), **first, **second}
    plain = of.named(chosen)
    for option in module("options.table").table(of):
        if option.counts(plain) or option.is_set(SimpleNamespace(**chosen)):
            continue
        other = {str: "X", float: 0.3, bool: not option.default, int: 3}[type(option.default)]
        if option.items:
            other = option.items[-1][0]
        changed = of.named({**chosen, option.name: other})
        assert changed == plain and option.name in changed.idle, option.name


@pytest.mark.parametrize("chosen", [{"remesh": True, "detail": 0.5}, {"continuity": "G2", "falloff": 0.2}])
def test_what_is_set_in_vain_stays_in_sight(chosen: Any) -> None:
    assert {*chosen} <= {*in_redo_panel(False, **chosen)}


@pytest.mark.parametrize("operator", ["fill", "fillet"])
def test_other_redo_panels_are_of_the_same_kind(operator: str) -> None:
    shown = in_redo_panel(False, operator)
    everything = in_redo_panel(True, operator)
    assert 4 <= len(shown) <= 9
    assert {*everything} == {*asdict(options_of(operator)())}


def footprint() -> dict[str, Any]:
    """Everything that an add-on may leave behind."""
    handlers = bpy.app.handlers
    lists = [name for name in dir(handlers) if isinstance(getattr(handlers, name), list)]
    menus = (bpy.types.VIEW3D_MT_edit_mesh_faces, bpy.types.VIEW3D_MT_edit_mesh_context_menu)
    return {
        "types": sorted(name for name in dir(bpy.types) if "fair" in name.lower()),
        "window manager": sorted(name for name in dir(bpy.types.WindowManager) if "fair" in name),
        "scene": sorted(name for name in dir(bpy.types.Scene) if "fair" in name),
        "handlers": {name: len(getattr(handlers, name)) for name in lists},
        "menus": [len(menu.draw._draw_funcs) for menu in menus],
        "operators": sorted(name for name in dir(bpy.ops.mesh) if name.startswith("fair")),
    }


def test_enabled_and_disabled_twenty_times() -> None:
    import addon_utils

    enabled = footprint()
    for _ in range(20):
        bpy.context.window_manager.fairing_overlay.show = True
        bpy.context.window_manager.fairing_live.on = True
        addon_utils.disable(ID)
        without = footprint()
        assert without["types"] == without["window manager"] == without["scene"] == without["operators"] == []
        assert all(without["handlers"][name] <= enabled["handlers"][name] for name in enabled["handlers"])
        assert sum(without["handlers"].values()) == sum(enabled["handlers"].values()) - 7
        addon_utils.enable(ID)
    assert footprint() == enabled


def test_the_last_run_goes_with_its_object() -> None:
    obj, faces = meshes.domed_grid()
    obj.name = "Hill, with a comma"
    panel = module("show.ui").VIEW3D_PT_fairing_report
    assert meshes.fair(obj, faces) == {"FINISHED"}
    assert panel.poll(bpy.context)
    bpy.data.objects.remove(obj)
    assert not panel.poll(bpy.context)
