"""Seconds from the click to the result in Blender's edit mode, as Markdown.

    click.py ZIP [--calls 5] [--free 800 10000 100000]

Half a sphere of quads, squashed and shaken, default options, each call after an undo. "At once": the operator with
its undo step, as a script calls it. "In the background": what it does from 4000 free vertices on when it is clicked,
the thread included, to the moment when the mesh is written. The least of the calls.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "blender"))
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))

import demo  # before bpy: it sets Blender's scratch folder

# isort: split
import bpy
import meshes
import numpy as np
from extension import module
from test_restoration import spoil, upper_half


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


def forget() -> None:
    """Leave nothing to answer from."""
    module("run.job").memory.clear()
    module("run.job").solvers.clear()


def at_once() -> None:
    """What a script does."""
    assert meshes.run() == {"FINISHED"}


def in_background() -> None:
    """What the operator does after a click, without Blender's events in between."""
    job, options = module("run.job"), module("core.options").FairOptions()
    tasks = job.read(bpy.context, options)
    outcomes = module("core.runner").Run(partial(job.solve, tasks, options, ahead=True)).result()
    job.write(bpy.context, tasks, outcomes)
    bpy.ops.ed.undo_push(message="fair")


def clocked(way: Callable[[], None], calls: int) -> tuple[float, float]:
    """The least seconds by the wall and of the processor (all threads)."""
    spent = []
    for _ in range(calls):
        forget()
        begin = time.perf_counter(), time.process_time()
        way()
        spent.append((time.perf_counter() - begin[0], time.process_time() - begin[1]))
        bpy.ops.ed.undo()
    wall, processor = np.array(spent).min(axis=0).tolist()
    return wall, processor


def line(free_vertices: int, calls: int) -> str:
    """One row of the table."""
    scene(free_vertices)
    figures = [figure for way in (at_once, in_background) for figure in clocked(way, calls)]
    report: Any = meshes.report()
    cells = [str(report.free_vertices), *(f"{figure:.3g}" for figure in figures), f"{report.boundary_angle:.2g}°"]
    return "| " + " | ".join(cells) + " |"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("zip", type=Path, help="the extension, as scripts/package builds it")
    parser.add_argument("--calls", type=int, default=5, help="of each way")
    parser.add_argument("--free", type=int, nargs="+", default=[800, 10_000, 100_000], help="free vertices, about")
    arguments = parser.parse_args()
    demo.install(arguments.zip)
    print(
        "| free vertices | at once, s | CPU s | in the background, s | CPU s | largest angle |\n" + "| --- " * 6 + "|"
    )
    for count in arguments.free:
        print(line(count, arguments.calls), flush=True)


if __name__ == "__main__":
    main()
