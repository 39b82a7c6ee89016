"""Contact sheets for judging: before, after and reflections after, from two sides, without a word of the verdict."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from picture_sheet import Panel, save_sheet
from rasteriser import View, rasterise

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
SIZE, ROWS = 258, 6
SEEN = 2.1  # widths of a selection that a tile shows
SMOOTH = 35.0  # degrees up to which faces are shaded as one
STRIPES = 14.0
CHOSEN, PLAIN, BEHIND = (0.95, 0.66, 0.35), (0.78, 0.78, 0.8), (0.75, 0.25, 0.25)
LIGHTS = (((-0.5, 0.6, 0.62), 0.75), ((0.8, 0.1, 0.55), 0.3), ((0.1, -0.9, 0.4), 0.15))


def corner_normals(vertices: Floats, triangles: Ints) -> Floats:
    """(m, 3, 3): smooth over edges that are flatter than SMOOTH, split at others."""
    areas = np.cross(
        vertices[triangles[:, 1]] - vertices[triangles[:, 0]], vertices[triangles[:, 2]] - vertices[triangles[:, 0]]
    )
    unit = areas / np.linalg.norm(areas, axis=1)[:, None].clip(1e-300)
    corners = triangles.ravel()
    order = np.argsort(corners, kind="stable")
    counts = np.bincount(corners, minlength=len(vertices))
    starts = np.concatenate([[0], np.cumsum(counts)[:-1]])
    repeats = counts[corners]
    own = np.repeat(np.arange(len(corners)), repeats)
    step = np.arange(len(own)) - np.repeat(np.cumsum(repeats) - repeats, repeats)
    other = order[starts[corners[own]] + step] // 3
    alike = (unit[own // 3] * unit[other]).sum(axis=1) > np.cos(np.radians(SMOOTH))
    sums = np.zeros((len(corners), 3))
    np.add.at(sums, own[alike], areas[other[alike]])
    return np.asarray((sums / np.linalg.norm(sums, axis=1)[:, None].clip(1e-300)).reshape(-1, 3, 3))


def views(points: Floats, areas: Floats) -> list[View]:
    """From where most of the selection is seen, and across."""
    mean = areas.sum(axis=0) / np.linalg.norm(areas, axis=1).sum()
    low, high = points.min(axis=0), points.max(axis=0)
    centre = 0.5 * (low + high)
    axes = np.linalg.svd(points[:: max(1, len(points) // 3000)] - centre, full_matrices=False)[2]
    front = mean / np.linalg.norm(mean) if np.linalg.norm(mean) > 0.2 else axes[2] + 0.2 * axes[1]
    along = axes[0] if abs(axes[0] @ front) < 0.9 * np.linalg.norm(front) else axes[1]
    side = np.cross(front, along) + 0.45 * front
    width = SEEN * float(np.linalg.norm(points - centre, axis=1).max())
    target = (float(centre[0]), float(centre[1]), float(centre[2]))
    return [View(target, tuple(view), width, tuple(along)) for view in (front + 0.25 * side, side)]


def tiles(vertices: Floats, triangles: Ints, chosen: NDArray[np.bool_], view: View) -> list[Floats]:
    """Shaded with the selection tinted, and the reflections, each (SIZE, SIZE, 3) in 0 … 1."""
    near = np.linalg.norm(vertices - np.asarray(view.target), axis=1) < 1.2 * view.width
    kept = near[triangles].any(axis=1)
    triangles, chosen = triangles[kept], chosen[kept]
    shaded, striped = np.ones((SIZE, SIZE, 3)), np.ones((SIZE, SIZE, 3))
    if not len(triangles) or not np.isfinite(vertices[triangles]).all():
        return [shaded, striped]
    seen = rasterise(view.project(vertices, SIZE), triangles, (SIZE, SIZE))
    which, weights = seen.triangle[seen.covered], seen.weights[seen.covered]
    normals = np.einsum("pk,pkd->pd", weights, corner_normals(vertices, triangles)[which]) @ view.axes.T
    normals /= np.linalg.norm(normals, axis=1)[:, None].clip(1e-12)
    back = normals[:, 2] < 0
    light = 0.18 + sum(share * (normals @ np.array(direction)).clip(0) for direction, share in LIGHTS)
    shine = (normals @ (np.array([-0.25, 0.3, 0.92]))).clip(0) ** 60 * 0.35
    colours = np.where(chosen[which][:, None], CHOSEN, PLAIN) * light[:, None] + shine[:, None]
    shaded[seen.covered] = np.where(back[:, None], BEHIND, colours)
    bands = np.where(np.sin(STRIPES * np.arcsin(normals[:, 1].clip(-1, 1))) > 0, 1.0, 0.25)
    striped[seen.covered] = np.where(back[:, None], BEHIND, bands[:, None] * (0.55 + 0.45 * normals[:, 2:].clip(0)))
    return [shaded, striped]


def row(name: str, data: Any) -> Panel:
    """Before, after, reflections from the front; then from the side."""
    before, triangles, chosen = data["before"], data["triangles"], data["chosen"]
    if "old" in data:
        points, areas = data["old"], data["old_chosen"]
    else:
        corners = before[triangles[chosen]] if chosen.any() else _new(data)
        points, areas = corners.reshape(-1, 3), np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    plain = np.zeros(len(data["after_triangles"]), dtype=bool)
    pictures = []
    for view in views(points, areas):
        pictures += [
            tiles(before, triangles, chosen, view)[0],
            *tiles(data["after"], data["after_triangles"], plain, view),
        ]
    free = len(np.unique(triangles[chosen])) if chosen.any() else 0
    refused = " REFUSED" if "refusal" in data else ""
    return np.hstack(pictures), f"{name} {data['options']} {free} vertices{refused}"


def _new(data: Any) -> Floats:
    """The corners of what was added to an open mesh, or of all of it."""
    count = len(data["before"])
    added = (data["after_triangles"] >= count).any(axis=1)
    shown = data["after_triangles"][added] if added.any() else data["after_triangles"]
    return np.asarray(data["after"][shown])


def save(names: list[str], results: Path, folder: Path) -> None:
    """Write sheets of ROWS jobs each, but for those that are there and newer than their jobs."""
    folder.mkdir(parents=True, exist_ok=True)
    for first in range(0, len(names), ROWS):
        path = folder / f"sheet_{first // ROWS:02d}.png"
        there = [name for name in names[first : first + ROWS] if (results / f"{name}.npz").exists()]
        newest = max(((results / f"{name}.npz").stat().st_mtime for name in there), default=0.0)
        if not there or (path.exists() and path.stat().st_mtime > newest):
            continue
        rows = []
        for name in there:
            with np.load(results / f"{name}.npz") as data:
                rows.append([row(name, data)])
        save_sheet(rows, path)
