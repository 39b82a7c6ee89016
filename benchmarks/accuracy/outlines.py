"""Outlines in noisy surroundings: normals fitted to them, and the rim of the surface, given and mended.

    python benchmarks/accuracy/outlines.py                  # the surfaces and seeds of the page
    python benchmarks/accuracy/outlines.py --tune           # those that constants were chosen on

Exact surfaces with edges of about length 1 and radii of curvature of some ten, cut along a zigzag; every vertex is
shifted by a random vector whose root mean square length is the noise. Normals: angles to the exact ones. Rim: angles of
the patch's triangles along the outline to the exact surface; dihedral: angles of the outline's edges.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import Delaunay

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))

import fairing
from meshing import IntArray, edge_pairs, face_normals

FloatArray = NDArray[np.float64]
Chart = Callable[[FloatArray, FloatArray], FloatArray]
EXTENT, PATCH, JITTER, LONGEST = 11.0, 5.2, 0.2, 1.9  # edges
NOISES = (0.0, 0.02, 0.1, 0.25)


def sphere(s: FloatArray, t: FloatArray) -> FloatArray:
    polar, around = 2 * np.arcsin(np.hypot(s, t) / 20), np.arctan2(t, s)
    return 10 * np.stack([np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar)], -1)


def cylinder(s: FloatArray, t: FloatArray) -> FloatArray:
    return np.stack([8 * np.sin(s / 8), t, 8 * np.cos(s / 8)], -1)


def torus(centre: float) -> Chart:
    """Around the outer (0) or inner (π) equator of a torus with radii 20 and 8."""

    def chart(s: FloatArray, t: FloatArray) -> FloatArray:
        across, along = centre + t / 8, s / (20 + 8 * np.cos(centre))
        away = 20 + 8 * np.cos(across)
        return np.stack([away * np.cos(along), away * np.sin(along), 8 * np.sin(across)], -1)

    return chart


def graph(height: Chart) -> Chart:
    return lambda s, t: np.stack([s, t, height(s, t)], -1)


SURFACES: dict[str, Chart] = {
    "sphere": sphere,
    "cylinder": cylinder,
    "saddle": graph(lambda s, t: (s**2 - t**2) / 24),
    "wave": graph(lambda s, t: 1.5 * np.sin(s / 5) * np.cos(t / 7)),
    "torus": torus(0.0),
    "inner torus": torus(np.pi),
    "cubic": graph(lambda s, t: (s**3 - 3 * s * t**2) / 600 + s * t / 30),
    "ellipsoid": graph(lambda s, t: 10 * np.sqrt(1 - (s / 18) ** 2 - (t / 24) ** 2)),
}
TUNING = (("sphere", "cylinder", "saddle", "wave"), range(3))
REPORTED = (("sphere", "cylinder", "torus", "inner torus", "cubic", "ellipsoid"), range(10, 14))


@dataclass(frozen=True)
class Case:
    """exact, noisy, normals (n, 3); inside, outside (m, 3); outline (k,); places (n, 2) in the chart."""

    exact: FloatArray
    noisy: FloatArray
    normals: FloatArray
    inside: IntArray
    outside: IntArray
    outline: IntArray
    places: FloatArray


def unit(vectors: FloatArray) -> FloatArray:
    return np.asarray(vectors / np.linalg.norm(vectors, axis=1)[:, None])


def exact_normals(chart: Chart, s: FloatArray, t: FloatArray) -> FloatArray:
    """By central differences of 1e-5: to about 1e-10."""
    step = 1e-5
    along = chart(s + step, t) - chart(s - step, t)
    across = chart(s, t + step) - chart(s, t - step)
    return unit(np.cross(along, across))


def make_case(name: str, seed: int, noise: float) -> Case:
    rng = np.random.default_rng([seed, 7])
    rows, columns = np.mgrid[-13:14, -12:13]
    lattice = np.c_[(columns + 0.5 * (rows % 2)).ravel(), (rows * np.sqrt(0.75)).ravel()]
    chart = lattice + rng.uniform(-JITTER, JITTER, lattice.shape)
    triangles = Delaunay(chart).simplices
    sides = np.linalg.norm(chart[triangles] - np.roll(chart[triangles], 1, axis=1), axis=2)
    triangles = triangles[sides.max(axis=1) < LONGEST]
    exact = SURFACES[name](*chart.T)
    normals = exact_normals(SURFACES[name], *chart.T)
    turned = (face_normals(exact, triangles) * normals[triangles].sum(axis=1)).sum(axis=1) < 0
    triangles[turned] = triangles[turned][:, ::-1]
    within = np.linalg.norm(chart[triangles].mean(axis=1), axis=1) < PATCH
    outline = np.intersect1d(triangles[within], triangles[~within])
    noisy = exact + noise / np.sqrt(3) * rng.normal(size=exact.shape)
    return Case(exact, noisy, normals, triangles[within], triangles[~within], outline, chart)


def degrees(first: FloatArray, second: FloatArray) -> FloatArray:
    sine = np.linalg.norm(np.cross(first, second), axis=1)
    return np.asarray(np.degrees(np.arctan2(sine, (first * second).sum(axis=1))))


def rim_angles(case: Case, vertices: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Errors of the patch's triangles along the outline; dihedral angles of the outline's edges."""
    rim = case.inside[np.isin(case.inside, case.outline).sum(axis=1) >= 2]
    errors = degrees(face_normals(vertices, rim), case.normals[rim].sum(axis=1))
    both = np.concatenate([case.inside, case.outside])
    _, faces, _ = edge_pairs(both)
    faces = faces[(faces < len(case.inside)).sum(axis=1) == 1]
    normals = face_normals(vertices, both)
    return errors, degrees(normals[faces[:, 0]], normals[faces[:, 1]])


def measured(case: Case) -> dict[str, FloatArray]:
    """All angles of one case, degrees; and the ratios of the normals' errors to their standard errors."""
    found = fairing.surrounding_normals(case.noisy, case.outside, case.outline)
    options = {"fixed": case.outline, "fixed_normals": found.normals, "outside": case.outside, "threads": 1}
    angles = degrees(found.normals, case.normals[case.outline])
    result = {"normals": angles, "ratio": angles / np.degrees(found.errors)}
    for outline in ("given", "mended"):
        solved = fairing.fair(case.noisy, case.inside, outline=outline, **options)
        result[f"rim {outline}"], result[f"dihedral {outline}"] = rim_angles(case, solved.vertices)
    return result


def main() -> None:
    """Print a row for each noise: medians and 90th percentiles."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0] if __doc__ else "")
    parser.add_argument("--tune", action="store_true", help="the surfaces and seeds that constants were chosen on")
    names, seeds = TUNING if parser.parse_args().tune else REPORTED
    for noise in NOISES:
        cases = [measured(make_case(name, seed, noise)) for name in names for seed in seeds]
        cells = [f"{noise:.2f}"]
        for key in cases[0]:
            values = np.concatenate([case[key] for case in cases])
            cells.append(f"{key} {np.median(values):.2g} / {np.percentile(values, 90):.2g} (mean {values.mean():.2g})")
        print(f"| {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
