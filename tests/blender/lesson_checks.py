"""What each lesson of docs/tutorial.md promises of its object, headless and in a window alike.

Needs scripts, scripts/studio and scripts/lessons on the path.
"""

from collections.abc import Callable

import bmesh
import bpy
import numpy as np

import lesson_scenes
import rivals
from rows import Points


def borders() -> int:
    """How many border loops the active mesh has, in object mode."""
    bm = bmesh.new()
    bm.from_mesh(bpy.context.object.data)
    rest, count = {edge for edge in bm.edges if edge.is_boundary}, 0
    while rest:
        count += 1
        front = [rest.pop()]
        while front:
            near = {edge for vertex in front.pop().verts for edge in vertex.link_edges} & rest
            rest -= near
            front += near
    bm.free()
    return count


def has_no_ear(before: Points, after: Points) -> None:
    """Nothing sticks out where the ear was."""
    assert before[:, 0].max() > 1.3
    assert after[:, 0].max() < 0.9


def has_no_dent(before: Points, after: Points) -> None:
    """The panel is the one that was dented."""

    def depth(points: Points) -> float:
        return float(np.abs(points[:, 2] - rivals.panel_height(points)).max())

    assert depth(before) > 0.08
    assert depth(after) < 2e-3


def has_no_holes(before: Points, after: Points) -> None:
    """All thirteen are filled."""
    assert lesson_scenes.HOLES == 13
    assert len(after) > len(before)
    assert borders() == 0


def has_a_fillet(_: Points, __: Points) -> None:
    """No edge of the seam is left."""
    bm = bmesh.new()
    bm.from_mesh(bpy.context.object.data)
    at_foot = [edge for edge in bm.edges if all(abs(v.co.z) < 0.15 and v.co.xy.length < 0.9 for v in edge.verts)]
    assert len(at_foot) > 500
    assert max(edge.calc_face_angle() for edge in at_foot) < np.radians(30.0)
    bm.free()


def is_an_elbow(before: Points, after: Points) -> None:
    """The new vertices lie on the torus that both pipes touch."""
    new = after[len(before) :]
    around = np.hypot(np.hypot(new[:, 0] - 1.0, new[:, 2] + 0.3) - 1.0, new[:, 1])
    assert borders() == 2
    assert len(new) > 300
    assert np.abs(around - 0.4).max() < 0.02


def has_pores_and_no_swelling(before: Points, after: Points) -> None:
    """What moved is as far from the middle, and as rough, as what did not."""
    moved = np.any(before != after, axis=1)
    radii = np.linalg.norm(after, axis=1)
    assert np.linalg.norm(before, axis=1).max() > 1.1
    assert abs(radii[moved].mean() - radii[~moved].mean()) < 3e-3
    assert 0.8 < radii[moved].std() / radii[~moved].std() < 1.2


def has_the_whole_edge(before: Points, after: Points) -> None:
    """The new vertices lie in the two planes."""
    new = after[len(before) :]
    assert len(new) > 20
    assert np.minimum(np.abs(new[:, 0]), np.abs(new[:, 2])).max() < 1e-6


def has_a_shoulder_that_followed(before: Points, after: Points) -> None:
    """The neck moved as a whole, and the shoulder half as far in the mean."""
    neck, shoulder = before[:, 2] > 0.61, (before[:, 2] > -0.1) & (before[:, 2] < 0.5)
    assert np.allclose(after[neck] - before[neck], (0.4, 0.0, 0.0), atol=1e-6)
    assert 0.1 < (after[shoulder, 0] - before[shoulder, 0]).mean() < 0.3


# By the files' names: positions before and after, in object mode.
CHECKS: dict[str, Callable[[Points, Points], None]] = {
    "ear": has_no_ear,
    "panel": has_no_dent,
    "scan": has_no_holes,
    "seam": has_a_fillet,
    "pipes": is_an_elbow,
    "pores": has_pores_and_no_swelling,
    "edge": has_the_whole_edge,
    "bottle": has_a_shoulder_that_followed,
}
