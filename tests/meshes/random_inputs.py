"""Random patches and random damage to them, as hypothesis strategies; every example is a seed and a few numbers."""

from dataclasses import replace

import numpy as np
from hypothesis import strategies as st
from scipy.spatial import Delaunay

import measures
from curves import FloatArray
from hard_inputs import Input
from meshing import IntArray

HOLES = {"disc": [], "annulus": [(0.0, 0.0, 0.45)], "pair of pants": [(-0.45, 0.0, 0.25), (0.45, 0.1, 0.3)]}


def planar(shape: str, count: int, rng: np.random.Generator) -> tuple[FloatArray, IntArray]:
    """Points (n, 2) of the unit disc, evenly round its boundaries, at random between, and a Delaunay triangulation."""
    circles = [(0.0, 0.0, 1.0), *HOLES[shape]]
    angle = 2 * np.pi * np.arange(24) / 24
    rims = [
        np.column_stack([x + r * np.cos(angle), y + r * np.sin(angle)])[:: 1 if r == 1 else 2] for x, y, r in circles
    ]
    inner = rng.uniform(-0.95, 0.95, (4 * count + 64, 2))
    keep = np.hypot(*inner.T) < 0.95
    for x, y, r in HOLES[shape]:
        keep &= np.hypot(inner[:, 0] - x, inner[:, 1] - y) > r + 0.05
    points = np.vstack([*rims, inner[keep][:count]])
    triangles = Delaunay(points).simplices.astype(np.int64)
    centres = points[triangles].mean(axis=1)
    outside = np.zeros(len(triangles), dtype=bool)
    for x, y, r in HOLES[shape]:
        outside |= np.hypot(centres[:, 0] - x, centres[:, 1] - y) < r
    a, b, c = (points[triangles[:, k]] for k in range(3))
    turn = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    triangles[turn < 0] = triangles[turn < 0][:, ::-1]
    return points, triangles[~outside & (np.abs(turn) > 1e-9)]


def lifted(points: FloatArray, height: float, rng: np.random.Generator) -> tuple[FloatArray, FloatArray]:
    """Points (n, 3) of a random quadric over the plane, and its upward normals."""
    a, b, c, d, e = height * rng.uniform(-1.0, 1.0, 5)
    x, y = points.T
    normals = np.column_stack([-(2 * a * x + b * y + d), -(b * x + 2 * c * y + e), np.ones(len(x))])
    vertices = np.column_stack([x, y, a * x**2 + b * x * y + c * y**2 + d * x + e * y])
    return vertices, normals / np.linalg.norm(normals, axis=1)[:, None]


def make_patch(shape: str, count: int, seed: int, height: float = 0.5, noise: float = 0.2) -> Input:
    """One of `HOLES` with so many free vertices: G1 data of a random quadric, its normals disturbed by `noise`."""
    rng = np.random.default_rng(seed)
    points, triangles = planar(shape, count, rng)
    vertices, normals = lifted(points, height, rng)
    fixed = np.unique(measures.border_edges(triangles))
    disturbed = normals[fixed] + noise * rng.standard_normal((len(fixed), 3))
    return Input(vertices, triangles, fixed, disturbed, vertices)


@st.composite
def patches(draw: st.DrawFn) -> Input:
    """A disc or a disc with one or two holes, up to 60 free vertices."""
    return make_patch(
        draw(st.sampled_from(list(HOLES))), draw(st.integers(1, 60)), draw(st.integers(0, 2**32 - 1)),
        draw(st.floats(0.0, 0.5)), draw(st.floats(0.0, 0.2)),
    )  # fmt: skip


def flip(item: Input, rng: np.random.Generator) -> Input:
    """One triangle wound the other way."""
    triangles = item.triangles.copy()
    k = rng.integers(len(triangles))
    triangles[k] = triangles[k, ::-1]
    return replace(item, triangles=triangles)


def duplicate(item: Input, rng: np.random.Generator) -> Input:
    """One triangle twice, wound either way."""
    again = item.triangles[[rng.integers(len(item.triangles))]][:, :: rng.choice([-1, 1])]
    return replace(item, triangles=np.vstack([item.triangles, again]))


def delete(item: Input, rng: np.random.Generator) -> Input:
    """A hole of one triangle."""
    return replace(item, triangles=np.delete(item.triangles, rng.integers(len(item.triangles)), axis=0))


def collapse(item: Input, rng: np.random.Generator) -> Input:
    """One vertex at the place of a neighbour."""
    a, b = item.triangles[rng.integers(len(item.triangles))][:2]
    vertices = item.vertices.copy()
    vertices[a] = vertices[b]
    return replace(item, vertices=vertices, reference=vertices)


def weld(item: Input, rng: np.random.Generator) -> Input:
    """Two vertices anywhere become one: triangles that name a vertex twice, bow-ties, crossed sheets."""
    a, b = rng.integers(len(item.vertices), size=2)
    return replace(item, triangles=np.where(item.triangles == a, b, item.triangles))


def poison(item: Input, rng: np.random.Generator) -> Input:
    """One coordinate is no number."""
    vertices = item.vertices.copy()
    vertices[rng.integers(len(vertices)), rng.integers(3)] = rng.choice([np.nan, np.inf, -np.inf])
    return replace(item, vertices=vertices, reference=vertices)


def add(item: Input, rng: np.random.Generator) -> Input:
    """A triangle of any three vertices."""
    return replace(item, triangles=np.vstack([item.triangles, rng.integers(len(item.vertices), size=(1, 3))]))


def pocket(item: Input, rng: np.random.Generator) -> Input:
    """Two triangles between two vertices of one and a new one."""
    a, b = item.triangles[rng.integers(len(item.triangles))][:2]
    new = len(item.vertices)
    vertices = np.vstack([item.vertices, rng.standard_normal((1, 3))])
    triangles = np.vstack([item.triangles, [[a, b, new], [b, a, new]]])
    return replace(item, vertices=vertices, triangles=triangles, reference=vertices)


def hold(item: Input, rng: np.random.Generator) -> Input:
    """A third of the vertices fixed besides, with normals anywhere."""
    more = np.setdiff1d(np.flatnonzero(rng.random(len(item.vertices)) < 1 / 3), item.fixed)
    normals = None if item.normals is None else np.vstack([item.normals, rng.standard_normal((len(more), 3))])
    return replace(item, fixed=np.concatenate([item.fixed, more]), normals=normals)


DAMAGE = (flip, duplicate, delete, collapse, weld, poison, add, pocket, hold)


@st.composite
def damaged(draw: st.DrawFn) -> Input:
    """A patch with one to four damages."""
    item = draw(patches())
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    for harm in draw(st.lists(st.sampled_from(DAMAGE), min_size=1, max_size=4)):
        item = harm(item, rng)
    return item
