"""Runs jobs in Blender through the extension's own operators, and keeps what was there before and after."""

from __future__ import annotations

import os
import pickle
import shutil
import sys
import time
import traceback
from pathlib import Path
from typing import Any

import bpy
import numpy as np

import jobs
import meshes
from jobs import Job
from scenes import Floats, Ints, Scene

ROOT = Path(__file__).resolve().parents[2]
FIELDS = ("verdict", "reason", "remedies", "warnings", "join_worst")


def install(from_tree: bool) -> None:
    """Install the packaged zip; from_tree: with the add-on of this tree, and the module in build/native/package."""
    (path,) = (ROOT / "build" / "package").glob("*-linux_x64.zip")
    bpy.ops.extensions.package_install_files(
        repo="user_default", filepath=str(path), enable_on_install=not from_tree, overwrite=True
    )
    if from_tree:
        extensions = Path(os.environ["BLENDER_USER_RESOURCES"]) / "extensions"
        shutil.copytree(ROOT / "addon", extensions / "user_default" / "intrinsic_fairing", dirs_exist_ok=True)
        sys.path.insert(0, str(ROOT / "build" / "native" / "package"))  # before the wheel
        bpy.ops.preferences.addon_enable(module="bl_ext.user_default.intrinsic_fairing")


def _put(scene: Scene) -> Any:
    obj = meshes.add(scene.vertices, scene.faces, "Job")
    if len(scene.sharp):
        wanted = {tuple(sorted(edge)) for edge in scene.sharp.tolist()}
        for edge in obj.data.edges:
            edge.use_edge_sharp = tuple(sorted(edge.vertices)) in wanted
    for name, weights in scene.groups.items():
        group = obj.vertex_groups.new(name=name)
        for vertex in np.flatnonzero(weights > 0).tolist():
            group.add([vertex], float(weights[vertex]), "REPLACE")
    for name, points in scene.keys.items():
        key = obj.shape_key_add(name=name)
        key.data.foreach_set("co", points.astype(np.float32).ravel())
    if scene.keys:
        obj.data.shape_keys.key_blocks[-1].value = 1.0
        obj.active_shape_key_index = 0
    return obj


def _select(obj: Any, job: Job) -> None:
    meshes.select(obj, job.chosen)
    if job.rim is not None:
        picked = np.isin(np.arange(len(obj.data.vertices)), job.rim)
        obj.data.vertices.foreach_set("select", picked.tolist())
        obj.data.edges.foreach_set("select", [bool(picked[list(edge.vertices)].all()) for edge in obj.data.edges])
    bpy.context.tool_settings.mesh_select_mode = (job.rim is not None, False, job.rim is None)


def _shown(obj: Any) -> tuple[Floats, Ints, Ints]:
    """Vertices, triangles and their faces, with the shape keys that are shown."""
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    mesh.calc_loop_triangles()
    vertices = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", vertices)
    triangles = np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
    mesh.loop_triangles.foreach_get("vertices", triangles)
    faces = np.empty(len(mesh.loop_triangles), dtype=np.int32)
    mesh.loop_triangles.foreach_get("polygon_index", faces)
    return vertices.reshape(-1, 3).astype(np.float64), triangles.reshape(-1, 3), faces


def _made(name: str, folder: Path) -> Job:
    """The job, as it was made the last time."""
    path = folder / f"{name}.pickle"
    if not path.exists():
        path.write_bytes(pickle.dumps(jobs.make(name)))
    made: Job = pickle.loads(path.read_bytes())
    return made


def run(name: str, folder: Path) -> dict[str, Any]:
    """Run a job; arrays and words of what came of it. folder: for jobs that are made."""
    bpy.ops.wm.read_homefile(use_empty=True)
    job = _made(name, folder)
    obj = _put(job.scene)
    before, triangles, faces = _shown(obj)
    found: dict[str, Any] = {"before": before, "triangles": triangles, "chosen": job.chosen[faces]}
    if job.face_set is not None:
        old, deleted = job.face_set
        found["old"], found["old_chosen"] = _old(old, deleted)
    _select(obj, job)
    meshes.edit(obj)
    operator = bpy.ops.mesh.fair_fill if job.rim is not None else bpy.ops.mesh.fair_region
    begin = time.perf_counter()
    try:
        operator("EXEC_DEFAULT", True, allow_folds=True, **job.options)
    except RuntimeError as refusal:
        found["refusal"] = str(refusal)
    found["seconds"] = time.perf_counter() - begin
    report = bpy.context.window_manager.fairing_report
    for key in FIELDS:
        found[key] = getattr(report, key, "")
    meshes.leave()
    found["after"], found["after_triangles"], _ = _shown(obj)
    found["options"] = repr(job.options)
    return found


def _old(old: Scene, deleted: Any) -> tuple[Floats, Floats]:
    """The corners of the faces that were deleted, as points for the camera, and their normals."""
    corners = [old.vertices[face] for face, gone in zip(old.faces, deleted, strict=True) if gone]
    points = np.concatenate(corners)
    areas = np.array([np.cross(c[1] - c[0], c[2] - c[0]) for c in corners])
    return points, areas


def sweep(names: list[str], folder: Path, from_tree: bool) -> None:
    """Run jobs one after the other into a folder, one file each.

    Exits with a status and the names of jobs that raised, after all others have run.
    """
    install(from_tree)
    made = folder.parent / "jobs"
    for place in (folder, made):
        place.mkdir(parents=True, exist_ok=True)
    failed = []
    for name in names:
        try:
            found = run(name, made)
        except Exception:
            traceback.print_exc()
            failed.append(name)
        else:
            np.savez(folder / f"{name}.npz", **found)
    if failed:
        sys.exit(f"{len(failed)} of {len(names)} jobs raised: {', '.join(failed)}")
