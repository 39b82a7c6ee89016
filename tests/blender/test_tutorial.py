"""docs/tutorial.md: each lesson is played from its file exactly as it is written, and does what it promises."""

import sys
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import bmesh
import bpy
import numpy as np
import pytest

import meshes
from extension import module

sys.path.append(str(Path(__file__).parents[2] / "scripts"))
sys.path.append(str(Path(__file__).parents[2] / "scripts" / "studio"))
sys.path.append(str(Path(__file__).parents[2] / "scripts" / "lessons"))

import lesson_page
import lesson_play
import lesson_scenes
from lesson_checks import CHECKS, borders

LESSONS = {lesson.file: lesson for lesson in lesson_page.lessons()}


@pytest.fixture(autouse=True)
def unhurried(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Live has as long as it takes: no surface depends on that."""
    monkeypatch.setattr(module("live.live"), "PATIENCE", 60.0)
    yield
    bpy.context.window_manager.fairing_live.on = False


def opened(name: str, folder: Path) -> meshes.Floats:
    """Make the lesson's file, open it, and return the positions in it."""
    bpy.ops.wm.read_homefile(use_empty=True)
    lesson_scenes.begin(name)
    path = folder / f"{name}.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.open_mainfile(filepath=str(path))
    return meshes.positions(bpy.context.object)


def test_the_page_has_the_eight_lessons_that_have_files() -> None:
    assert list(LESSONS) == list(lesson_scenes.SCENES) == list(CHECKS)
    assert [len(lesson_play.actions(lesson.steps)) for lesson in LESSONS.values()] == [2, 4, 3, 2, 2, 2, 2, 4]


@pytest.mark.parametrize(
    "words",
    [
        "1. *Tab*, then *Face ▸ Fair Everything*.",
        "1. *Face ▸ Fair Fill*, then *Fold*: on.",
        "1. *Keep Detail*: `1`.",
        "1. *Edge ▸ Fair Fillet*, *Continuity*: *Smooth*.",
    ],
)
def test_words_that_name_nothing_are_refused(words: str) -> None:
    with pytest.raises(ValueError, match=r"no key|no option|an option of"):
        lesson_play.actions(lesson_page.steps(words))


class Listed:
    """A menu that remembers the operators drawn into it."""

    def __init__(self) -> None:
        self.layout, self.operators = self, list[str]()
        self.entries = dict[str, tuple[str, SimpleNamespace]]()  # by their own text

    def separator(self) -> None:
        """Draw nothing."""

    def operator(self, name: str, text: str = "") -> SimpleNamespace:
        """Remember it."""
        self.operators.append(name)
        properties = SimpleNamespace()
        self.entries[text] = (name, properties)
        return properties


@pytest.mark.parametrize(
    "path", sorted({step.name for lesson in LESSONS.values() for step in lesson.steps if " ▸ " in step.name})
)
def test_menus_have_what_the_page_names(path: str) -> None:
    menu, label = path.split(" ▸ ")
    blenders = {"Face": "VIEW3D_MT_edit_mesh_faces", "Edge": "VIEW3D_MT_edit_mesh_edges"}[menu]
    listed = Listed()
    dict(module("show.menus").ENTRIES)[blenders](listed, bpy.context)
    if label in lesson_play.ENTRIES:
        operator, given = lesson_play.ENTRIES[label]
        assert listed.entries[label] == (f"mesh.{operator}", SimpleNamespace(**given))
    else:
        assert f"mesh.{lesson_play.labels()[label]}" in listed.operators


@pytest.mark.parametrize("name", LESSONS)
def test_lesson(name: str, tmp_path: Path) -> None:
    before = opened(name, tmp_path)
    assert name != "scan" or borders() == lesson_scenes.HOLES
    lesson_play.play(LESSONS[name].steps)
    meshes.leave()
    CHECKS[name](before, meshes.positions(bpy.context.object))
    if name not in ("seam", "bottle"):  # of a fillet and of Live there is no report
        assert meshes.report().verdict == "GOOD"


def test_the_shoulder_is_fair(tmp_path: Path) -> None:
    """Fair Region would change nothing."""
    opened("bottle", tmp_path)
    lesson_play.play(LESSONS["bottle"].steps)
    followed = now()
    bpy.context.window_manager.fairing_live.on = False
    bpy.ops.mesh.fair_select(what="LIVE")
    bpy.ops.mesh.fair_region("EXEC_DEFAULT")
    assert np.abs(now() - followed).max() < 1e-4


def now() -> meshes.Floats:
    """The positions of the mesh in edit mode."""
    bm = bmesh.from_edit_mesh(bpy.context.object.data)
    return np.array([vertex.co[:] for vertex in bm.verts])
