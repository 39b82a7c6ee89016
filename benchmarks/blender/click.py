"""Seconds from the click to the result in Blender's edit mode, as Markdown.

    click.py ZIP [--calls 5] [--free 800 10000 100000] [--head 33000 100000]

Half a sphere of quads, squashed and shaken; the crown and an ear of a head (ICT-FaceKit, where the folder with the
meshes is beside the project), subdivided, with noise of a tenth of an edge. Default options, each call after an undo.
"At once": the operator with
its undo step, as a script calls it. "In the background": what it does from 4000 free vertices on when it is clicked,
the thread included, to the moment when the mesh is written. The least of the calls.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from functools import partial
from itertools import product
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "blender"))
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))

import demo  # before bpy: it sets Blender's scratch folder

# isort: split
import bpy
import numpy as np

import meshes
from extension import module
from test_restoration import spoil, upper_half

FOLDER = Path(__file__).parents[3] / "shared" / "data"
MOST_OF_TWO_LEVELS = 60_000  # free vertices; of 178,000


def scene(free_vertices: int) -> bpy.types.Object:
    """A sphere of quads in edit mode, its spoilt upper half selected."""
    bpy.ops.wm.read_homefile(use_empty=True)
    obj = meshes.sphere(8 * round(np.sqrt(free_vertices / 3.0) / 2.0))
    upper = upper_half(obj)
    spoil(obj, upper)
    meshes.select(obj, upper)
    meshes.edit(obj)
    bpy.ops.ed.undo_push(message="start")
    return obj


def head(part: str, free_vertices: int) -> bpy.types.Object:
    """A noisy head in edit mode; the faces around its crown or the middle of an ear are selected."""
    bpy.ops.wm.read_homefile(use_empty=True)
    obj = load("ict_head.obj")
    modifier = obj.modifiers.new("finer", "SUBSURF")
    modifier.levels = 2 if free_vertices < MOST_OF_TWO_LEVELS else 3
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    points = meshes.positions(obj)
    middle = points[np.argmax(points[:, {"crown": 1, "ear": 0}[part]])]
    meshes.move(obj, points + noise(obj, points))
    distances = np.linalg.norm(points - middle, axis=1)
    near = distances < np.sort(distances)[free_vertices]
    corners = np.empty(len(obj.data.loops), dtype=np.int32)
    obj.data.loops.foreach_get("vertex_index", corners)
    starts = np.empty(len(obj.data.polygons), dtype=np.int32)
    obj.data.polygons.foreach_get("loop_start", starts)
    meshes.select(obj, np.logical_and.reduceat(near[corners], starts))
    meshes.edit(obj)
    bpy.ops.ed.undo_push(message="start")
    return obj


def load(file: str) -> bpy.types.Object:
    """Add a mesh from an OBJ file, vertices in the order of its v lines."""
    points, texture, faces, corners = [], [], [], []
    for line in (FOLDER / file).read_text().splitlines():
        key, *words = line.split()[:1] + line.split()[1:] if line.strip() else [""]
        if key == "v":
            points.append([float(word) for word in words[:3]])
        elif key == "vt":
            texture.append([float(word) for word in words[:2]])
        elif key == "f":
            faces.append([int(word.split("/")[0]) - 1 for word in words])
            corners += [int(word.split("/")[1]) - 1 for word in words if word.count("/") and word.split("/")[1]]
    obj = meshes.add(points, faces, Path(file).stem)
    if len(corners) == sum(map(len, faces)):
        layer = obj.data.uv_layers.new(name="UVMap")
        layer.data.foreach_set("uv", np.array(texture, dtype=np.float32)[corners].ravel())
    return obj


def noise(obj: bpy.types.Object, points: meshes.Floats) -> meshes.Floats:
    """Return shifts of a tenth of the mean edge in all directions."""
    edges = np.empty(2 * len(obj.data.edges), dtype=np.int32)
    obj.data.edges.foreach_get("vertices", edges)
    ends = points[edges.reshape(-1, 2)]
    mean = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).mean()
    return np.random.default_rng(0).normal(scale=0.1 * mean, size=points.shape)


def forget() -> None:
    """Leave nothing to answer from."""
    module("run.job").memory.clear()


def at_once() -> None:
    """What a script does."""
    assert meshes.run() == {"FINISHED"}


def in_background() -> None:
    """What the operator does after a click, without Blender's events in between."""
    job, options = module("run.job"), module("options.options").FairOptions()
    tasks = job.read(bpy.context, options)
    outcomes = module("run.runner").Run(partial(job.solve, tasks, options, ahead=True)).result()
    job.write_each(
        bpy.context, [(task.object_name, of) for task, of in zip(tasks, outcomes, strict=True)], job.write_one
    )
    bpy.ops.ed.undo_push(message="fair")


def clocked(call: Callable[[], None], calls: int) -> tuple[float, float]:
    """The least seconds by the wall and of the processor (all threads)."""
    spent = []
    for _ in range(calls):
        forget()
        begin = time.perf_counter(), time.process_time()
        call()
        spent.append((time.perf_counter() - begin[0], time.process_time() - begin[1]))
        bpy.ops.ed.undo()
    wall, processor = np.array(spent).min(axis=0).tolist()
    return wall, processor


def line(name: str, calls: int) -> str:
    """One row of the table, for what is in edit mode."""
    figures = [figure for call in (at_once, in_background) for figure in clocked(call, calls)]
    report: Any = meshes.report()
    cells = [name, str(report.free_vertices), *(f"{figure:.3g}" for figure in figures), report.verdict]
    return "| " + " | ".join(cells) + " |"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("zip", type=Path, help="the extension, as scripts/package builds it")
    parser.add_argument("--calls", type=int, default=5, help="of each kind")
    parser.add_argument("--free", type=int, nargs="+", default=[800, 10_000, 100_000], help="free vertices, about")
    parser.add_argument("--head", type=int, nargs="*", default=[33_000, 100_000], help="likewise, on the head")
    arguments = parser.parse_args()
    demo.install(arguments.zip)
    print(
        "| mesh | free vertices | at once, s | CPU s | in the background, s | CPU s | verdict |\n" + "| --- " * 7 + "|"
    )
    for count in arguments.free:
        scene(count)
        print(line("half sphere", arguments.calls), flush=True)
    for count, part in product(arguments.head if FOLDER.is_dir() else [], ("crown", "ear")):
        head(part, count)
        print(line(part, arguments.calls), flush=True)


if __name__ == "__main__":
    main()
