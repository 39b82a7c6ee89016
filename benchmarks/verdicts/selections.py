"""What an artist would select: discs around a place, tips, bands, what is near a seam, as a lasso would leave them."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components, dijkstra

from scenes import Ints, Mask, Scene, neighbours, normals


def _graph(scene: Scene) -> Any:
    ends = neighbours(scene)
    lengths = np.linalg.norm(np.diff(scene.vertices[ends], axis=1)[:, 0], axis=1).clip(1e-12)
    return coo_array((lengths, (ends[:, 0], ends[:, 1])), shape=(len(scene.vertices),) * 2).tocsr()


def within(scene: Scene, vertices: Mask) -> Mask:
    """The faces with all corners in the mask."""
    return np.array([bool(vertices[face].all()) for face in scene.faces])


def centres(scene: Scene) -> Any:
    """The faces' centres (f, 3)."""
    return np.array([scene.vertices[face].mean(axis=0) for face in scene.faces])


def disc(scene: Scene, seed: int, radius: float) -> Mask:
    """The faces within a radius along edges."""
    away = dijkstra(_graph(scene), directed=False, indices=seed, limit=radius)
    return tidy(scene, within(scene, np.isfinite(away)), seed)


def tidy(scene: Scene, chosen: Mask, seed: int) -> Mask:
    """The piece at the seed, with small holes filled, as a person would leave it."""
    chosen = chosen.copy()
    parted = _pieces(scene, ~chosen)
    sizes = np.bincount(parted[parted >= 0], minlength=1)
    small = (parted >= 0) & (sizes[parted.clip(0)] < 0.2 * len(scene.faces)) & (sizes[parted.clip(0)] < sizes.max())
    chosen |= small & (sizes[parted.clip(0)] < 0.3 * max(int(chosen.sum()), 1))
    pieces = _pieces(scene, chosen)
    at_seed = [pieces[k] for k, face in enumerate(scene.faces) if seed in face and chosen[k]]
    return pieces == at_seed[0] if at_seed else chosen


def _pieces(scene: Scene, chosen: Mask) -> Ints:
    """(f,) the number of the piece, joined by edges, that each chosen face is in; −1 elsewhere."""
    places = np.flatnonzero(chosen)
    owner = np.repeat(places, [len(scene.faces[k]) for k in places])
    ends = np.array(
        [
            sorted((a, b))
            for k in places
            for a, b in zip(scene.faces[k], scene.faces[k][1:] + scene.faces[k][:1], strict=True)
        ]
    ).reshape(-1, 2)
    _, edge = np.unique(ends, axis=0, return_inverse=True)
    count = len(scene.faces)
    joined = coo_array((np.ones(len(owner)), (owner, count + edge.ravel())), shape=(count + len(owner),) * 2)
    labels = connected_components(joined, directed=False)[1][:count]
    found = np.full(count, -1)
    found[places] = np.unique(labels[places], return_inverse=True)[1]
    return found


def extent(scene: Scene) -> float:
    """The largest side of its box."""
    return float(np.ptp(scene.vertices, axis=0).max())


def anywhere(scene: Scene, rng: Any, low: float, high: float) -> Mask:
    """A disc of a random size, in shares of the extent, at a random place."""
    for _ in range(60):
        seed = int(rng.integers(len(scene.vertices)))
        chosen = disc(scene, seed, extent(scene) * rng.uniform(low, high))
        if 12 <= int(chosen.sum()) <= 12_000 and chosen.sum() < 0.4 * len(chosen):
            return chosen
    raise RuntimeError("no disc of that size was found")


def tip(scene: Scene, rng: Any, low: float, high: float) -> Mask:
    """A disc around one of the most prominent tips: an ear, a nose, a finger."""
    graph = _graph(scene)
    sample = rng.integers(len(scene.vertices), size=80)
    out = normals(scene)
    radius = extent(scene) * rng.uniform(low, high)
    best, prominence = int(sample[0]), -np.inf
    for seed in sample.tolist():
        near = np.linalg.norm(scene.vertices - scene.vertices[seed], axis=1) < radius
        height = float(-((scene.vertices[near] - scene.vertices[seed]) @ out[seed]).mean()) * rng.uniform(0.6, 1.0)
        if height > prominence:
            best, prominence = seed, height
    for share in (1.0, 0.75, 0.5):
        away = dijkstra(graph, directed=False, indices=best, limit=share * radius)
        chosen = tidy(scene, within(scene, np.isfinite(away)), best)
        if chosen.sum() < 0.35 * len(chosen):
            return chosen
    return chosen


def band(scene: Scene, rng: Any, axis: int, middle: float, width: float) -> Mask:
    """The faces between two planes across an axis, one piece of them."""
    places = centres(scene)[:, axis]
    chosen = np.abs(places - middle) < 0.5 * width
    pieces = _pieces(scene, chosen)
    piece = int(rng.choice(np.unique(pieces[pieces >= 0])))
    return pieces == piece


def ball(scene: Scene, at: Any, radius: float) -> Mask:
    """The faces whose centres are within a ball."""
    return np.asarray(np.linalg.norm(centres(scene) - np.asarray(at), axis=1) < radius)


def seam_band(scene: Scene, first: Any, width: float) -> Mask:
    """The faces within a distance of the seam of a union; first: (n,) which vertices are the first solid's alone."""
    ends = neighbours(scene)
    across = first[ends[:, 0]] != first[ends[:, 1]]
    seam = scene.vertices[np.unique(ends[across])]
    from scipy.spatial import cKDTree

    return np.asarray(cKDTree(seam).query(centres(scene))[0] < width)


def ragged(chosen: Mask, rng: Any, scene: Scene, share: float) -> Mask:
    """A selection whose boundary has teeth: some of the faces at it are left out, others taken in."""
    inside = np.zeros(len(scene.vertices), dtype=bool)
    outside = inside.copy()
    for face, taken in zip(scene.faces, chosen, strict=True):
        (inside if taken else outside)[face] = True
    rim = inside & outside
    at_rim = np.array([bool(rim[face].any()) for face in scene.faces])
    return np.asarray(chosen ^ (at_rim & (rng.random(len(chosen)) < share)))


def border(scene: Scene, deleted: Mask) -> tuple[Scene, Ints]:
    """The mesh without these faces and what hung on them, and the vertices of the hole's border in it."""
    kept = [face for face, gone in zip(scene.faces, deleted, strict=True) if not gone]
    lost = np.unique(np.concatenate([face for face, gone in zip(scene.faces, deleted, strict=True) if gone]))
    used = np.unique(np.concatenate([np.asarray(face) for face in kept]))
    number = np.full(len(scene.vertices), -1)
    number[used] = np.arange(len(used))
    rim = number[np.intersect1d(lost, used)]
    sharp = number[scene.sharp]
    sharp = sharp[(sharp >= 0).all(axis=1)] if len(sharp) else sharp
    return Scene(scene.vertices[used], [number[face].tolist() for face in kept], sharp), rim
