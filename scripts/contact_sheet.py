"""Fairs every patch of the real meshes as an artist would; prints figures, joins pictures."""

import sys
from pathlib import Path
from typing import Any

import demo  # before bpy: it sets Blender's scratch folder

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "blender"))
sys.path.insert(0, str(Path(__file__).parents[1] / "benchmarks" / "blender"))

import bpy
import numpy as np

import demo_pictures as pictures
import meshes
import real

COLUMNS = 9  # patches in a row
pictures.SIZE = 150  # pixels of one picture

CHECKS = (
    "Equation solved",
    "Angle to the slope asked for",
    "Curvature inside",
    "Folded faces",
    "Needles",
    "Faces that cross",
    "Texture distortion",
)


def look_at(obj: bpy.types.Object, faces: meshes.Mask) -> None:
    """Put the camera over the patch, a little from the side."""
    polygons = [obj.data.polygons[face] for face in np.flatnonzero(faces)]
    points = meshes.positions(obj)[sorted({v for p in polygons for v in p.vertices})]
    centre = points.mean(axis=0)
    size = float(np.linalg.norm(points - centre, axis=1).max())
    rim = sum((p.normal * p.area for p in polygons), start=polygons[0].normal * 0.0)
    away = np.array(rim.normalized()) + 0.6 * np.array([rim.y, -rim.x, rim.z]) / max(rim.length, 1e-9)
    pictures.add_camera(centre, away, 2.6 * size)
    camera = bpy.context.scene.camera
    camera.data.clip_end = 1e4
    camera.location = centre + 20.0 * size * away / np.linalg.norm(away)


def run(patch: dict[str, Any], out: Path) -> tuple[list[Path], dict[str, str]]:
    """Picture, fair, picture; return both pictures and the report's lines."""
    obj = real.load(patch["mesh"])
    faces = real.faces_of(obj, patch)
    obj.data.shade_smooth()
    pictures.tint(obj.data, faces)
    look_at(obj, faces)
    stem = real.name(patch).replace(" ", "_")
    paths = [out / f"{stem}_before.png", out / f"{stem}_after.png"]
    pictures.shaded(paths[0])
    meshes.fair(obj, faces, allow_folds=True)
    pictures.shaded(paths[1])
    report = meshes.report()
    figures = {name: report.checks[name].value for name in CHECKS}
    return paths, {
        "verdict": report.verdict,
        "vertices": str(report.free_vertices),
        "seconds": f"{report.seconds:.2f}",
        **figures,
    }


def join(pairs: list[list[Path]], target: Path) -> None:
    """Rows of patches, each before above after."""
    rows = []
    for start in range(0, len(pairs), COLUMNS):
        part = pairs[start : start + COLUMNS]
        rows += [[pair[0] for pair in part], [pair[1] for pair in part]]
    pictures.contact_sheet(rows, target)


def main() -> int:
    """Usage: contact_sheet.py ZIP OUTPUT_FOLDER. Returns 1 where a patch did not converge."""
    package, out = Path(sys.argv[1]), Path(sys.argv[2])
    pairs, failed = [], 0
    for patch in real.patches():
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        demo.install(package)
        paths, figures = run(patch, out)
        pairs.append(paths)
        failed += figures["Equation solved"] not in ("yes", "yes, on a proxy")
        print(f"| {real.name(patch)} | " + " | ".join(figures.values()) + " |", flush=True)
    join(pairs, out / "patches.png")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
