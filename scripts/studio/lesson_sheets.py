"""The pictures of docs/tutorial.md: what is selected, what the steps of the page make of it, and its reflections."""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "lessons"))

import bpy
import numpy as np

import demo_pictures as pictures
import lesson_page
import lesson_play
import sheet
from lesson_scenes import begin
from rows import smooth

SIZE = 480
THICKNESS = 0.006  # of selected edges, of the camera's width
# In place of reflections, which show nothing there: what comes without the option.
OTHERWISE = {
    "pores": [lesson_page.Step("option", "Keep Detail", 0)],
    "edge": [lesson_page.Step("option", "Continue Hard Edges", False)],
}
LESSONS = {f"tutorial_{lesson.file}": lesson for lesson in lesson_page.lessons()}


def begun(lesson: lesson_page.Lesson) -> None:
    """The lesson's scene as its file has it."""
    bpy.ops.wm.read_homefile(use_empty=True)
    begin(lesson.file, camera=True)


def clay(path: Path, with_selection: bool) -> Path:
    """The active object, its selected faces or edges in the colour of selections if asked for."""
    mesh = bpy.context.object.data
    faces = np.array([polygon.select and with_selection for polygon in mesh.polygons])
    pictures.tint(mesh, faces)
    edges = [edge for edge in mesh.edges if edge.select] if with_selection and not faces.any() else []
    if edges:
        draw(edges)
    pictures.shaded(path)
    return path


def draw(edges: list[bpy.types.MeshEdge], thickness: float = THICKNESS) -> None:
    """Tubes along edges of the active mesh; thickness: of the camera's width."""
    curve = bpy.data.curves.new("Selected", "CURVE")
    curve.dimensions = "3D"
    curve.bevel_depth = thickness * bpy.context.scene.camera.data.ortho_scale
    points = bpy.context.object.data.vertices
    for edge in edges:
        line = curve.splines.new("POLY")
        line.points.add(1)
        for point, vertex in zip(line.points, edge.vertices, strict=True):
            point.co = (*points[vertex].co, 1.0)
    curve.materials.append(bpy.data.materials["Selected"])
    bpy.context.collection.objects.link(bpy.data.objects.new("Selected", curve))


def tiles(name: str, out: Path) -> list[sheet.Tile]:
    """The three pictures of a lesson."""
    lesson = LESSONS[name]
    pictures.SIZE = SIZE
    begun(lesson)
    smooth()
    first = clay(out / f"{name}_1.png", with_selection=True)
    begun(lesson)
    lesson_play.play(lesson.steps)
    smooth()
    second = clay(out / f"{name}_2.png", with_selection=False)
    last = out / f"{name}_3.png"
    words = OTHERWISE.get(lesson.file, [])
    if words:
        begun(lesson)
        lesson_play.play([step for step in lesson.steps if step.kind != "option"] + words)
        smooth()
        clay(last, with_selection=False)
    else:
        pictures.striped(last)
    otherwise = (
        f"{words[0].name}: {'off' if words[0].value is False else words[0].value}" if words else "its reflections"
    )
    given = "given" if lesson.file == "scan" else "selected"
    return [
        sheet.Tile([first], [f"{lesson.title}: {given}"]),
        sheet.Tile([second], ["after the last step"]),
        sheet.Tile([last], [otherwise]),
    ]
