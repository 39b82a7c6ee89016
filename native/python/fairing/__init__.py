"""Intrinsic fairing of triangle meshes: Δ_B H = 0 with G1 boundary data (Schneider & Kobbelt 2001)."""

from pathlib import Path as _Path

from fairing import borders as borders
from fairing import looks as looks
from fairing import maps as maps
from fairing import results as results
from fairing._core import __version__
from fairing.filleting.edges import edges_through, fair_edges
from fairing.filleting.fillet import fillet, fillet_width
from fairing.filling.fill import fill
from fairing.filling.from_curves import surface_from_curves
from fairing.measure import (
    boundary_loops,
    components,
    conformal_distortion,
    cotan_laplacian,
    deviation,
    edges_with_uses,
    hard_edges,
    hierarchy,
    mean_curvature,
    self_intersections,
    vertex_normals,
)
from fairing.meshing.denoise import denoise
from fairing.meshing.remesh import remesh
from fairing.objects.calls import fair_faces, fill_holes, fillet_edges
from fairing.options.groups import Boundary, Curves, Layout, Options, PaperOptions, Skin, Solving, Surface
from fairing.results import Cancelled, Diagnostic, FairResult, FillResult, MeshError, RemeshResult, SolverError
from fairing.solving.fair import Solver, fair
from fairing.solving.feather import feather_weights
from fairing.solving.surroundings import bad_outline, boundary_normals, surrounding_normals

__all__ = [
    "Boundary",
    "Cancelled",
    "Curves",
    "Diagnostic",
    "FairResult",
    "FillResult",
    "Layout",
    "MeshError",
    "Options",
    "PaperOptions",
    "RemeshResult",
    "Skin",
    "Solver",
    "SolverError",
    "Solving",
    "Surface",
    "__version__",
    "bad_outline",
    "boundary_loops",
    "boundary_normals",
    "components",
    "conformal_distortion",
    "cotan_laplacian",
    "denoise",
    "deviation",
    "edges_through",
    "edges_with_uses",
    "fair",
    "fair_edges",
    "fair_faces",
    "feather_weights",
    "fill",
    "fill_holes",
    "fillet",
    "fillet_edges",
    "fillet_width",
    "hard_edges",
    "hierarchy",
    "mean_curvature",
    "remesh",
    "self_intersections",
    "surface_from_curves",
    "surrounding_normals",
    "vertex_normals",
]

if __name__ == "fairing":  # not the copy in Blender's extension
    # On PyPI a tool for machine learning, last released in 2019, has a package of the same name: one folder for both.
    for _other in _Path(__path__[0]).parent.glob("fairing-*.dist-info"):
        raise ImportError(
            f"two packages share the folder {__path__[0]}: intrinsic-fairing, and {_other.stem}, which has nothing to "
            "do with it. Run 'pip uninstall fairing', then 'pip install --force-reinstall --no-deps intrinsic-fairing'"
        )
