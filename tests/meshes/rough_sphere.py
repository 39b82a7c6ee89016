"""A whole unit sphere, rough everywhere, with a swelling in its selected part."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

import fairing
from curves import FloatArray

IntArray = NDArray[np.int64]
LIMIT = 0.3  # what lies above is selected


@dataclass(frozen=True)
class RoughSphere:
    """Vertices (n, 3) of the sphere itself, with noise, and with noise and the swelling; triangles; boundary (k,)."""

    exact: FloatArray
    skin: FloatArray
    vertices: FloatArray
    inside: IntArray
    outside: IntArray
    boundary: IntArray

    @property
    def free(self) -> IntArray:
        """Vertices that may move."""
        return np.setdiff1d(self.inside, self.boundary)

    @property
    def diameter(self) -> float:
        """D."""
        return 2.0 * float(np.sqrt(1 - LIMIT**2))

    @property
    def edge(self) -> float:
        """Mean length."""
        return float(np.sqrt(8 * np.pi / (len(self.exact) * np.sqrt(3))))

    def normals(self) -> FloatArray:
        """Those of the surroundings."""
        return fairing.surrounding_normals(self.vertices, self.outside, self.boundary).normals

    def fair(self, **options: Any) -> fairing.FairResult:
        """With the normals of the surroundings unless others are given."""
        chosen = {"fixed_normals": self.normals(), "outside": self.outside, **options}
        return fairing.fair(self.vertices, self.inside, fixed=self.boundary, **chosen)

    def heights(self, points: FloatArray, where: IntArray) -> FloatArray:
        """Over the sphere."""
        return np.asarray(np.linalg.norm(points[where], axis=1) - 1)


def rough_sphere(count: int, noise: float = 0.25, seed: int = 0, swelling: float = 0.35) -> RoughSphere:
    """noise: of the vertices along the normals, in edges."""
    rng = np.random.default_rng(seed)
    k = np.arange(count) + 0.5
    z, angle = 1 - 2 * k / count, np.pi * (1 + np.sqrt(5)) * k
    spread = np.stack([np.sqrt(1 - z**2) * np.cos(angle), np.sqrt(1 - z**2) * np.sin(angle), z], axis=1)
    edge = np.sqrt(8 * np.pi / (count * np.sqrt(3)))
    exact = spread + 0.15 * edge * rng.normal(size=(count, 3))
    exact /= np.linalg.norm(exact, axis=1)[:, None]
    triangles = ConvexHull(exact).simplices
    corners = exact[triangles]
    inward = np.linalg.det(corners) < 0
    triangles[inward] = triangles[inward][:, ::-1]
    skin = exact * (1 + noise * edge * rng.normal(size=(count, 1)))
    rise = np.clip((exact[:, 2:] - LIMIT - 0.1) / 0.6, 0, 1)
    vertices = skin + swelling * rise**2 * (3 - 2 * rise) * exact
    chosen = (exact[:, 2] > LIMIT)[triangles].all(axis=1)
    inside, outside = triangles[chosen], triangles[~chosen]
    return RoughSphere(exact, skin, vertices, inside, outside, np.intersect1d(inside, outside))
