"""A patch on a new mesh: the surface, where values come from, lines that stay. On a sphere, whose answer is itself."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from addon.arrays.lines import inner_lines, parting_edges
from addon.arrays.region import MeshArrays
from addon.arrays.types import Floats, Mask
from addon.fair.engine import Problem
from addon.options.options import FairOptions
from addon.remesh import remeshing
from addon.remesh.remeshing import Remeshed, remesh_arrays
from addon.verdict.verdict import GOOD, LOOK

import fairing
from polygon_mesh import grid, on_sphere
from test_core_answer import EYE, spoilt_sphere

SIZE = 16


def remesh(mesh: MeshArrays, matrix: Floats = EYE, **options: object) -> Remeshed:
    return remesh_arrays(mesh, matrix, FairOptions(remesh=True, **options))


def all_points(mesh: MeshArrays, done: Remeshed) -> Floats:
    """Of the new part's r + k vertices."""
    moved = mesh.positions.copy()
    moved[done.vertices] = done.positions
    return np.concatenate([moved[done.part.stay], done.new_positions])


def seam(mesh: MeshArrays) -> Mask:
    """The (e,) mask of the edges on the middle row of vertices."""
    on_row: Mask = (mesh.edges // (SIZE + 1) == SIZE // 2).all(axis=1)
    return on_row


def sides(mesh: MeshArrays) -> Floats:
    """(c, 1): -1 at corners of faces before the middle row, 1 behind it."""
    rows = np.arange(len(mesh.in_patch)) // SIZE
    return np.where(rows < SIZE // 2, -1.0, 1.0)[mesh.corner_faces][:, None]


@pytest.mark.parametrize("spacing", [0.5, 1.0])
def test_the_sphere_comes_back(spacing: float) -> None:
    mesh = spoilt_sphere()
    done = remesh(mesh, spacing=spacing)
    assert done.verdict.grade == GOOD
    np.testing.assert_allclose(np.linalg.norm(done.new_positions, axis=1), 1.0, atol=3e-5)
    assert (len(done.after.folded), len(done.after.needles)) == (0, 0)
    assert set(done.part.gone_faces) == set(np.flatnonzero(mesh.in_patch))


def test_values_come_from_where_the_new_vertices_lie() -> None:
    mesh = grid(SIZE, 0.6, on_sphere)
    done = remesh(mesh, spacing=0.7)
    carried = done.part.vertices.mean(mesh.positions)
    np.testing.assert_allclose(carried, done.new_positions, atol=0.02)
    corners = done.part.corners.mean(mesh.positions[mesh.corner_vertices])
    np.testing.assert_allclose(corners, all_points(mesh, done)[done.part.triangles.ravel()], atol=0.02)


def test_corners_take_values_of_their_own_side() -> None:
    mesh = spoilt_sphere()
    mesh = replace(mesh, lines={"side": parting_edges(mesh, sides(mesh))})
    assert np.array_equal(mesh.lines["side"], seam(mesh))
    done = remesh(mesh, spacing=0.7)
    assert len(done.vertices) == np.count_nonzero(seam(mesh) & inner_lines(mesh)) - 1
    carried = done.part.corners.mean(sides(mesh)).reshape(-1, 3)
    np.testing.assert_allclose(np.abs(carried), 1.0, atol=1e-12)
    carried = np.sign(carried)
    assert (carried == carried[:, :1]).all()  # one side for each face
    assert set(carried[:, 0]) == {-1.0, 1.0}
    rows = done.part.faces // SIZE
    assert np.array_equal(np.where(rows < SIZE // 2, -1.0, 1.0), carried[:, 0])


def test_nothing_but_lines_is_refused() -> None:
    every = np.ones(len(spoilt_sphere().edges), dtype=bool)
    mesh = replace(spoilt_sphere(), lines={"UVMap": every & False, "sharp_edge": every, "crease_edge": every & False})
    with pytest.raises(ValueError, match=r"marked \(\d+ by Mark Sharp\).*nothing to mesh anew"):
        remesh(mesh)


def test_a_seam_over_a_limb_that_is_gone_is_a_knot() -> None:
    """The old surface has a horn in the middle of the seam, which its edges climb."""
    mesh = grid(SIZE, 0.6, on_sphere)
    away = np.linalg.norm(mesh.positions[:, :2], axis=1)
    verdicts = []
    for height in (0.0, 3.0):
        horn = replace(mesh, positions=mesh.positions * (1.0 + height * np.exp(-30.0 * away**2))[:, None])
        verdicts.append(remesh(replace(horn, lines={"seam": seam(horn)})).verdict)
    assert [verdict.grade for verdict in verdicts] == [GOOD, LOOK]
    assert "squeezed to a knot" in verdicts[1].reason
    assert (away[verdicts[1].spots] < 0.3).all()
    assert remesh(replace(horn, lines={})).verdict.grade == GOOD


@pytest.mark.parametrize("spacing", [1.0, 4.0])
def test_warnings_name_the_mesh_that_was_solved(monkeypatch: pytest.MonkeyPatch, spacing: float) -> None:
    """The new one, also where its surface was found on the engine's own mesh; the old one, if it was cut from it."""
    mesh = spoilt_sphere()
    solved = remeshing._solved

    def with_warning(problem: Problem, *rest: Any) -> fairing.RemeshResult:
        result = solved(problem, *rest)
        assert result.cut == (spacing > 1.0)
        count = len(problem.patch.vertices)
        last = count - 1 if result.cut else count + len(result.vertices) - 1
        reported = fairing.Diagnostic("NO_SOLUTION", "", np.array([last], np.int32), "vertex", {"kinks": 1.0})
        return replace(result, polished=False, warnings=(reported,))

    monkeypatch.setattr(remeshing, "_solved", with_warning)
    verdict = remesh(mesh, spacing=spacing).verdict
    assert verdict.grade == LOOK
    assert np.isin(verdict.spots, mesh.corner_vertices[mesh.in_patch[mesh.corner_faces]]).all()
