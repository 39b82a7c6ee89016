"""``feather`` and ``weights``: vertices of a band around the patch move in part."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.measure import edges_with_uses, hard_edges
from fairing.options import arguments
from fairing.options.groups import Skin
from fairing.results import Diagnostic, FloatArray, IntArray, MeshError, Progress
from fairing.solving import surroundings
from fairing.solving.slopes import boundary_normals
from fairing.solving.surroundings import Answer, Boundary, Surroundings, marked

Marks = npt.NDArray[np.bool_]
Call = Callable[[Boundary], Answer]
LEAST_RINGS = 6  # of triangles around a band that its low-pass surface rests on: half of what counts as detail


@dataclass(frozen=True)
class Fade:
    """How a change fades out.

    detail: the part of it that is shown; detail_size: what counts as detail, a share of D, 0: chosen; how: the width of
    the band as a share of D, or the weights (n,) themselves.
    """

    detail: float
    detail_size: float
    how: float | FloatArray
    threads: int
    progress: Progress | None


@dataclass(frozen=True)
class Band:
    """What moves, marks (n,): ``faired`` inside the patch, ``freed`` in the band only; ``held`` nowhere."""

    faired: Marks
    freed: Marks
    held: Marks
    weights: FloatArray


def fade_of(skin: Skin, refused: dict[str, bool], count: int, threads: int, progress: Any) -> Fade | None:
    """How a change fades out, checked; None where it does not.

    ``refused``: arguments beside which it does not, with whether they are there.
    """
    share = arguments.finite("feather", skin.feather)
    if share < 0.0:
        raise ValueError(f"feather: 0 or a positive number is needed, not {skin.feather!r}")
    if skin.weights is None and share == 0.0:
        return None
    weights = None if skin.weights is None else np.array(skin.weights, dtype=np.float64)
    if weights is not None and (weights.shape != (count,) or not ((weights >= 0) & (weights <= 1)).all()):
        raise ValueError(f"weights: {count} numbers from 0 to 1 are needed, one for each vertex")
    if weights is not None and share > 0.0:
        raise ValueError("feather: is not accepted beside `weights`, which take its place")
    for name, given in refused.items():
        if given:
            raise ValueError(f"{name}: this value is not accepted with `feather` or `weights`; leave it out")
    return Fade(skin.detail, skin.detail_size, share if weights is None else weights, threads, progress)


def solve_feathered(call: Call, given: Boundary, around: Surroundings, fade: Fade) -> Answer:
    """Solve the patch, round its join with the surroundings, and let the change fade out.

    ``call`` puts back all of the detail. Vertices of the band move by what the rounding asks for, those inside by the
    whole change, both times their weights.
    """
    if isinstance(fade.how, float) and not len(around.rim):
        raise ValueError(
            "feather: a band needs the triangles outside: pass them as `outside`, or among the triangles with all "
            "their vertices in `fixed`"
        )
    weights = _faded(given, around, fade.how) if isinstance(fade.how, float) else fade.how
    band = _band(given, around, weights)
    answer = call(given)
    full, base = _rounded(answer, around, band, fade)
    moving = (band.faired | band.freed) & (weights > 0.0)
    detail = answer["vertices"] - base
    for name, shown in (("vertices", fade.detail), ("base", 0.0)):
        there = full - (1.0 - shown) * detail
        moved = given.vertices + weights[:, None] * (there - given.vertices)
        answer[name] = np.where(moving[:, None], moved, given.vertices)
        answer[name].flags.writeable = False
    answer["moved"] = np.flatnonzero(band.freed).astype(np.int32)
    return surroundings.with_join(answer, around)


def _rounded(answer: Answer, around: Surroundings, band: Band, fade: Fade) -> tuple[FloatArray, FloatArray]:
    """The faired mesh (n, 3), its detail included, with round joins; and its base without that.

    Patches whose bands meet are rounded together, with what lies around them. MeshError where nothing would stay.
    """
    points = answer["vertices"]
    full, base = points.copy(), np.where(band.faired[:, None], answer["base"], points)
    ask = None if fade.progress is None else partial(_ask, fade.progress)
    for inside, outside, fixed in _parts(len(points), around, band):
        diameter, width = _sizes(points, inside, outside, band.weights)
        triangles, sizes = np.concatenate([inside, outside]), (fade.detail_size, diameter, width)
        fair, soft = _core.soft_base(points, triangles, fixed, answer["base"], band.faired, sizes, fade.threads, ask)
        near = _core.feather_weights(points, outside, inside, width, fixed[:0])
        free = np.setdiff1d(triangles, fixed)
        base[free] = fair[free]
        full[free] += near[free, None] * (soft - fair)[free]
    return full, base


def _ask(progress: Progress, _fraction: float, _stage: str) -> bool | None:
    """Whether to go on; nearly all is done."""
    return progress(1.0, "detail")


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


def _hard(points: FloatArray, around: Surroundings, creases: IntArray) -> IntArray:
    """Vertices at which bands end: on hard edges outside, and where the boundary is one that belongs to the patch."""
    outside = hard_edges(points, around.outside, marked=creases)
    own = boundary_normals(points, around.inside, around.rim, outside=around.outside, creases=creases)
    return np.union1d(outside, around.rim[own.from_inside]).astype(np.int32)


def _faded(given: Boundary, around: Surroundings, share: float, creases: IntArray = arguments.NO_EDGES) -> FloatArray:
    """Weights of bands, each as wide as its component asks for."""
    points = given.vertices
    stops = _hard(points, around, creases)
    component = _core.components(around.inside, given.fixed, len(points))
    weights = marked(around.inside, len(points)).astype(np.float64)
    for number in range(component.max(initial=-1) + 1):
        inside = around.inside[component == number]
        rim = points[np.intersect1d(inside, around.rim)]
        if len(rim):
            faded = _core.feather_weights(points, inside, around.outside, share * _diameter(rim), stops)
            np.maximum(weights, faded, out=weights)
    weights[stops] = 0.0
    return weights


def _band(given: Boundary, around: Surroundings, weights: FloatArray) -> Band:
    """Free the vertices of the triangles outside that have a weight.

    Those on the mesh border or at edges with more than two triangles stay, as do pins and curves inside the patch, and
    hard edges at which the band ends.
    """
    count = len(given.vertices)
    beyond = marked(around.outside, count)
    fixed = marked(around.rim if given.fixed is None else given.fixed, count)
    edges, uses = edges_with_uses(np.concatenate([around.inside, around.outside]))
    ends = marked(_hard(given.vertices, around, arguments.NO_EDGES), count) & (weights == 0.0)
    held = marked(edges[uses != 2], count) | (fixed & ~beyond) | ends
    return Band(marked(around.inside, count) & ~fixed & ~held, beyond & (weights > 0.0) & ~held, held, weights)


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
    reached = marked(around.rim, len(band.weights))
    left = band.freed & ~reached
    rings = 0
    while left.any():
        reached |= marked(around.outside[reached[around.outside].any(axis=1)], len(reached))
        if not (left & reached).any():
            break
        left &= ~reached
        rings += 1
    reached |= band.freed
    for _ in range(max(rings, LEAST_RINGS)):
        reached |= marked(around.outside[reached[around.outside].any(axis=1)], len(reached))
    return np.asarray(reached[around.outside].all(axis=1))


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
