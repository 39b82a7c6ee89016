"""Smoothing for scripts: a mesh and its faces, without edit mode, operators or a context."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import bpy
import numpy as np

from ..arrays.types import Floats
from ..fair.script import read
from ..mesh import mesh_io
from ..options.options import FairOptions
from ..options.other_options import DenoiseOptions
from .denoising import denoise_arrays


def denoise_mesh(
    mesh: bpy.types.Mesh, faces: Sequence[int] | None = None, *, matrix: Any = None, **properties: Any
) -> Floats:
    """Take the roughness from the polygons `faces` of `mesh` and keep their shape.

    faces: their numbers, or a mask of all polygons; default: all.
    matrix: 4×4, to the space in which `size` is measured; default: the mesh's own.
    properties: those of `mesh.fair_denoise`, with the same names and defaults.
    Returns how far each vertex of the mesh has moved (n,), in the space of `matrix`. The boundary, open borders and
    edges marked sharp stay.
    Raises fairing.MeshError (elements: vertices of `mesh`), ValueError, TypeError for a property that does not exist,
    IndexError, fairing.SolverError and MemoryError. The mesh is untouched then.
    """
    options = DenoiseOptions.named(properties)
    chosen = range(len(mesh.polygons)) if faces is None else faces
    arrays, world = read(mesh, chosen, matrix, FairOptions())
    outcome = denoise_arrays(arrays, world, options)
    mesh_io.write_mesh(mesh, outcome.vertices, outcome.positions)
    moved = np.zeros(len(arrays.positions))
    before = arrays.positions[outcome.vertices]
    moved[outcome.vertices] = np.linalg.norm((outcome.positions - before) @ world[:3, :3].T, axis=1)
    return moved
