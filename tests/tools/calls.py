"""Every public call of the package as a row of a table: on which mesh, what is found, and what motions make of that."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

import bad_inputs
import fairing
import solids

Found = list[tuple[str, Any, Any]]
"""kind; vertices that it is said of; values. Sets of vertices, edges or triangles, and surfaces, have values alone."""


@dataclass(frozen=True)
class Scene:
    """A mesh of which a part is selected, and other places of its vertices. All arrays are read-only."""

    points: Any
    faces: Any
    chosen: Any  # (m,) mask
    other: Any  # (n, 3)
    unit: float = 1.0
    side: float = 1.0  # the normals' side: −1 where it is wound the other way

    def __post_init__(self) -> None:
        for array in (self.points, self.faces, self.chosen, self.other):
            array.flags.writeable = False

    @property
    def inside(self) -> Any:
        return self.faces[self.chosen]

    @property
    def outside(self) -> Any:
        return self.faces[~self.chosen]

    @property
    def rim(self) -> Any:
        return np.intersect1d(self.inside, self.outside)

    @property
    def normals(self) -> Any:
        """Of the surroundings, at the rim."""
        return fairing.surrounding_normals(self.points, self.outside, self.rim).normals

    @property
    def part(self) -> tuple[Any, Any, Any]:
        """The selected part alone: points, triangles, boundary."""
        used, faces = np.unique(self.inside, return_inverse=True)
        return self.points[used], faces.reshape(-1, 3), np.searchsorted(used, self.rim)

    @property
    def loops(self) -> Any:
        """Of the selected part."""
        return fairing.boundary_loops(self.inside)

    def fair(self, **options: Any) -> Found:
        """The selected part, to many digits."""
        given = {"fixed": self.rim, "fixed_normals": self.normals, "tolerance": 1e-11, **options}
        return of_result(fairing.fair(self.points, self.inside, **given))


@dataclass(frozen=True)
class Motion:
    """A turn, a scale, a shift; with a seed other numbers of vertices and triangles; `over`: wound the other way."""

    turn: Any = field(default_factory=lambda: np.eye(3))
    scale: float = 1.0
    shift: float = 0.0
    seed: int | None = None
    over: bool = False

    def order(self, count: int) -> Any:
        """New number k is the old one order[k]."""
        return np.arange(count) if self.seed is None else np.random.default_rng(self.seed).permutation(count)

    def image(self, kind: str, values: Any) -> Any:
        """What becomes of points, directions, heights, curvatures; other figures have no unit."""
        sign, values = -1.0 if self.over else 1.0, np.asarray(values)
        if kind in ("points", "surface"):
            return self.scale * (values @ self.turn.T + self.shift)
        if kind == "directions":
            return sign * values @ self.turn.T
        return values * {"heights": sign * self.scale, "lengths": self.scale, "curvatures": sign / self.scale}.get(
            kind, 1.0
        )

    def of(self, scene: Scene) -> Scene:
        """The scene, moved."""
        order, rows = self.order(len(scene.points)), self.order(len(scene.faces))
        faces = np.roll(np.argsort(order)[scene.faces][rows], self.seed is not None, axis=1)
        faces = faces[:, :: -1 if self.over else 1].copy()
        points, other = (self.image("points", places)[order] for places in (scene.points, scene.other))
        return Scene(points, faces, scene.chosen[rows], other, self.scale, -1.0 if self.over else 1.0)

    def difference(self, scene: Scene, before: Found, after: Found) -> float:
        """The largest one between what was found before and after the motion, in units of the scene."""
        place, row = (np.argsort(self.order(len(array))) for array in (scene.points, scene.faces))
        units = dict.fromkeys(("points", "surface", "heights", "lengths"), self.scale) | {"curvatures": 1 / self.scale}
        worst = 0.0
        for (kind, where, values), (_, there, found) in zip(before, after, strict=True):
            if kind in ("vertices", "triangles"):
                number = place if kind == "vertices" else row
                sets = [{frozenset(np.atleast_1d(each).tolist()) for each in many} for many in (number[values], found)]
                assert sets[0] == sets[1], kind
                continue
            if kind == "surface":
                (old, old_faces), (new, new_faces) = (self.image(kind, values[0]), values[1]), found
                gaps = [fairing.deviation(old[np.unique(old_faces)], new, new_faces)]
                gaps += [fairing.deviation(new[np.unique(new_faces)], old, old_faces)]
            elif where is None:
                gaps = [self.image(kind, values) - np.asarray(found)]
            else:
                gaps = [self.image(kind, values)[np.argsort(place[where])] - np.asarray(found)[np.argsort(there)]]
            worst = max(worst, *(float(np.nanmax(np.abs(gap), initial=0.0)) / units.get(kind, 1.0) for gap in gaps))
        return worst


def ball() -> Scene:
    """A ball bent out of shape, a zigzag part of it selected; the other places are rough."""
    points, faces, _ = bad_inputs.closed_ball(150)
    chosen = points[faces].mean(axis=1) @ np.array([0.6, 0.0, 0.8]) > 0.5
    x, y, z = points.T
    points = np.column_stack([x + 0.1 * y * z, 0.9 * y, 1.1 * z + 0.08 * x * x])
    return Scene(points, faces, chosen, points + 0.01 * np.random.default_rng(2).normal(size=points.shape))


def box() -> Scene:
    """A box bent out of shape, a part of it selected through which an edge runs."""
    points, faces = solids.box(8)
    chosen = (np.linalg.norm(points - [1.0, 0.1, 1.0], axis=1) < 0.8)[faces].all(axis=1)
    points = points * [1.0, 0.8, 1.3] + 0.05 * points[:, [1, 2, 0]]
    return Scene(points, faces, chosen, points + 0.01 * np.random.default_rng(2).normal(size=points.shape))


def tetrahedron() -> Scene:
    points = np.array([[0, 0, 0], [1, 0.1, 0], [0.2, 1, 0], [0.1, 0.3, 0.9]])
    return Scene(points, np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]), np.arange(4) == 0, points + 0.0)


def tube() -> Scene:
    """A cylinder with a waist, its middle selected; the other places have a thicker one."""
    z, turn = (a.ravel() for a in np.meshgrid(np.linspace(0, 4, 33), 2 * np.pi * np.arange(24) / 24, indexing="ij"))
    k = np.arange(32 * 24)
    a, b = k, k - k % 24 + (k + 1) % 24
    faces = np.concatenate([np.column_stack([a, b, b + 24]), np.column_stack([a, b + 24, a + 24])])
    waists = [1 - depth * np.exp(-(((z - 2) / 0.5) ** 2)) for depth in (0.3, 0.2)]
    bent = np.column_stack([np.cos(turn), 1.05 * np.sin(turn), z + 0.03 * np.cos(turn + 1)])
    points, other = (np.column_stack([r, r, np.ones_like(r)]) * bent for r in waists)
    return Scene(points, faces, np.abs(bent[faces].mean(axis=1)[:, 2] - 2) < 1.2, other)


def of_result(result: Any) -> Found:
    """Of vertices that keep their numbers. A step of the tolerance shows in H by its ratio to the edge's square."""
    every = np.arange(len(result.vertices))
    return [("points", every, result.vertices), ("curvatures", every, 1e-3 * result.mean_curvature)]


def surface(old: Any, result: Any) -> Found:
    """Of a new mesh."""
    return [("surface", None, (np.concatenate([old, result.vertices]), result.triangles))]


def figures(*values: Any) -> Found:
    return [("plain", None, np.array(values, dtype=float))]


def at_rim(scene: Scene, found: Any) -> Found:
    return [("directions", scene.rim, found.normals), ("plain", scene.rim, found.errors)]


def solved_again(scene: Scene, threads: int = 0, **asked: Any) -> Found:
    solver = fairing.Solver(scene.inside, fixed=scene.rim, tolerance=1e-11, threads=threads)
    solver.solve(scene.other, scene.normals)
    return of_result(solver.solve(scene.points, scene.normals, **asked))


def edges_made_fair(scene: Scene) -> Found:
    found = fairing.edges_through(scene.points, scene.inside, scene.outside)
    fair = fairing.fair_edges(scene.other, found.edges, found.onward)
    return [("points", np.arange(len(fair.vertices)), fair.vertices), ("vertices", None, found.edges)]


def stiffness(scene: Scene) -> Found:
    row, column, value = fairing.cotan_laplacian(scene.points, scene.faces)
    return [("plain", row[row == column], value[row == column])]


def over_wires(scene: Scene, **asked: Any) -> Found:
    (loop,) = scene.loops
    edges = np.column_stack([loop, np.roll(loop, -1)])
    return surface(scene.points, fairing.surface_from_curves(scene.points, edges, **asked))


def filleted(scene: Scene, **asked: Any) -> Found:
    return surface(scene.points, fairing.fillet(scene.points, scene.faces, width=0.15 * scene.unit, **asked))


def rough_part(scene: Scene) -> tuple[Any, Any]:
    """The points, rough inside: where they were, and where they would be."""
    moved = scene.points.copy()
    inner = np.setdiff1d(scene.inside, scene.rim)
    moved[inner] += 4 * (scene.other[inner] - moved[inner])
    return scene.points, moved


@dataclass(frozen=True)
class Row:
    """A call on a scene, by what motions and other numbers may change it, in units, and whether it runs.

    Calls that run have `progress` and `threads`.
    """

    scene: Callable[[], Scene]
    call: Callable[..., Found]
    within: float = 1e-9
    numbers: float | None = None  # as `within`
    runs: bool = False


def _run(scene: Callable[[], Scene], call: Callable[..., Found], within: float, numbers: float | None = None) -> Row:
    return Row(scene, call, within, numbers, runs=True)


ROWS: dict[str, Row] = {
    "fair": _run(ball, Scene.fair, 1e-8),
    "fair: conformal": _run(ball, lambda s, **k: s.fair(inner_fairness="conformal", **k), 1e-8),
    "fair: curvature": _run(ball, lambda s, **k: s.fair(continuity="G2", outside=s.outside, **k), 1e-3),
    "fair: detail": _run(  # which vertices a low pass looks at goes by their numbers
        ball, lambda s, **k: s.fair(detail=1.0, outside=s.outside, reference=s.other, **k), 1e-6, 6e-3
    ),
    "fair: feather": _run(ball, lambda s, **k: s.fair(feather=0.2, outside=s.outside, **k), 1e-6, 1e-3),
    "fair: mended": _run(
        ball, lambda s, **k: replace(s, points=s.other).fair(outline="mended", outside=s.outside, **k), 1e-6
    ),
    "fair: soap film": _run(ball, lambda s, **k: s.fair(equation="soap_film", **k), 1e-8),
    "fair: bulge": _run(ball, lambda s, **k: s.fair(equation="constant", bulge=0.1 * s.side, **k), 1e-7),
    "fair: least energy": _run(ball, lambda s, **k: s.fair(equation="minimal_energy", **k), 1e-7),
    "fair: least variation": _run(ball, lambda s, **k: s.fair(equation="least_variation", **k), 2e-3),
    "fair: a tube": _run(tube, Scene.fair, 1e-6),
    "fair: automatic": _run(tube, lambda s, **k: s.fair(equation="automatic", **k), 1e-3),
    "Solver": _run(ball, solved_again, 1e-8),
    "fill": _run(ball, lambda s, **k: surface(s.points, fairing.fill(s.points, s.outside, **k)), 3e-2),
    "fill: edges": _run(box, lambda s, **k: surface(s.points, fairing.fill(s.points, s.outside, **k)), 2e-2),
    "fill: quads": _run(
        ball, lambda s, **k: surface(s.points, fairing.fill(s.points, s.outside, faces="quads", **k)), 6e-2
    ),
    "fill: bridge": _run(
        tube, lambda s, **k: surface(s.points, fairing.fill(s.points, s.outside, s.loops, bridge=True, **k)), 2e-2
    ),
    "remesh": _run(
        ball,
        lambda s, **k: surface(s.points, fairing.remesh(s.points, s.inside, s.rim, fixed_normals=s.normals, **k)), 2e-2,
    ),
    "fillet": _run(tetrahedron, filleted, 2e-2),
    "fillet_width": Row(
        tetrahedron, lambda s: [("lengths", None, np.atleast_1d(fairing.fillet_width(s.points, s.faces)))]
    ),
    "surface_from_curves": _run(ball, over_wires, 6e-2),
    "denoise": _run(
        ball, lambda s, **k: [("points", np.arange(len(s.points)), fairing.denoise(s.other, s.faces, **k))], 1e-9
    ),
}  # fmt: skip


def every(scene: Scene) -> Any:
    return np.arange(len(scene.points))


def laid_flat(scene: Scene) -> Found:
    """The part, from where two of its vertices are: places in the plane don't move."""
    points, faces, _ = scene.part
    far = [int(np.linalg.norm(points - end.mean(axis=0), axis=1).argmax()) for end in (points, scene.points)]
    places = fairing.maps.conformal_map(points, faces, far, [[0, 0], [1, 0]])
    return [("plain", None, np.sort(np.hypot(*places.T)))]


def girth(scene: Scene) -> Found:
    found = fairing.looks.girth(scene.points, scene.inside)
    assert found is not None
    return [*figures(found.least, found.largest), ("vertices", None, found.thinnest)]


def loops_of(scene: Scene) -> Found:
    found = fairing.borders.hole_loops(scene.points, scene.outside)
    outer = fairing.borders.outer_borders(scene.points, scene.outside)
    return [("vertices", None, np.concatenate(found.loops)), *figures(len(found.torn), outer.sum())]


def judged(scene: Scene) -> Found:
    edges = fairing.hard_edges(scene.points, scene.faces)
    moved = np.intersect1d(edges, np.setdiff1d(scene.inside, scene.rim))
    after = scene.points.copy()
    after[moved] -= 0.1 * (scene.points[moved] - scene.points.mean(axis=0))
    rim = np.unique(scene.rim)
    found = fairing.looks.judged(
        after, scene.inside, scene.outside, held=rim, rim=rim, before=scene.points, moved=moved
    )  # fmt: skip
    return [("vertices", None, found.rounded), ("plain", rim, found.join.degrees)]


ROWS |= {
    "bad_outline": Row(ball, lambda s: [("vertices", None, fairing.bad_outline(s.other, s.outside, s.rim))]),
    "boundary_loops": Row(ball, lambda s: [("vertices", None, np.concatenate(s.loops))]),
    "boundary_normals": Row(
        ball, lambda s: at_rim(s, fairing.boundary_normals(s.points, s.inside, s.rim, outside=s.outside))
    ),
    "components": Row(ball, lambda s: figures(fairing.components(s.faces, fixed=s.rim).max())),
    "conformal_distortion": Row(
        ball, lambda s: figures(*np.sort(fairing.conformal_distortion(s.points, s.other, s.faces)))
    ),
    "conformal_map": Row(ball, laid_flat),
    "cotan_laplacian": Row(ball, stiffness),
    "deviation": Row(ball, lambda s: [("heights", every(s), fairing.deviation(s.points, s.other, s.faces))]),
    "edges_through": Row(box, edges_made_fair),
    "edges_with_uses": Row(ball, lambda s: [("vertices", None, fairing.edges_with_uses(s.faces)[0])]),
    "expected_vertices": Row(ball, lambda s: figures(fairing.borders.expected_vertices(s.points, s.outside))),
    "feather_weights": Row(
        ball, lambda s: [("plain", every(s), fairing.feather_weights(s.points, s.inside, s.outside, 0.3))]
    ),
    "flipped_triangles": Row(
        ball, lambda s: [("triangles", None, fairing.looks.flipped_triangles(rough_part(s)[1], s.faces))]
    ),
    "girth": Row(tube, girth),
    "hard_edges": Row(box, lambda s: [("vertices", None, fairing.hard_edges(s.points, s.faces))]),
    "hierarchy": Row(ball, lambda s: figures(len(fairing.hierarchy(s.points, s.inside, fixed=s.rim)))),
    "hole_loops": Row(ball, loops_of),
    "interpolate": Row(
        ball, lambda s: [("points", every(s), fairing.maps.interpolate(s.points, s.faces, s.rim, s.points[s.rim]))]
    ),
    "judged": Row(box, judged),
    "mean_curvature": Row(
        ball, lambda s: [("curvatures", every(s), fairing.mean_curvature(s.points, s.faces))], 1e-7
    ),
    "paired_quads": Row(ball, lambda s: figures(len(fairing.maps.paired_quads(s.points, s.faces).rest)), numbers=8.5),
    "self_intersections": Row(
        ball, lambda s: [("triangles", None, fairing.self_intersections(rough_part(s)[1], s.faces))]
    ),
    "surrounding_normals": Row(
        ball, lambda s: at_rim(s, fairing.surrounding_normals(s.points, s.outside, s.rim)), 1e-7
    ),
    "vertex_normals": Row(
        ball, lambda s: [("directions", every(s), fairing.vertex_normals(s.points, s.faces))], 1e-7
    ),
    "visible_join": Row(
        ball,
        lambda s: [
            ("plain", s.rim, fairing.looks.visible_join(rough_part(s)[1], s.inside, s.outside, s.rim).degrees),
        ], 1e-5,
    ),
}  # fmt: skip
