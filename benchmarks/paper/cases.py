"""The four cases of Table 1 as meshes to be faired."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

import fairing
import heads
import shapes
import three_cylinders
from polygon_mesh import FloatArray, IntArray
from tetrathing import tetrathing_mesh
from thinning import Thinner, flip_to_delaunay, thin, thin_curve


@dataclass(frozen=True)
class Case:
    """A mesh with G1 data.

    vertices (n, 3), the interior only of the original mesh M0 where there is one; triangles (m, 3); fixed (k,) with
    normals (k, 3); reference (n, 3): M0; region: the head around it. base, seconds: of the paper's Table 1 (Java,
    500 MHz).
    """

    name: str
    vertices: FloatArray
    triangles: IntArray
    fixed: IntArray
    normals: FloatArray
    reference: FloatArray
    inner_fairness: str = "uniform"
    base: int = 0
    seconds: float = 0.0
    region: heads.Region | None = field(default=None, repr=False)

    @property
    def diameter(self) -> float:
        """D: twice the largest distance of the fixed vertices from their centroid."""
        rim = self.vertices[self.fixed]
        return float(2 * np.linalg.norm(rim - rim.mean(axis=0), axis=1).max())

    @property
    def free(self) -> IntArray:
        """The other vertices."""
        return np.setdiff1d(np.arange(len(self.vertices)), self.fixed)

    def fair(self, **options: Any) -> fairing.FairResult:
        """Faired with the case's inner fairness unless the options say otherwise."""
        settings = {"inner_fairness": self.inner_fairness, "reference": self.reference, **options}
        return fairing.fair(
            self.vertices, self.triangles, fixed=self.fixed, fixed_normals=self.normals, **settings
        )  # fmt: skip

    def surface_normals(self, points: FloatArray) -> FloatArray:
        """Fitted at the free vertices of a result, prescribed at the fixed ones (side by side on curves inside)."""
        normals = fairing.vertex_normals(points, self.triangles).copy()
        normals[self.fixed] = self.normals
        return normals


def blend_case() -> Case:
    """Figs. 1, 2: three cylinders at 120°, a regular rectangular patch in an irregular mesh; M0 has even arms."""
    made = three_cylinders.with_rectangle()
    return Case(
        "cylinder blend", made.vertices, made.triangles, made.fixed, made.fixed_normals,
        three_cylinders.rounded(made), base=140, seconds=1.9,
    )  # fmt: skip


def reduced(case: Case, count: int) -> Case:
    """The case on a mesh of `count` vertices, by half-edge collapses of M0; every other boundary vertex stays."""
    loops = [np.asarray(loop, dtype=np.int64) for loop in fairing.boundary_loops(case.triangles)]
    mesh = Thinner(case.reference, case.triangles, loops)
    size = np.ones(len(case.vertices))
    free = case.free.tolist()
    thin(mesh, free, size, round(0.7 * (len(case.vertices) - count)))
    thin_curve(mesh, {int(v) for loop in loops for v in loop[::2]})
    left = sum(1 for around in mesh.around if around)
    thin(mesh, free, size, left - count)
    flip_to_delaunay(mesh, set(range(len(case.vertices))))
    triangles = np.array([face for face in mesh.faces if face])
    used, local = np.unique(triangles, return_inverse=True)
    stays = np.isin(case.fixed, used)
    return replace(
        case, name=f"{case.name}, {len(used)} vertices", vertices=case.vertices[used], triangles=local.reshape(-1, 3),
        fixed=np.searchsorted(used, case.fixed[stays]), normals=case.normals[stays], reference=case.reference[used],
    )  # fmt: skip


def tetrathing_case(times: int = 4) -> Case:
    """Fig. 8: closed, genus 3, held by a circle round each edge of a tetrahedron; starts from a membrane."""
    vertices, triangles, fixed, normals = tetrathing_mesh(times=times)
    start = shapes.membrane(vertices, triangles, fixed)
    return Case("tetrathing", start, triangles, fixed, normals, start, base=308, seconds=57.0)


def corner_case(times: int = 2) -> Case:
    """Fig. 7, upper row: the blend with subdivision connectivity."""
    vertices, triangles, fixed, normals = three_cylinders.subdivided_corner(times)
    start = shapes.membrane(vertices, triangles, fixed)
    return Case("regular blend", start, triangles, fixed, normals, start)


def head_case(name: str, head: Path, drawing: heads.Drawing) -> Case:
    """The region of a head inside a drawn boundary; normals average all adjacent triangles of the head (§7.5)."""
    region = heads.boundaryd(head, drawing)
    used, local = np.unique(region.triangles[region.own], return_inverse=True)
    points = region.vertices[used]
    fixed = np.searchsorted(used, region.loop)
    return Case(
        name, points, local.reshape(-1, 3), fixed, region.normals[region.loop], points, "conformal", region=region
    )  # fmt: skip


def ear_case(data: Path) -> Case:
    """Fig. 9: of the ICT head."""
    made = head_case("human ear", data / "ict_head.obj", heads.EAR)
    return replace(made, inner_fairness="uniform", base=248, seconds=21.0)


def face_case(data: Path) -> Case:
    """Fig. 10, conformal to the head: of a bust of Demosthenes."""
    return replace(head_case("bust face", data / "demosthenes-low-res.obj", heads.FACE), base=256, seconds=12.0)


def all_cases(data: Path) -> list[Case]:
    """In the order of Table 1."""
    return [blend_case(), face_case(data), ear_case(data), tetrathing_case()]


def thinned_tetrathing(count: int) -> Case:
    """From 828 vertices by half-edge collapses on its fair surface; the circles stay."""
    case = tetrathing_case(times=2)
    surface = case.fair().vertices
    mesh = Thinner(surface, case.triangles, np.array_split(case.fixed, 6))
    thin(mesh, case.free.tolist(), np.ones(len(surface)), len(surface) - count)
    flip_to_delaunay(mesh, set(range(len(surface))))
    triangles = np.array([face for face in mesh.faces if face])
    used, local = np.unique(triangles, return_inverse=True)
    return replace(
        case, vertices=surface[used], triangles=local.reshape(-1, 3), fixed=np.searchsorted(used, case.fixed),
        reference=surface[used],
    )  # fmt: skip
