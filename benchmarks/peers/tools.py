"""Every tool as one call: a problem in, positions of the patch's vertices out, conversions included.

The linear tools get the patch with a ring outside, all held but the patch's inside, and the option that makes their
result continue the tangent planes; ours gets the patch alone with the normals at its boundary.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import igl
import meshlib.mrmeshnumpy as meshlib_arrays
import meshlib.mrmeshpy as meshlib
import numpy as np
import peers_driver
import pymeshlab

import fairing
from problems import FloatArray, Problem

SMOOTHING_STEPS = 100


@dataclass(frozen=True)
class Answer:
    """vertices (n, 3) of the patch; ours also say how many outer steps the finest level took and how it ended."""

    vertices: FloatArray
    steps: int = 0
    state: str = ""


@dataclass(frozen=True)
class Tool:
    """threads: on how many a call may run; growth: time per vertex grows like size to this power, roughly.

    kind: "ours", "peer" (solves the linear clamped bi-Laplacian), "reference" (only that solve), "smoothing" (neither).
    alike: the tool that solves the same system, whose quality it therefore shares.
    """

    name: str
    call: Callable[[Problem], Answer]
    threads: str = "1"
    growth: float = 0.6
    kind: str = "peer"
    alike: str = ""


def fair(problem: Problem, **options: Any) -> fairing.FairResult:
    """`fairing.fair` with the G1 data of the boundary."""
    return fairing.fair(
        problem.vertices, problem.triangles, fixed=problem.fixed, fixed_normals=problem.normals, **options
    )  # fmt: skip


def _ours(problem: Problem, **options: Any) -> Answer:
    result = fair(problem, **options)
    state = result.termination + ("" if result.polished or not result.converged else ", placed")
    return Answer(result.vertices, result.iterations, state)


def _ours_conformal(problem: Problem) -> Answer:
    return _ours(problem, inner_fairness="conformal", reference=problem.reference)


def _libigl(problem: Problem) -> Answer:
    vertices = problem.all_vertices
    result = igl.harmonic(vertices, problem.all_triangles, problem.held, vertices[problem.held], 2)
    return Answer(np.asarray(result)[: len(problem.vertices)])


def _meshlib(problem: Problem) -> Answer:
    mesh = meshlib_arrays.meshFromFacesVerts(problem.all_triangles.astype(np.int32), problem.all_vertices)
    moving = np.zeros(len(problem.all_vertices), dtype=bool)
    moving[problem.free] = True
    region = meshlib_arrays.vertBitSetFromBools(moving)
    meshlib.positionVertsSmoothly(mesh, region, meshlib.EdgeWeights.Cotan, meshlib.VertexMass.NeiArea)
    return Answer(np.asarray(meshlib_arrays.getNumpyVerts(mesh), dtype=np.float64)[: len(problem.vertices)])


def _cgal(problem: Problem, solver: str) -> Answer:
    method = getattr(peers_driver.CgalSolver, solver)
    result = peers_driver.cgal_fair(problem.all_vertices, problem.all_triangles, problem.free, method)
    return Answer(np.asarray(result)[: len(problem.vertices)])


def _direct(problem: Problem, method: str) -> Answer:
    system = peers_driver.bilaplacian_system(problem.all_vertices, problem.all_triangles, problem.free)
    factor = system.factorised(getattr(peers_driver.Method, method))
    result = problem.vertices.copy()
    result[problem.free] = factor.solve(system.load)
    return Answer(result)


def _pymeshlab(problem: Problem) -> Answer:
    chosen = np.zeros(len(problem.all_vertices))
    chosen[problem.free] = 1.0
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(problem.all_vertices, problem.all_triangles, v_scalar_array=chosen))
    meshes.compute_selection_by_condition_per_vertex(condselect="q > 0.5")
    meshes.apply_coord_laplacian_smoothing(stepsmoothnum=SMOOTHING_STEPS, selected=True)
    return Answer(np.asarray(meshes.current_mesh().vertex_matrix())[: len(problem.vertices)])


_CORES = str(os.cpu_count())
OURS = "fairing (ours)"
CONFORMAL = "fairing, conformal (ours)"
MESHLIB, LIBIGL, UMFPACK = "MeshLib positionVertsSmoothly", "libigl harmonic, k = 2", "CGAL fair, UMFPACK"
LDLT, CHOLMOD = "Eigen SimplicialLDLT (AMD)", "CHOLMOD (METIS)"
TOOLS = [
    Tool(OURS, _ours, _CORES, 0.1, "ours"),
    Tool(CONFORMAL, _ours_conformal, _CORES, 0.1, "ours"),
    Tool(MESHLIB, _meshlib),
    Tool(LIBIGL, _libigl),
    Tool(UMFPACK, lambda problem: _cgal(problem, "umfpack"), f"BLAS: {_CORES}"),
    Tool("CGAL fair, default solver", lambda problem: _cgal(problem, "sparse_lu"), growth=1.0, alike=UMFPACK),
    Tool(LDLT, lambda problem: _direct(problem, "ldlt"), kind="reference"),
    Tool(CHOLMOD, lambda problem: _direct(problem, "cholmod"), f"BLAS: {_CORES}", kind="reference", alike=LDLT),
    Tool(f"PyMeshLab Laplacian smoothing, {SMOOTHING_STEPS} steps", _pymeshlab, growth=0.1, kind="smoothing"),
]
BY_NAME = {tool.name: tool for tool in TOOLS}
