"""Quads in rows: which triangles are halves of one."""

from __future__ import annotations

import numpy as np

from fairing.results import FloatArray, IntArray, PairedQuads, read_only

FACES = ("triangles", "quads")


def halves_of(points: FloatArray, quads: IntArray) -> IntArray:
    """(2 q, 3) the first triangles of all quads, then the second ones."""
    turned = _turned(points, quads)
    halves: IntArray = np.concatenate([turned[:, [0, 1, 3]], turned[:, [2, 3, 1]]])
    return halves


def _turned(points: FloatArray, quads: IntArray) -> IntArray:
    """Quads that begin so that the diagonal from corner 1 to corner 3 is the shorter one."""
    corners = points[quads]
    lengths = np.linalg.norm(corners[:, [0, 1]] - corners[:, [2, 3]], axis=2)
    is_shorter = lengths[:, 0] < (1 - 1e-6) * lengths[:, 1]
    result: IntArray = np.where(is_shorter[:, None], np.roll(quads, -1, axis=1), quads)
    return result


def quads_of(triangles: IntArray, pairs: IntArray) -> PairedQuads:
    """The faces that pairs of triangles make."""
    first, second = triangles[pairs[:, 0]], triangles[pairs[:, 1]]
    begin = (first[:, :, None] != second[:, None, :]).all(axis=2).argmax(axis=1)
    end = (second[:, :, None] != first[:, None, :]).all(axis=2).argmax(axis=1)
    row = np.arange(len(pairs))
    at = [first[row, begin], first[row, (begin + 1) % 3], second[row, end], first[row, (begin + 2) % 3]]
    rest = np.setdiff1d(np.arange(len(triangles), dtype=np.int32), pairs)
    quads = np.stack(at, axis=1).astype(np.int32).reshape(-1, 4)
    return PairedQuads(*(read_only(each) for each in (quads, triangles[rest], pairs, rest)))
