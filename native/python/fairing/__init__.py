"""Intrinsic fairing of triangle meshes: Δ_B H = 0 with G1 boundary data (Schneider & Kobbelt 2001)."""

from fairing._boundary_normals import BoundaryNormals, boundary_normals
from fairing._conformal_map import conformal_map
from fairing._core import __version__
from fairing._denoise import denoise
from fairing._edges_through import edges_through
from fairing._fair import fair
from fairing._fair_edges import FairEdges, fair_edges
from fairing._feather import feather_weights
from fairing._fill import fill
from fairing._fillet import fillet, fillet_width
from fairing._foreign import refuse_foreign as _refuse_foreign
from fairing._from_curves import surface_from_curves
from fairing._groups import Boundary, Curves, Layout, Options, Skin, Solving, Surface
from fairing._growing import grown_outline
from fairing._hard_edges import hard_edges
from fairing._hierarchy import hierarchy
from fairing._holes import expected_vertices, hole_loops, outer_borders
from fairing._interpolate import interpolate
from fairing._measure import (
    boundary_loops,
    components,
    conformal_distortion,
    cotan_laplacian,
    deviation,
    edges_with_uses,
    flipped_triangles,
    mean_curvature,
    self_intersections,
    vertex_normals,
)
from fairing._new_mesh import FilletResult, FillResult, PairedQuads, RemeshResult
from fairing._outline import (
    VisibleJoin,
    bad_outline,
    mend_outline,
    surrounding_normals,
    visible_join,
)
from fairing._paper import PaperOptions
from fairing._quads import paired_quads
from fairing._remesh import remesh
from fairing._shape import (
    LIMITS,
    flank,
    girth,
    has_lost_grain,
    is_rougher,
    is_spoilt,
    knobs,
    needles,
    rounded_edges,
    seam_kinks,
    sunken,
)
from fairing._solver import Solver
from fairing._types import CODES, Cancelled, Diagnostic, FairResult, MeshError, SolverError
from fairing.objects import fair_faces, fill_holes, fillet_edges

__all__ = [
    "CODES",
    "LIMITS",
    "Boundary",
    "BoundaryNormals",
    "Cancelled",
    "Curves",
    "Diagnostic",
    "FairEdges",
    "FairResult",
    "FillResult",
    "FilletResult",
    "Layout",
    "MeshError",
    "Options",
    "PairedQuads",
    "PaperOptions",
    "RemeshResult",
    "Skin",
    "Solver",
    "SolverError",
    "Solving",
    "Surface",
    "VisibleJoin",
    "__version__",
    "bad_outline",
    "boundary_loops",
    "boundary_normals",
    "components",
    "conformal_distortion",
    "conformal_map",
    "cotan_laplacian",
    "denoise",
    "deviation",
    "edges_through",
    "edges_with_uses",
    "expected_vertices",
    "fair",
    "fair_edges",
    "fair_faces",
    "feather_weights",
    "fill",
    "fill_holes",
    "fillet",
    "fillet_edges",
    "fillet_width",
    "flank",
    "flipped_triangles",
    "girth",
    "grown_outline",
    "hard_edges",
    "has_lost_grain",
    "hierarchy",
    "hole_loops",
    "interpolate",
    "is_rougher",
    "is_spoilt",
    "knobs",
    "mean_curvature",
    "mend_outline",
    "needles",
    "outer_borders",
    "paired_quads",
    "remesh",
    "rounded_edges",
    "seam_kinks",
    "self_intersections",
    "sunken",
    "surface_from_curves",
    "surrounding_normals",
    "vertex_normals",
    "visible_join",
]

if __name__ == "fairing":  # not the copy in Blender's extension
    _refuse_foreign(__path__[0])
