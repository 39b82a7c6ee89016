"""The add-on's rooms: who may import whom, and who may touch what of Blender."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from draw_house import imports

ADDON = Path(__file__).parents[2] / "addon"

# Each room with those that it may import from, besides itself and the ground.
ROOMS: dict[str, set[str]] = {
    "core": set(),
    "host": {"core"},
    "mesh": {"core"},
    "run": {"core", "host", "mesh"},
    "follow": {"core", "host", "mesh", "run"},
    "show": {"core", "host", "mesh", "run", "follow"},
}
GROUND = {
    "loading",
    "preferences",
    "tab_name",
    "translations",
}  # modules beside the rooms that import none of them but the lowest, core
BLENDER = {
    "core": set(),
    "host": {"blf", "bpy", "mathutils"},
    "mesh": {"bpy", "bmesh", "mathutils"},
    "run": {"bpy"},
    "follow": {"bpy"},
    "show": {"bpy", "gpu", "gpu_extras", "blf"},
}
OF_BLENDER = set().union(*BLENDER.values()) | {
    "mathutils",
    "bl_ui",
    "addon_utils",
    "idprop",
    "freestyle",
    "aud",
    "imbuf",
}
FILES = sorted(path for room in ROOMS for path in (ADDON / room).glob("*.py"))


def name(path: Path) -> str:
    return str(path.relative_to(ADDON))


def test_every_folder_of_modules_is_a_room_with_a_plate() -> None:
    folders = {path.parent for path in ADDON.rglob("*.py")} - {ADDON}
    assert {folder.name for folder in folders if "presets" not in folder.parts} == set(ROOMS)
    for room in ROOMS:
        plate = ast.parse((ADDON / room / "__init__.py").read_text(encoding="utf-8"))
        assert ast.get_docstring(plate), room
        assert len(plate.body) == 1, f"{room}: its door holds more than its plate"


@pytest.mark.parametrize("path", FILES, ids=name)
def test_arrows_between_rooms_point_one_way(path: Path) -> None:
    room = path.parent.name
    for level, target in imports(path):
        if level == 1:
            assert (path.parent / f"{target}.py").is_file(), target
        elif level:
            assert level == 2
            assert target in ROOMS[room] | GROUND, f"{room} imports from {target}"


@pytest.mark.parametrize("path", FILES, ids=name)
def test_rooms_touch_of_blender_what_they_may(path: Path) -> None:
    room = path.parent.name
    assert {target for level, target in imports(path) if not level} & OF_BLENDER <= BLENDER[room]


@pytest.mark.parametrize("module", sorted(GROUND))
def test_the_ground_stands_on_core_alone(module: str) -> None:
    assert not {target for level, target in imports(ADDON / f"{module}.py") if level} - GROUND - {"core"}


def test_the_room_of_arrays_stands_by_itself() -> None:
    paths = sorted((ADDON / "core").glob("*.py"))
    outside = {target for path in paths for level, target in imports(path) if not level}
    assert {"numpy", "fairing"} <= outside
    assert all(level <= 1 for path in paths for level, _ in imports(path))


def test_no_circles() -> None:
    """Modules of one room may import each other, but not in a ring."""
    arrows = {
        path: {ADDON / path.parent / f"{target}.py" for level, target in imports(path) if level == 1} for path in FILES
    }
    done: set[Path] = set()
    while len(done) < len(arrows):
        ready = {path for path in arrows if path not in done and arrows[path] <= done}
        assert ready, f"in a ring: {sorted(name(path) for path in set(arrows) - done)}"
        done |= ready
