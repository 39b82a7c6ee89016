"""Selections whose boundary is a hard edge: one click leaves the top of a box flat, and the report names the rule."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

import meshes

INSIDE = "The boundary is a hard edge all along: the surface does not go on with the slope outside"


def boss_on_box(quads: int = 1, sides: int = 16) -> tuple[bpy.types.Object, meshes.Mask]:
    """A box [−1, 1]³ of so many quads along an edge with a round boss on its top; that and the whole top are selected.

    An undivided top has four n-gons around the boss, a finer one quads and a square dent with steep sides for a boss.
    """
    if quads == 1:
        turns = 2 * np.pi * np.arange(sides) / sides
        ring = 0.4 * np.column_stack([np.cos(turns), np.sin(turns)])
        corners = np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)], dtype=float)
        points = np.concatenate([
            np.column_stack([corners, np.full(4, 1.0)]), np.column_stack([corners, np.full(4, -1.0)]),
            np.column_stack([ring, np.full(sides, 1.0)]), np.column_stack([ring, np.full(sides, 1.5)]),
        ])  # fmt: skip
        low, quarter = 8 + np.arange(sides), sides // 4
        faces = [[4, 7, 6, 5], *([c, 4 + c, 4 + (c + 1) % 4, (c + 1) % 4] for c in range(4))]
        for c in range(4):
            arc = [int(low[(quarter * c + quarter // 2 + k) % sides]) for k in range(quarter + 1)]
            faces.append([c, (c + 1) % 4, *arc[::-1]])
        after = np.roll(low, -1)
        faces += [[int(a), int(b), int(b) + sides, int(a) + sides] for a, b in zip(low, after, strict=True)]
        faces.append([int(v) + sides for v in low])
        return meshes.add(points, faces, "Boss"), np.arange(len(faces)) >= 5
    obj, faces = _fine_box(quads)
    points = meshes.positions(obj)
    points[np.isclose(points[:, 2], 1.0) & (np.abs(points[:, :2]).max(axis=1) < 0.45), 2] += 0.5
    meshes.move(obj, points)
    return obj, faces


def _fine_box(quads: int) -> tuple[bpy.types.Object, meshes.Mask]:
    numbers: dict[tuple[int, ...], int] = {}
    faces = []
    for axis in range(3):
        for side in (0, quads):
            for i in range(quads):
                for j in range(quads):
                    loop = []
                    for u, v in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                        place = [0, 0, 0]
                        place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3] = side, u, v
                        loop.append(numbers.setdefault(tuple(place), len(numbers)))
                    faces.append(loop if side else loop[::-1])
    obj = meshes.add(2.0 * np.array(list(numbers)) / quads - 1.0, faces, "Box")
    return obj, meshes.faces_where(obj, lambda c: c.z > 0.99)


@pytest.mark.parametrize("quads", [1, 16])
def test_one_click_leaves_the_top_of_a_box_flat(quads: int) -> None:
    obj, faces = boss_on_box(quads)
    free = meshes.free_vertices(obj, faces)
    assert np.ptp(meshes.positions(obj)[free, 2]) > 0.4
    assert meshes.fair(obj, faces) == {"FINISHED"}
    assert np.abs(meshes.positions(obj)[free, 2] - 1.0).max() < 1e-6
    report = meshes.report()
    assert report.verdict == "GOOD"
    assert INSIDE in report.warnings
