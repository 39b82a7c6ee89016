"""Other hole fillers, as far as they are installed: what the hole of a mesh becomes with each."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Any

import numpy as np

from holes import FloatArray, IntArray

Filler = Callable[[FloatArray, IntArray, float], FloatArray]  # vertices, triangles, edge length → all vertices


def pymeshfix(vertices: FloatArray, triangles: IntArray, _length: float) -> FloatArray:
    """Its own sizes."""
    tin = importlib.import_module("pymeshfix").PyTMesh()
    tin.load_array(vertices, triangles.astype(np.int32))
    tin.fill_small_boundaries(refine=True)
    return np.asarray(tin.return_arrays()[0])


def pymeshlab(vertices: FloatArray, triangles: IntArray, _length: float) -> FloatArray:
    """Close Holes with refinement, to the mean length of the border's edges."""
    library: Any = importlib.import_module("pymeshlab")
    meshes = library.MeshSet()
    meshes.add_mesh(library.Mesh(vertices, triangles.astype(np.int32)))
    meshes.meshing_close_holes(maxholesize=10_000, refinehole=True)
    return np.asarray(meshes.current_mesh().vertex_matrix())


def meshlib(vertices: FloatArray, triangles: IntArray, length: float) -> FloatArray:
    """Fill Hole Nicely: triangulated, divided down to this length, and made smooth."""
    library: Any = importlib.import_module("meshlib.mrmeshpy")
    arrays: Any = importlib.import_module("meshlib.mrmeshnumpy")
    mesh = arrays.meshFromFacesVerts(triangles.astype(np.int32), vertices)
    settings = library.FillHoleNicelySettings()
    settings.subdivideSettings.maxEdgeLen = length
    library.fillHoleNicely(mesh, mesh.topology.findHoleRepresentiveEdges()[0], settings)
    return np.asarray(arrays.getNumpyVerts(mesh))


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
