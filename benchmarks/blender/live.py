"""Milliseconds from an edit beside a live region to the mesh written, part by part, as Markdown.

    live.py ZIP [--steps 30] [--free 2000 10000 50000]

The upper half of a sphere of quads follows a drag of its lower half, by a thousandth of the radius a step: what a
window does at each mouse move, without its drawing. Processor time of the main thread's calls, all threads; the median
of the steps.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import defaultdict
from collections.abc import Callable
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "blender"))
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))

import demo  # before bpy: it sets Blender's scratch folder

# isort: split
import bmesh
import bpy
import numpy as np

import meshes
from extension import module
from test_restoration import upper_half

PARTS = ("reading", "boundary", "solving", "writing", "Blender")


class Clock:
    """Seconds of each part, summed up over the calls of one step."""

    def __init__(self) -> None:
        self.spent: defaultdict[str, float] = defaultdict(float)

    def around(self, owner: Any, name: str, part: str) -> None:
        """Have the calls of one function of a module or a class count among a part."""
        real: Callable[..., Any] = getattr(owner, name)

        def clocked(*arguments: Any, **options: Any) -> Any:
            begin = time.process_time()
            try:
                return real(*arguments, **options)
            finally:
                self.spent[part] += time.process_time() - begin

        setattr(owner, name, clocked)


def watched() -> Clock:
    """A clock on the parts of a step."""
    clock = Clock()
    mesh, region = module("mesh.live_mesh"), module("live.region")
    for name in ("positions", "corners", "counts", "has_region"):
        clock.around(mesh, name, "reading")
    clock.around(region.LiveRegion, "_problem", "boundary")
    clock.around(module("fair.engine").RepeatedSolve, "__call__", "solving")
    clock.around(module("mesh.mesh_io"), "write_edit_mesh", "writing")
    return clock


def scene(free_vertices: int) -> tuple[bpy.types.Object, Any]:
    """A sphere of quads in edit mode with a live upper half, and the vertices that are dragged."""
    bpy.ops.wm.read_homefile(use_empty=True)
    obj = meshes.sphere(8 * round(np.sqrt(free_vertices / 3.0) / 2.0))
    upper = upper_half(obj)
    meshes.select(obj, upper)
    dragged = np.flatnonzero(meshes.positions(obj)[:, 2] < 1e-6)  # all of it: a single row would become a hard edge
    meshes.edit(obj)
    assert bpy.ops.mesh.fair_live_region() == {"FINISHED"}
    bpy.context.view_layer.update()
    return obj, dragged


def drag(obj: bpy.types.Object, vertices: Any, step: float) -> None:
    """Move vertices in edit mode as a tool does."""
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    for vertex in vertices.tolist():
        bm.verts[vertex].co.x *= 1.0 + step
    bmesh.update_edit_mesh(obj.data, loop_triangles=True, destructive=False)


def line(free_vertices: int, steps: int, clock: Clock) -> str:
    """One row of the table."""
    obj, vertices = scene(free_vertices)
    live = module("live.live").live
    region = next(iter(live.sessions.values())).region
    rows = []
    for _ in range(steps):
        drag(obj, vertices, 1e-3)
        clock.spent.clear()
        written, begin = live.updates, time.process_time()
        bpy.context.view_layer.update()
        whole = time.process_time() - begin
        assert live.updates == written + 1
        parts = [clock.spent[part] for part in PARTS[:-1]]
        rows.append([*parts, whole - sum(parts), whole])
    cells = [str(len(region.free)), *(f"{1e3 * value:.1f}" for value in np.median(rows, axis=0))]
    bpy.context.window_manager.fairing_live.on = False
    return "| " + " | ".join(cells) + " |"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("zip", type=Path, help="the extension, as scripts/package builds it")
    parser.add_argument("--steps", type=int, default=30)
    parser.add_argument("--free", type=int, nargs="+", default=[2000, 10_000, 50_000], help="free vertices, about")
    arguments = parser.parse_args()
    demo.install(arguments.zip)
    clock = watched()
    print("| free vertices | " + " | ".join(PARTS) + " | in all, ms |\n" + "| --: " * (len(PARTS) + 2) + "|")
    for count in arguments.free:
        print(line(count, arguments.steps, clock), flush=True)


if __name__ == "__main__":
    main()
