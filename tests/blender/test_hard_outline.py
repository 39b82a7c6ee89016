"""Selections whose boundary is a hard edge: one click leaves the top of a box flat, and the report names the rule."""

import bpy
import numpy as np

import meshes

INSIDE = "The boundary is a hard edge all along: the surface does not go on with the slope outside"


def boss_on_box(sides: int = 16) -> tuple[bpy.types.Object, meshes.Mask]:
    """A box [−1, 1]³ with a round boss on its top, four n-gons around it; that and the whole top are selected."""
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


def test_one_click_leaves_the_top_of_a_box_flat() -> None:
    obj, faces = boss_on_box()
    free = meshes.free_vertices(obj, faces)
    assert np.ptp(meshes.positions(obj)[free, 2]) > 0.4
    assert meshes.fair(obj, faces) == {"FINISHED"}
    assert np.abs(meshes.positions(obj)[free, 2] - 1.0).max() < 1e-6
    report = meshes.report()
    assert report.verdict == "GOOD"
    assert INSIDE in report.warnings
