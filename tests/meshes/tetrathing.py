"""The tetrathing of Fig. 8: a base of few triangles, subdivided.

The base has 48 vertices and 104 triangles: four pairs of trousers, one at each corner of a tetrahedron, joined along a
circle of four vertices round each edge.
"""

import numpy as np

import measures
import shapes
from blend import Blend
from curves import FloatArray
from meshing import IntArray

Loops = list[list[int]]


def subdivided(triangles: IntArray, count: int) -> tuple[IntArray, IntArray]:
    """Each triangle in four; new vertex count + k is the midpoint of edge k. Returns edges too."""
    ends = measures.edges(triangles)
    key = ends[:, 0] * count + ends[:, 1]

    def middle(a: IntArray, b: IntArray) -> IntArray:
        wanted = np.minimum(a, b) * count + np.maximum(a, b)
        return count + np.searchsorted(key, wanted)

    a, b, c = triangles.T
    ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
    corners = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return np.vstack([np.column_stack(t) for t in corners]), ends


def trousers(corner: int, nodes: FloatArray, rings: dict[tuple[int, int], int], first: int) -> IntArray:
    """26 triangles round one corner: a nine-sided sheet outside and one inside, 13 each.

    rings: first of the four vertices round each pair of nodes; first: of three vertices outside and three inside.
    """
    outward = nodes[corner] / np.linalg.norm(nodes[corner])
    others = [k for k in range(4) if k != corner]
    toward = {k: nodes[k] - nodes[corner] for k in others}
    a, b, c = others
    if np.dot(np.cross(toward[a], toward[b]), outward) < 0:
        b, c = c, b
    order = [a, b, c]

    def ring(k: int, name: str) -> int:
        start = rings[min(corner, k), max(corner, k)]
        edge = nodes[max(corner, k)] - nodes[min(corner, k)]
        side = np.cross(edge, nodes[corner] + nodes[k])
        ahead, behind = order[(order.index(k) + 1) % 3], order[(order.index(k) + 2) % 3]
        left = float(np.dot(side, toward[ahead])) > float(np.dot(side, toward[behind]))
        return start + {"top": 0, "bottom": 2, "ahead": 1 if left else 3}.get(name, 3 if left else 1)

    faces = []
    for side, shift in (("top", 0), ("bottom", 3)):
        sheet = [(first + shift, first + shift + 1, first + shift + 2)]
        for k, name in enumerate(order):
            own, following = first + shift + k, first + shift + (k + 1) % 3
            after = order[(k + 1) % 3]
            sheet += [
                (own, ring(name, side), ring(name, "ahead")),
                (own, ring(name, "behind"), ring(name, side)),
                (own, ring(name, "ahead"), ring(after, "behind")),
                (own, ring(after, "behind"), following),
            ]
        faces += [t if side == "top" else t[::-1] for t in sheet]
    return np.array(faces)


def refined(
    triangles: IntArray, starts: list[int], count: int, times: int
) -> tuple[IntArray, Loops, list[list[float]], int]:
    """Triangles, the circles' vertices in order, their angles and the number of vertices, subdivided `times` times.

    starts: first vertex of each circle of four.
    """
    loops = [[start + s for s in range(4)] for start in starts]
    angles = [[0.5 * np.pi * s for s in range(4)] for _ in starts]
    for _ in range(times):
        triangles, ends = subdivided(triangles, count)
        row = {tuple(e): count + k for k, e in enumerate(ends.tolist())}
        for k in range(len(loops)):
            loops[k], angles[k] = _refined_loop(loops[k], angles[k], row)
        count += len(ends)
    return triangles, loops, angles, count


def tetrathing_mesh(radius: float = 0.35, times: int = 4) -> tuple[FloatArray, IntArray, IntArray, FloatArray]:
    """Vertices (exact on the circles, zero elsewhere), triangles, fixed vertices and their radial normals."""
    nodes = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    pairs = [(i, j) for i in range(4) for j in range(i + 1, 4)]
    rings = {pair: 4 * k for k, pair in enumerate(pairs)}
    base = np.vstack([trousers(k, nodes, rings, 24 + 6 * k) for k in range(4)])
    triangles, loops, angles, count = refined(base, list(rings.values()), 48, times)
    vertices = np.zeros((count, 3))
    normals = []
    for loop, turn, (i, j) in zip(loops, angles, pairs, strict=True):
        middle = 0.5 * (nodes[i] + nodes[j])
        top = middle / np.linalg.norm(middle)
        side = np.cross(nodes[j] - nodes[i], top)
        side /= np.linalg.norm(side)
        radial = np.cos(turn)[:, None] * top + np.sin(turn)[:, None] * side
        vertices[loop] = middle + radius * radial
        normals.append(radial)
    return vertices, triangles, np.concatenate(loops), np.vstack(normals)


def _refined_loop(
    loop: list[int], angles: list[float], middle: dict[tuple[int, int], int]
) -> tuple[list[int], list[float]]:
    """A new vertex between every two neighbours, half-way in angle."""
    vertices, turns = [], []
    step = 2 * np.pi / len(loop)
    for k, vertex in enumerate(loop):
        following = loop[(k + 1) % len(loop)]
        vertices += [vertex, middle[min(vertex, following), max(vertex, following)]]
        turns += [angles[k], angles[k] + 0.5 * step]
    return vertices, turns


def tetrathing(radius: float = 0.35, times: int = 4) -> Blend:
    """The mesh with a membrane inside: 13308 vertices after 4 subdivisions, 3324 after 3."""
    vertices, triangles, fixed, normals = tetrathing_mesh(radius, times)
    return Blend(shapes.membrane(vertices, triangles, fixed), triangles, fixed, normals)
