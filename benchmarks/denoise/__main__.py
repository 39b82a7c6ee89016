"""Roughness taken away, beside the filters that people use: what is left of noise, and what is lost of the shape.

    pip install pyvista pymeshlab pillow
    python benchmarks/denoise [MESH ...] [--picture FILE]

A mesh is subdivided until it has 20,000 vertices, and every vertex is moved along its normal by Gaussian noise of .15
of the edges around it. Each filter but ours, which runs with its defaults, has three strengths; the one that ends
nearest to the clean mesh is shown. Needs the meshes that `benchmarks/common/real_meshes.py` names.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

import pymeshlab
import pyvista
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

import fairing
from engine import FloatArray
from polygons import read_polygons, triangles_of
from real_meshes import DATA

IntArray = np.ndarray
Filter = Callable[[FloatArray, IntArray], FloatArray]
MESHES = ("demosthenes-low-res", "cat-low-resolution", "skull_low_resolution", "ict_head")
LEAST, NOISE, SEED = 20_000, 0.15, 3


def largest_piece(name: str) -> tuple[FloatArray, IntArray]:
    """Read a mesh and keep the piece with the most vertices, subdivided."""
    points, polygons = read_polygons(DATA / f"{name}.obj")
    triangles = np.asarray(triangles_of(polygons))
    count = len(points)
    ends = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]]])
    graph = coo_array((np.ones(len(ends)), (ends[:, 0], ends[:, 1])), shape=(count, count))
    _, piece = connected_components(graph, directed=False)
    kept = triangles[piece[triangles[:, 0]] == np.bincount(piece).argmax()]
    used, local = np.unique(kept, return_inverse=True)
    mesh = poly(points[used], local.reshape(-1, 3))
    while mesh.n_points < LEAST:
        mesh = mesh.subdivide(1, "loop")
    return np.asarray(mesh.points, dtype=np.float64), mesh.faces.reshape(-1, 4)[:, 1:]


def poly(points: FloatArray, triangles: IntArray) -> pyvista.PolyData:
    """Return pyvista's mesh."""
    return pyvista.PolyData(points, np.hstack([np.full((len(triangles), 1), 3), triangles]))


def taubin(band: float) -> Filter:
    """Return pyvista's windowed sinc filter (Taubin)."""
    return lambda points, triangles: np.asarray(
        poly(points, triangles)
        .smooth_taubin(
            n_iter=20, pass_band=band, boundary_smoothing=False, feature_smoothing=False, non_manifold_smoothing=True
        )
        .points,
        dtype=np.float64,
    )


def meshlab(name: str, times: int) -> Filter:
    """Return one of MeshLab's filters, so many times."""

    def run(points: FloatArray, triangles: IntArray) -> FloatArray:
        meshes = pymeshlab.MeshSet()
        meshes.add_mesh(pymeshlab.Mesh(points, triangles))
        for _ in range(times):
            getattr(meshes, name)()
        return np.asarray(meshes.current_mesh().vertex_matrix())

    return run


FILTERS: dict[str, tuple[Filter, ...]] = {
    "Fair Denoise": (fairing.denoise,),
    "Taubin (pyvista)": tuple(taubin(band) for band in (0.2, 0.1, 0.05)),
    "HC (MeshLab)": tuple(meshlab("apply_coord_hc_laplacian_smoothing", times) for times in (1, 3, 6)),
    "two-step, bilateral (MeshLab)": tuple(meshlab("apply_coord_two_steps_smoothing", times) for times in (1, 2, 3)),
}


def turned(points: FloatArray, others: FloatArray, triangles: IntArray) -> float:
    """Return the mean angle between the triangles' normals in degrees."""
    corners = [each[triangles] for each in (points, others)]
    normals = [np.cross(c[:, 1] - c[:, 0], c[:, 2] - c[:, 0]) for c in corners]
    unit = [n / np.maximum(np.linalg.norm(n, axis=1), 1e-300)[:, None] for n in normals]
    return float(np.degrees(np.arccos(np.clip((unit[0] * unit[1]).sum(axis=1), -1, 1))).mean())


def volume(points: FloatArray, triangles: IntArray) -> float:
    """Return the volume that closed triangles enclose."""
    return float(np.linalg.det(points[triangles]).sum() / 6)


def edges_around(points: FloatArray, triangles: IntArray) -> FloatArray:
    """Return the mean length of each vertex's edges."""
    edges, _ = fairing.edges_with_uses(triangles)
    lengths = np.repeat(np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1), 2)
    ends = edges.ravel()
    return np.asarray(np.bincount(ends, lengths, len(points)) / np.bincount(ends, minlength=len(points)))


def measure(name: str) -> dict[str, FloatArray]:
    """Print a mesh's rows; return what each filter made of it."""
    clean, triangles = largest_piece(name)
    normals = fairing.vertex_normals(clean, triangles)
    around = edges_around(clean, triangles)
    amounts = NOISE * around * np.random.default_rng(SEED).normal(size=len(clean))
    rough = clean + amounts[:, None] * normals
    made = {"clean": clean, "rough": rough}

    def off(points: FloatArray) -> FloatArray:
        return np.asarray(((points - clean) * normals).sum(axis=1) / around)

    for label, strengths in FILTERS.items():
        begin = time.process_time()
        tried = [each(rough, triangles) for each in strengths]
        spent = (time.process_time() - begin) / len(tried)
        best = min(tried, key=lambda points: float(off(points).std()))
        made[label] = best
        figures = [name, f"{len(clean):,}", label, f"{off(best).std():.3f}", f"{off(best).mean():+.3f}"]
        figures += [f"{np.percentile(np.abs(off(best)), 99):.2f}", f"{turned(best, clean, triangles):.1f}°"]
        figures += [f"{100 * (volume(best, triangles) / volume(clean, triangles) - 1):+.2f} %", f"{spent:.2f} s"]
        print("| " + " | ".join(figures) + " |", flush=True)
    return made


def main() -> None:
    """Print the table; write the picture of the first mesh where it is asked for."""
    parser = argparse.ArgumentParser()
    parser.add_argument("meshes", nargs="*", default=MESHES)
    parser.add_argument("--picture", type=Path)
    arguments = parser.parse_args()
    print("| mesh | vertices | filter | off, edges: rms | mean | 99 % | normals | volume | processor |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for k, name in enumerate(arguments.meshes):
        made = measure(name)
        if k == 0 and arguments.picture:
            import sheet  # needs Pillow

            sheet.write(made, largest_piece(name)[1], arguments.picture)


if __name__ == "__main__":
    main()
