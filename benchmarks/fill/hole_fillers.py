"""Other hole fillers, as far as they are installed: what the hole of a mesh becomes with each."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Any

import numpy as np

from holes import FloatArray, IntArray

Mesh = tuple[FloatArray, IntArray]
Filler = Callable[[FloatArray, IntArray, float], Mesh]  # vertices, triangles, edge length → the filled mesh


def pymeshfix(vertices: FloatArray, triangles: IntArray, _length: float) -> Mesh:
    """Its own sizes."""
    tin = importlib.import_module("pymeshfix").PyTMesh()
    tin.load_array(vertices, triangles.astype(np.int32))
    tin.fill_small_boundaries(refine=True)
    return tin.return_arrays()


def pymeshlab(vertices: FloatArray, triangles: IntArray, _length: float) -> Mesh:
    """Close Holes with refinement, to the mean length of the border's edges."""
    library: Any = importlib.import_module("pymeshlab")
    meshes = library.MeshSet()
    meshes.add_mesh(library.Mesh(vertices, triangles.astype(np.int32)))
    meshes.meshing_close_holes(maxholesize=10_000, refinehole=True)
    return meshes.current_mesh().vertex_matrix(), meshes.current_mesh().face_matrix()


def meshlib(vertices: FloatArray, triangles: IntArray, length: float) -> Mesh:
    """Fill Hole Nicely: triangulated, divided down to this length, and made smooth."""
    library: Any = importlib.import_module("meshlib.mrmeshpy")
    arrays: Any = importlib.import_module("meshlib.mrmeshnumpy")
    mesh = arrays.meshFromFacesVerts(triangles.astype(np.int32), vertices)
    settings = library.FillHoleNicelySettings()
    settings.subdivideSettings.maxEdgeLen = length
    for edge in mesh.topology.findHoleRepresentiveEdges():
        library.fillHoleNicely(mesh, edge, settings)
    return arrays.getNumpyVerts(mesh), arrays.getNumpyFaces(mesh.topology)


_ALL = {
    "pymeshfix": ("pymeshfix", pymeshfix),
    "PyMeshLab": ("pymeshlab", pymeshlab),
    "MeshLib": ("meshlib.mrmeshpy", meshlib),
}


def installed() -> dict[str, Filler]:
    """By name."""
    found = {}
    for name, (module, fill) in _ALL.items():
        try:
            importlib.import_module(module)
        except ImportError:
            continue
        found[name] = fill
    return found
