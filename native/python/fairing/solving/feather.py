"""``feather`` and ``weights``: vertices of a band around the patch move in part."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.measure import edges_with_uses, hard_edges
from fairing.options import arguments
from fairing.options.groups import Skin
from fairing.results import Diagnostic, FloatArray, IntArray, MeshError, Progress
from fairing.solving.surroundings import Answer, Boundary, Surroundings, boundary_normals, marked, with_join

Marks = npt.NDArray[np.bool_]
LEAST_RINGS = 6  # of triangles around a band that its low-pass surface rests on: half of what counts as detail


@dataclass(frozen=True)
class Band:
    """What moves, marks (n,): ``faired`` inside the patch, ``freed`` in the band only; ``held`` nowhere."""

    faired: Marks
    freed: Marks
    held: Marks
    weights: FloatArray


def is_wanted(skin: Skin, refused: dict[str, bool], count: int) -> bool:
    """Whether a change fades out, checked; ``refused``: arguments beside which it does not, if they are there."""
    if arguments.finite("feather", skin.feather) < 0.0:
        raise ValueError(f"feather: 0 or a positive number is needed, not {skin.feather!r}")
    if skin.weights is not None:
        weights = np.asarray(skin.weights, dtype=np.float64)
        if weights.shape != (count,) or not ((weights >= 0) & (weights <= 1)).all():
            raise ValueError(f"weights: {count} numbers from 0 to 1 are needed, one for each vertex")
        if skin.feather > 0.0:
            raise ValueError("feather: is not accepted beside `weights`, which take its place")
    elif skin.feather == 0.0:
        return False
    for name, given in refused.items():
        if given:
            raise ValueError(f"{name}: this value is not accepted with `feather` or `weights`; leave it out")
    return True


def solve_feathered(
    call: Callable[[Boundary], Answer], given: Boundary, around: Surroundings, skin: Skin,
    run: tuple[int, Progress | None],
) -> Answer:  # fmt: skip
    """Solve the patch, round its join with the surroundings, and let the change fade out.

    ``call`` puts back all of the detail. Vertices of the band move by what the rounding asks for, those inside by the
    whole change, both times their weights. ``run``: threads and progress.
    """
    if skin.weights is not None:
        weights = np.array(skin.weights, dtype=np.float64)
    elif not len(around.rim):
        raise ValueError(
            "feather: a band needs the triangles outside: pass them as `outside`, or among the triangles with all "
            "their vertices in `fixed`"
        )
    else:
        weights = _faded(given, around, skin.feather)
    band = _band(given, around, weights)
    answer = call(given)
    full, base = _rounded(answer, around, band, skin.detail_size, run)
    moving = (band.faired | band.freed) & (weights > 0.0)
    detail = answer["vertices"] - base
    for name, shown in (("vertices", skin.detail), ("base", 0.0)):
        there = full - (1.0 - shown) * detail
        moved = given.vertices + weights[:, None] * (there - given.vertices)
        answer[name] = np.where(moving[:, None], moved, given.vertices)
        answer[name].flags.writeable = False
    answer["moved"] = np.flatnonzero(band.freed).astype(np.int32)
    return with_join(answer, around)


def _rounded(
    answer: Answer, around: Surroundings, band: Band, detail_size: float, run: tuple[int, Progress | None]
) -> tuple[FloatArray, FloatArray]:
    """The faired mesh (n, 3), its detail included, with round joins; and its base without that.

    Patches whose bands meet are rounded together, with what lies around them. MeshError where nothing would stay.
    """
    points, (threads, progress) = answer["vertices"], run
    full, base = points.copy(), np.where(band.faired[:, None], answer["base"], points)
    ask = None if progress is None else lambda *_: progress(1.0, "detail")  # nearly all is done
    for inside, outside, fixed in _parts(len(points), around, band):
        diameter, width = _sizes(points, inside, outside, band.weights)
        triangles, sizes = np.concatenate([inside, outside]), (detail_size, diameter, width)
        fair, soft = _core.soft_base(points, triangles, fixed, answer["base"], band.faired, sizes, threads, ask)
        near = _core.feather_weights(points, outside, inside, width, fixed[:0])
        free = np.setdiff1d(triangles, fixed)
        base[free] = fair[free]
        full[free] += near[free, None] * (soft - fair)[free]
    return full, base


def feather_weights(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    outside: npt.ArrayLike,
    feather: float,
    *,
    fixed: npt.ArrayLike | None = None,
    creases: npt.ArrayLike | None = None,
) -> FloatArray:
    """Return the ``weights`` (n,) that ``feather`` stands for in :func:`fairing.fair`, to be changed by hand.

    1 inside, 1 − s² (3 − 2 s) in the band, s the distance from the boundary over the width, 0 beyond, and on hard edges
    outside, at which the band ends (:func:`fairing.hard_edges`); ``creases``: (c, 2) edges that are hard whatever they
    bend. The arguments are those of :func:`fairing.fair`; ``feather`` is above 0.
    """
    points, faces, held = arguments.held_mesh(vertices, triangles, fixed)
    share = arguments.positive("feather", feather)
    around = Surroundings.of(points, faces, held, outside)
    edges = arguments.vertices_of("creases", creases, len(points), 2)
    return _faded(Boundary(points, held, None), around, share, edges)


def _hard(points: FloatArray, around: Surroundings, creases: IntArray) -> Marks:
    """Vertices at which bands end: on hard edges outside, and where the boundary is one that belongs to the patch."""
    outside = hard_edges(points, around.outside, marked=creases)
    own = boundary_normals(points, around.inside, around.rim, outside=around.outside, creases=creases)
    return marked(np.append(outside, around.rim[own.from_inside]), len(points))


def _faded(given: Boundary, around: Surroundings, share: float, creases: IntArray = arguments.NO_EDGES) -> FloatArray:
    """Weights of bands, each as wide as its component asks for."""
    points = given.vertices
    hard = _hard(points, around, creases)
    stops = np.flatnonzero(hard).astype(np.int32)
    component = _core.components(around.inside, given.fixed, len(points))
    weights = marked(around.inside, len(points)).astype(np.float64)
    for number in range(component.max(initial=-1) + 1):
        inside = around.inside[component == number]
        rim = points[np.intersect1d(inside, around.rim)]
        if len(rim):
            faded = _core.feather_weights(points, inside, around.outside, share * _diameter(rim), stops)
            np.maximum(weights, faded, out=weights)
    return np.where(hard, 0.0, weights)


def _band(given: Boundary, around: Surroundings, weights: FloatArray) -> Band:
    """Free the vertices of the triangles outside that have a weight.

    Those on the mesh border or at edges with more than two triangles stay, as do pins and curves inside the patch, and
    hard edges at which the band ends.
    """
    count = len(weights)
    inside, beyond = marked(around.inside, count), marked(around.outside, count)
    fixed = marked(around.rim if given.fixed is None else given.fixed, count)
    edges, uses = edges_with_uses(np.concatenate([around.inside, around.outside]))
    ends = _hard(given.vertices, around, arguments.NO_EDGES) & (weights == 0.0)
    held = marked(edges[uses != 2], count) | (fixed & ~beyond) | ends
    return Band(inside & ~fixed & ~held, beyond & (weights > 0.0) & ~held, held, weights)


def _parts(count: int, around: Surroundings, band: Band) -> Iterator[tuple[IntArray, IntArray, IntArray]]:
    """Patches whose bands meet: triangles inside, triangles around them, and vertices that stay.

    On a closed mesh that is all near, vertices without a weight stay.
    """
    near = _around_band(around, band)
    both = np.concatenate([around.inside, around.outside[near]])
    stays = band.held | marked(around.outside[~near], count)
    component = _core.components(both, np.flatnonzero(stays & marked(both, count)).astype(np.int32), count)
    is_inside = np.arange(len(both)) < len(around.inside)
    for number in range(component.max(initial=-1) + 1):
        inside, outside = both[(component == number) & is_inside], both[(component == number) & ~is_inside]
        if not len(inside) or not band.freed[outside].any():
            continue
        own = np.union1d(inside, outside)
        fixed = own[stays[own]] if stays[own].any() else own[~(band.faired | band.freed)[own]]
        if not len(fixed):
            text = "feather: the band covers all that lies around the patch, so nothing stays: make it narrower"
            raise MeshError(Diagnostic("NO_BOUNDARY", text, np.unique(inside).astype(np.int32), "vertex", {}))
        yield inside, outside, fixed.astype(np.int32)


def _around_band(around: Surroundings, band: Band) -> Marks:
    """Marks (o,) of the triangles outside in the band, and in as many rings beyond, LEAST_RINGS or more."""
    count, outside = len(band.weights), around.outside

    def grown(marks: Marks) -> Marks:
        return marks | marked(outside[marks[outside].any(axis=1)], count)

    reached, rings = marked(around.rim, count), 0
    left = int((band.freed & ~reached).sum())
    while left:
        reached = grown(reached)
        before, left = left, int((band.freed & ~reached).sum())
        if left == before:
            break
        rings += 1
    reached |= band.freed
    for _ in range(max(rings, LEAST_RINGS)):
        reached = grown(reached)
    return np.asarray(reached[outside].all(axis=1))


def _sizes(points: FloatArray, inside: IntArray, outside: IntArray, weights: FloatArray) -> tuple[float, float]:
    """D of the triangles inside, and the mean width of the band around them."""
    edges, uses = edges_with_uses(inside)
    rim = edges[(uses == 1) & marked(outside, len(points))[edges].all(axis=1)]
    length = np.linalg.norm(points[rim[:, 0]] - points[rim[:, 1]], axis=1).sum()
    corners = points[outside]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2.0
    width = 2.0 * float((areas * weights[outside].mean(axis=1)).sum() / length)
    return _diameter(points[np.unique(rim)]), width


def _diameter(boundary: FloatArray) -> float:
    """D of a patch with this boundary (k, 3)."""
    return 2.0 * float(np.linalg.norm(boundary - boundary.mean(axis=0), axis=1).max())
