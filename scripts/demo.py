"""Fairs an ear off Suzanne and restores half a sphere with the packaged extension, headless."""

import os
import sys
import tempfile
from pathlib import Path
from typing import Any

if "BLENDER_USER_RESOURCES" not in os.environ:  # before bpy looks for it
    os.environ["BLENDER_USER_RESOURCES"] = tempfile.mkdtemp(prefix="fairing-demo-")

import bpy
import numpy as np

import demo_pictures as pictures
import demo_scenes as scenes


def install(package: Path) -> None:
    """Install and enable the extension's zip in Blender's scratch folder."""
    bpy.ops.extensions.package_install_files(
        repo="user_default", filepath=str(package), enable_on_install=True, overwrite=True
    )


def fair(obj: bpy.types.Object, faces: Any) -> dict[str, Any]:
    """Run the operator on the faces and return what its report says."""
    scenes.select(obj, faces)
    bpy.ops.mesh.fair_region("EXEC_DEFAULT")
    bpy.ops.object.mode_set(mode="OBJECT")
    report = bpy.context.window_manager.fairing_report
    names = ("free_vertices", "seconds", "boundary_angle", "converged")
    return {"verdict": report.verdict.capitalize(), **{name: getattr(report, name) for name in names}}


def take_pictures(out: Path, stem: str) -> list[Path]:
    """Save the file and render it twice; returns the pictures."""
    bpy.ops.wm.save_as_mainfile(filepath=str(out / f"{stem}.blend"), copy=True)
    paths = [out / f"{stem}_shaded.png", out / f"{stem}_stripes.png"]
    pictures.shaded(paths[0])
    pictures.striped(paths[1])
    return paths


def before_and_after(out: Path, name: str, obj: bpy.types.Object, faces: Any) -> dict[str, Any]:
    """Picture, fair, picture; joins the four pictures into `name`.png."""
    pictures.tint(obj.data, faces)
    before = take_pictures(out, f"{name}_before")
    figures = fair(obj, faces)
    after = take_pictures(out, f"{name}_after")
    pictures.contact_sheet(zip(before, after, strict=True), out / f"{name}.png")
    return figures


def ear(out: Path) -> dict[str, Any]:
    """Remove the ear by fairing."""
    monkey = scenes.suzanne()
    pictures.add_camera((0.2, 0.0, 0.0), (1.0, -0.45, 0.2), 2.8)
    return before_and_after(out, "suzanne_ear", monkey, scenes.ear_faces(monkey.data))


def hemisphere(out: Path) -> dict[str, Any]:
    """Restore the spoilt half of a sphere and measure how far it is off."""
    sphere, upper = scenes.spoilt_sphere()
    pictures.add_camera((0.0, 0.0, 0.0), (1.0, -1.0, 0.7), 2.4)
    figures = before_and_after(out, "hemisphere", sphere, upper)
    radii = np.linalg.norm(scenes.positions(sphere.data), axis=1)
    return {**figures, "deviation": float(np.abs(radii - 1.0).max())}


COLUMNS = (
    ("free vertices", "free_vertices", "{:d}"),
    ("seconds", "seconds", "{:.3f}"),
    ("verdict", "verdict", "{}"),
    ("largest boundary angle", "boundary_angle", "{:.2f}°"),
    ("off the exact sphere", "deviation", "{:.1e} R"),
)


def print_table(rows: dict[str, dict[str, Any]]) -> None:
    """Print one line per model."""
    print("\n" + " " * 14 + "".join(f"{title:>{len(title) + 3}}" for title, _, _ in COLUMNS))
    for name, row in rows.items():
        cells = [form.format(row[key]) if key in row else "-" for _, key, form in COLUMNS]
        widths = [len(title) + 3 for title, _, _ in COLUMNS]
        cells = [f"{cell:>{width}}" for cell, width in zip(cells, widths, strict=True)]
        print(f"{name:14}" + "".join(cells))


def main() -> int:
    """Usage: demo.py ZIP OUTPUT_FOLDER. Returns 1 where a model did not converge."""
    package, out = Path(sys.argv[1]), Path(sys.argv[2])
    out.mkdir(parents=True, exist_ok=True)
    rows = {}
    for name, run in (("Suzanne's ear", ear), ("hemisphere", hemisphere)):
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        install(package)
        print(f"-- {name}", flush=True)
        rows[name] = run(out)
    print_table(rows)
    print(f"\nPictures (before, after; shaded, reflection stripes) and .blend files: {out}")
    return 0 if all(row["converged"] for row in rows.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
