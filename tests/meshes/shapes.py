"""Exact patches that solve Δ_B H = 0 (and a torus that does not), as irregular meshes.

    patch = shapes.cap(1000)                                   # hemisphere, jittered
    patch = shapes.catenoid(4000, Style(jitter=1.0, seed=3))    # or shape="rectangle", "oval"
    start = shapes.start_from_nothing(patch)                    # interior forgotten

Closed forms, or ordinary differential equations integrated at 1e-13. `FAMILIES` lists those with
Δ_B H = 0 by name. Sizes are about 1 in an arbitrary unit.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, diags_array
from scipy.sparse.linalg import splu

import curves
from curves import FloatArray
from domains import Domain, Shape, Style
from meshing import Mesh, mesh
from surfaces import Extrusion, Revolution, Sphere, Surface

IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Patch:
    """A mesh with its vertices on an exact surface.

    vertices (n, 3); triangles (m, 3), counter-clockwise seen from the normals' side; fixed (k,) the
    border; normals (n, 3) exact unit normals of all vertices; mean_curvature (n,) exact, −1/R on a
    sphere with outward normals; domain is the piece of surface, which gives distances.
    """

    domain: Domain
    vertices: FloatArray
    triangles: IntArray
    fixed: IntArray
    normals: FloatArray
    mean_curvature: FloatArray

    @property
    def surface(self) -> Surface:
        """The exact surface."""
        return self.domain.surface

    @cached_property
    def free(self) -> IntArray:
        """Indices of the free vertices."""
        return np.setdiff1d(np.arange(len(self.vertices)), self.fixed)

    @cached_property
    def diameter(self) -> float:
        """D: twice the largest distance of the fixed vertices from their centroid."""
        rim = self.vertices[self.fixed]
        return float(2 * np.linalg.norm(rim - rim.mean(axis=0), axis=1).max())

    @property
    def fixed_normals(self) -> FloatArray:
        """Exact normals in the order of `fixed`, (k, 3)."""
        return self.normals[self.fixed]

    def distance(self, points: FloatArray) -> FloatArray:
        """Unsigned distances (k,) of points (k, 3) to the exact surface."""
        return self.surface.distance(points)

    def error(self, points: FloatArray) -> float:
        """Largest distance to the exact surface over D."""
        return float(self.distance(points).max() / self.diameter)


def on_domain(domain: Domain, n_free: int, style: Style | None = None) -> Patch:
    return patch_of(domain, mesh(domain, n_free, style or Style()))


def patch_of(domain: Domain, made: Mesh) -> Patch:
    """The mesh with its exact positions, normals and mean curvatures."""
    s, t = made.st[:, 0], made.st[:, 1]
    surface = domain.surface
    return Patch(
        domain, surface.point(s, t), made.triangles, made.fixed,
        surface.normal(s, t), surface.mean_curvature(s),
    )  # fmt: skip


def cap(n_free: int, style: Style | None = None, *, half_angle: float = 90.0, radius: float = 1.0) -> Patch:
    """Spherical cap about the north pole, outward normals; 90° is the hemisphere, up to 160°."""
    arc = curves.Arc(0.0, radius * np.radians(half_angle), -radius)
    return on_domain(Domain(Sphere(arc), "disc"), n_free, style)


def _revolved(curve: curves.Curve, shape: Shape, n_free: int, style: Style | None, opening: float) -> Patch:
    """All the way round, or an opening (radians) of a rectangle or oval; outward normals."""
    high = 2 * np.pi if shape == "tube" else opening
    return on_domain(Domain(Revolution(curve, -1), shape, 0.0, high), n_free, style)


def cylinder(n_free: int, style: Style | None = None, *, shape: Shape = "tube", length: float = 2.0) -> Patch:
    """Cylinder of radius 1 and the given length, H = −1/2; as a patch it opens by 2 radians."""
    line = curves.Line(-0.5 * length, 0.5 * length, 1.0)
    return _revolved(line, shape, n_free, style, 2.0)


def catenoid(
    n_free: int, style: Style | None = None, *, shape: Shape = "tube",
    span: tuple[float, float] = (-0.5, 0.9),
) -> Patch:  # fmt: skip
    """Catenoid of waist 1 between two arc lengths from the waist, H = 0."""
    return _revolved(curves.Catenary(*span), shape, n_free, style, 2.0)


def unduloid(
    n_free: int, style: Style | None = None, *, shape: Shape = "tube",
    span: tuple[float, float] = (-0.8, 1.4), neck: float = 0.6, bulge: float = 1.4,
) -> Patch:  # fmt: skip
    """Unduloid between two arc lengths from its neck, H = −1/(neck + bulge)."""
    profile = curves.delaunay_profile(*span, neck, bulge)
    return _revolved(profile, shape, n_free, style, 2.0)


def linear_flux(
    n_free: int, style: Style | None = None, *, shape: Shape = "tube",
    span: tuple[float, float] = (0.0, 1.4), flux: float = 0.35,
) -> Patch:  # fmt: skip
    """Surface of revolution with r H′ = flux: harmonic, but not constant, H."""
    profile = curves.linear_flux_profile(*span, flux)
    return _revolved(profile, shape, n_free, style, 2.0)


def torus(n_free: int, style: Style | None = None, *, shape: Shape = "rectangle") -> Patch:
    """Outer part of a torus (radii 2 and 0.7): H varies and is not harmonic; for operators."""
    arc = curves.Arc(0.7 * np.radians(40), 0.7 * np.radians(150), 0.7, 2.0)
    return _revolved(arc, shape, n_free, style, 0.8)


def clothoid(
    n_free: int, style: Style | None = None, *, shape: Literal["rectangle", "oval"] = "oval",
    a: float = 0.4, b: float = 0.8, height: float = 1.6,
) -> Patch:  # fmt: skip
    """Extrusion of the curve with curvature a + b s, s in [−1, 1]; normals left, H = (a + b s)/2.

    The oval has no corners, at which a one-sided fit of curvature is ill-conditioned.
    """
    surface = Extrusion(curves.clothoid(-1.0, 1.0, a, b), 1)
    return on_domain(Domain(surface, shape, 0.0, height), n_free, style)


def plane(n_free: int, style: Style | None = None, *, shape: Literal["rectangle", "oval"] = "oval") -> Patch:
    """A flat patch, H = 0."""
    surface = Extrusion(curves.Line(-1.0, 1.0), 1)
    return on_domain(Domain(surface, shape, 0.0, 1.6), n_free, style)


FAMILIES: dict[str, Callable[..., Patch]] = {
    "hemisphere": cap,
    "cylinder": cylinder,
    "short_cylinder": partial(cylinder, length=1.0),
    "cylinder_patch": partial(cylinder, shape="rectangle"),
    "catenoid": catenoid,
    "unduloid": unduloid,
    "linear_flux": linear_flux,
    "clothoid": clothoid,
    "plane": plane,
}


def uniform_laplacian(triangles: IntArray, count: int) -> coo_array:
    """Graph Laplacian with unit weights, (count, count), positive semidefinite."""
    i = triangles.ravel()
    j = np.roll(triangles, -1, axis=1).ravel()
    ends = np.unique(np.sort(np.column_stack([i, j]), axis=1), axis=0)
    rows, columns = (np.concatenate([ends[:, 0], ends[:, 1]]), np.concatenate([ends[:, 1], ends[:, 0]]))
    weights = coo_array((np.ones(len(rows)), (rows, columns)), shape=(count, count)).tocsr()
    return (diags_array(weights.sum(axis=1)) - weights).tocoo()


def membrane(vertices: FloatArray, triangles: IntArray, fixed: IntArray) -> FloatArray:
    """Vertices (n, 3) with every free one at the mean of its neighbours (uniform weights)."""
    free = np.setdiff1d(np.arange(len(vertices)), fixed)
    matrix = uniform_laplacian(triangles, len(vertices)).tocsr()
    result = vertices.copy()
    load = -(matrix[free][:, fixed] @ vertices[fixed])
    result[free] = splu(matrix[free][:, free].tocsc()).solve(load)
    return result


def start_from_nothing(patch: Patch, kind: Literal["membrane", "point"] = "membrane") -> FloatArray:
    """Vertices whose interior knows nothing of the surface, exact only at `fixed`.

    "membrane": the linear membrane; "point": all at the outline's centroid with 1e-3 D of noise.
    """
    if kind == "membrane":
        return membrane(patch.vertices, patch.triangles, patch.fixed)
    noise = np.random.default_rng(0).standard_normal((len(patch.free), 3))
    result = patch.vertices.copy()
    centre = patch.vertices[patch.fixed].mean(axis=0)
    result[patch.free] = centre + 1e-3 * patch.diameter * noise
    return result
