"""Gaussian and principal curvatures at vertices. Arrays in, arrays out."""

from __future__ import annotations

import numpy as np

from ..arrays.types import Floats, Ints


def gaussian_curvature(positions: Floats, triangles: Ints, normals: Floats) -> Floats:
    """Return K (n,) in 1 / length², positive on spheres, negative on saddles.

    positions (n, 3), triangles (t, 3), normals (n, 3) unit. In each triangle the symmetric S with S e = Δn for its
    three edges, by least squares (Rusinkiewicz 2004, Estimating curvatures and their derivatives on triangle meshes);
    K is det S, averaged at vertices by area. 0 where a vertex has no triangle with an area.
    """
    corners, turned = positions[triangles], normals[triangles]
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    double = np.linalg.norm(cross, axis=1)
    whole = double > 0.0
    corners, turned, used = corners[whole], turned[whole], triangles[whole]
    u = corners[:, 1] - corners[:, 0]
    u /= np.linalg.norm(u, axis=1)[:, None]
    frame = np.stack([u, np.cross(cross[whole] / double[whole, None], u)], axis=1)  # (t, 2, 3)
    edges, turns = (
        np.einsum("tkx,tix->tik", frame, np.roll(values, -1, axis=1) - values) for values in (corners, turned)
    )
    det = _determinants(edges, turns)
    weights = np.repeat(double[whole], 3)
    areas = np.bincount(used.ravel(), weights=weights, minlength=len(positions))
    sums = np.bincount(used.ravel(), weights=weights * np.repeat(det, 3), minlength=len(positions))
    found: Floats = np.divide(sums, areas, out=np.zeros(len(positions)), where=areas > 0.0)
    return found


def _determinants(edges: Floats, turns: Floats) -> Floats:
    """Return det S (t,) of the symmetric S (a, b; b, c) with S e = Δn, least squares; both (t, 3, 2) in the plane."""
    x, y = edges[..., 0], edges[..., 1]
    zero = np.zeros_like(x)
    rows = np.concatenate([np.stack([x, y, zero], axis=2), np.stack([zero, x, y], axis=2)], axis=1)  # (t, 6, 3)
    sides = np.concatenate([turns[..., 0], turns[..., 1]], axis=1)  # (t, 6)
    square = np.einsum("tij,tik->tjk", rows, rows)
    square += 1e-14 * np.trace(square, axis1=1, axis2=2)[:, None, None] * np.eye(3)  # triangles that are all but lines
    a, b, c = np.linalg.solve(square, np.einsum("tij,ti->tj", rows, sides)[..., None])[..., 0].T
    det: Floats = a * c - b * b
    return det


def largest_principal(mean: Floats, gaussian: Floats) -> Floats:
    """Return that of both principal curvatures which bends more (n,), with the sign of H: negative where convex."""
    apart = np.sqrt(np.maximum(mean**2 - gaussian, 0.0))
    found: Floats = mean + np.where(mean < 0.0, -apart, apart)
    return found
