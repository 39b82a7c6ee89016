"""Outlines that grow until a fillet fits."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing.looks import LIMITS
from fairing.measure import boundary_loops
from fairing.options import arguments
from fairing.options.groups import Boundary, Options
from fairing.results import FOLDS, FairResult, FloatArray, IntArray
from fairing.solving.fair import fair
from fairing.solving.outline import bad_outline, surrounding_normals

Mask = npt.NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class GrownOutline:
    """What :func:`grown_outline` gives back."""

    selected: Mask
    """(m,) the triangles of the round that was kept; read-only."""
    result: FairResult
    """Of fairing them."""
    round: int
    """Which one was kept; 0: the selection as it was given."""
    angles: tuple[float, ...]
    """Largest ``boundary_angle`` of each round, degrees."""
    joins: tuple[float, ...]
    """Largest ``join`` of each round, degrees."""


@dataclass(frozen=True)
class _Mesh:
    """vertices (n, 3), triangles (m, 3), and faces (m,): the polygon of each triangle."""

    vertices: FloatArray
    triangles: IntArray
    faces: npt.NDArray[Any]

    def outline(self, selected: Mask) -> IntArray:
        """Border vertices of the selected triangles that others touch, too."""
        loops = boundary_loops(self.triangles[selected])
        border = np.concatenate([np.empty(0, np.int32), *loops])
        outline: IntArray = np.intersect1d(border, self.triangles[~selected]).astype(np.int32)
        return outline

    def grown(self, selected: Mask) -> Mask | None:
        """With the faces at the boundary's bad vertices; None where there are none, or the boundary would differ."""
        bad = bad_outline(self.vertices, self.triangles[~selected], self.outline(selected))
        touched = np.isin(self.triangles, bad).any(axis=1) & ~selected
        result = selected | np.isin(self.faces, self.faces[touched])
        if not len(bad) or result.all():
            return None
        loops = [len(boundary_loops(self.triangles[chosen])) for chosen in (selected, result)]
        return result if loops[1] <= loops[0] else None

    def faired(self, selected: Mask, options: dict[str, Any]) -> FairResult:
        """With the normals of the surroundings."""
        chosen = dict(options)
        threads, progress = chosen.pop("threads", 0), chosen.pop("progress", None)
        inside, outside = self.triangles[selected], self.triangles[~selected]
        outline = self.outline(selected)
        normals = surrounding_normals(self.vertices, outside, outline).normals
        known = np.linalg.norm(normals, axis=1) > 0
        boundary = Boundary(outline[known], normals[known], outside=outside)
        return fair(self.vertices, inside, boundary, Options.of(**chosen), threads=threads, progress=progress)


def grown_outline(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    selected: npt.ArrayLike,
    *,
    faces: npt.ArrayLike | None = None,
    rounds: int = 3,
    **options: Any,
) -> GrownOutline:
    """Fair a selection, and larger ones that leave the bad vertices of its boundary inside; keep the best.

    Each round adds the faces outside the vertices that :func:`bad_outline` names, as long as there are some and no new
    outline comes of it. Kept is the round that converges, has no folds, shows no kink (``join`` above
    ``LIMITS["visible_kink"]``) sharper than the worst of the selection as given, and has the smallest largest
    ``boundary_angle``, in this order.

    triangles (m, 3): the whole mesh; selected (m,) bool; faces (m,): the polygon of each triangle, none of which is
    divided; rounds: three at most are useful; options: those of :func:`fairing.fair` that don't concern the boundary.
    """
    points = arguments.floats("vertices", vertices)
    whole = arguments.triangles_within(triangles, points.shape[0])
    chosen = _mask(selected, whole.shape[0])
    owners = np.arange(whole.shape[0]) if faces is None else arguments.integers("faces", faces, None)
    if owners.shape != chosen.shape:
        raise ValueError(f"faces: {whole.shape[0]} entries are needed, not {owners.shape[0]}")
    mesh = _Mesh(points, whole, owners)
    tried = [(chosen, mesh.faired(chosen, options))]
    for _ in range(arguments.whole("rounds", rounds, 0)):
        larger = mesh.grown(tried[-1][0])
        if larger is None:
            break
        tried.append((larger, mesh.faired(larger, options)))
    results = [result for _, result in tried]
    best = best_round(results)
    kept = tried[best][0]
    kept.flags.writeable = False
    angles, joins = (tuple(map(measure, results)) for measure in (_largest_angle, _largest_join))
    return GrownOutline(kept, results[best], best, angles, joins)


def best_round(results: Sequence[FairResult]) -> int:
    """Which of the rounds is kept, the first being that of the selection as it was given."""
    seen = max(_largest_join(results[0]), LIMITS["visible_kink"])

    def rank(k: int) -> tuple[bool, bool, bool, float]:
        result = results[k]
        return not result.converged, _folded(result), _largest_join(result) > seen, _largest_angle(result)

    return min(range(len(results)), key=rank)


def _largest_angle(result: FairResult) -> float:
    return float(result.boundary_angle.max(initial=0.0))


def _largest_join(result: FairResult) -> float:
    return float(result.join.max(initial=0.0))


def _folded(result: FairResult) -> bool:
    return any(warning.code in FOLDS for warning in result.warnings)


def _mask(selected: npt.ArrayLike, count: int) -> Mask:
    array = np.array(selected)
    if array.dtype.kind != "b" or array.shape != (count,):
        raise ValueError(f"selected: {count} booleans are needed, one for each triangle")
    if array.all() or not array.any():
        raise ValueError("selected: some triangles, and not all, are needed")
    return array
