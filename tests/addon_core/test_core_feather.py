"""Feather: the band around the patch moves less and less, and what is to stay in it does."""

from __future__ import annotations

import json
from dataclasses import asdict, replace
from functools import cache

import numpy as np
import pytest

from core.arrays import Ints
from core.options import FairOptions
from core.outcome import Fairing, outcome
from core.region import MeshArrays
from core.solve import pose, solve
from polygon_mesh import grid, on_sphere

EYE = np.eye(4)
SIZE, HALF = 24, 0.4
WIDTH = 0.3


@cache
def swollen() -> MeshArrays:
    """A side of a cubic sphere with a symmetric swelling that is wider than the selection."""
    mesh = grid(SIZE, HALF, on_sphere)
    away = np.linalg.norm(mesh.positions[:, :2], axis=1)
    return replace(mesh, positions=mesh.positions * (1.0 + 0.2 * np.exp(-((away / 0.4) ** 2)))[:, None])


def fair(mesh: MeshArrays, **options: object) -> Fairing:
    chosen = FairOptions(**options)
    return outcome(mesh, EYE, chosen, solve(mesh, EYE, chosen))


def band(mesh: MeshArrays, done: Fairing) -> Ints:
    """Those of the vertices that move which are not free in the patch."""
    patch = pose(mesh, EYE, FairOptions())[0].patch
    return np.setdiff1d(done.vertices, patch.vertices[patch.free])


def test_the_band_moves_less_and_less() -> None:
    mesh = swollen()
    done = fair(mesh, feather=WIDTH)
    moves = np.linalg.norm(done.positions - mesh.positions[done.vertices], axis=1)
    row = SIZE // 2 * (SIZE + 1) + np.arange(SIZE // 2, SIZE + 1)  # from the middle to the border
    along = [float(moves[done.vertices == vertex][0]) for vertex in row if vertex in done.vertices]
    inside = round(HALF * SIZE / 2)
    assert inside + 3 < len(along) < len(row) - 1
    assert (np.diff(along[inside:]) < 0.0).all()
    assert along[-1] < 0.15 * along[inside]
    assert done.free_count == len(done.vertices) - len(band(mesh, done))


def test_what_is_pinned_hidden_or_on_a_border_stays_in_the_band() -> None:
    mesh = swollen()
    usual = band(mesh, fair(mesh, feather=WIDTH))
    pin = int(usual[0])
    pinned = mesh.pinned.copy()
    pinned[pin] = True
    hidden = np.zeros(len(mesh.in_patch), dtype=bool)
    hidden[mesh.corner_faces[mesh.corner_vertices == usual[-1]][0]] = True
    of_hidden = mesh.corner_vertices[hidden[mesh.corner_faces]]
    done = fair(replace(mesh, pinned=pinned, hidden=hidden), feather=WIDTH)
    assert np.array_equal(band(mesh, done), np.setdiff1d(usual, [pin, *of_hidden]))
    wide = fair(mesh, feather=2.0)
    rows = np.arange((SIZE + 1) ** 2).reshape(SIZE + 1, SIZE + 1)
    assert np.array_equal(wide.vertices, rows[1:-1, 1:-1].ravel())


def test_without_feather_it_is_the_same_answer() -> None:
    mesh = swollen()
    plain, none = fair(mesh), fair(mesh, feather=0.0)
    assert np.array_equal(plain.vertices, none.vertices)
    assert np.array_equal(plain.positions, none.positions)


def test_the_factor_blends_the_band_too() -> None:
    mesh = swollen()
    whole, half = fair(mesh, feather=WIDTH), fair(mesh, feather=WIDTH, factor=0.5)
    assert np.array_equal(whole.vertices, half.vertices)
    middle = 0.5 * (mesh.positions[whole.vertices] + whole.positions)
    np.testing.assert_allclose(half.positions, middle, atol=1e-14)


def test_the_mirror_holds_in_the_band() -> None:
    mesh = replace(swollen(), mirror_x=True)
    rows = np.arange((SIZE + 1) ** 2).reshape(SIZE + 1, SIZE + 1)
    points = mesh.positions.copy()
    points[rows[:, ::-1][:, : SIZE // 2]] = points[rows[:, : SIZE // 2]] * (-1.0, 1.0, 1.0)
    points[rows[:, SIZE // 2], 0] = 0.0
    free = fair(mesh).vertices
    points[free] *= 1.0 + 0.02 * np.random.default_rng(3).normal(size=(len(free), 1))  # only there is it not symmetric
    mesh = replace(mesh, positions=points)
    done = fair(mesh, feather=WIDTH)
    assert not any("mirror" in warning for warning in done.warnings)
    after = points.copy()
    after[done.vertices] = done.positions
    assert np.array_equal(after[rows], after[rows[:, ::-1]] * (-1.0, 1.0, 1.0))
    pinned = mesh.pinned.copy()
    pinned[band(mesh, done)[0]] = True
    lopsided = fair(replace(mesh, pinned=pinned), feather=WIDTH)
    assert any("X mirror is on, but the selection is not symmetric" in warning for warning in lopsided.warnings)


def test_what_has_nothing_around_it_is_fair_without_a_band() -> None:
    mesh = replace(swollen(), in_patch=np.ones(SIZE * SIZE, dtype=bool))
    plain, soft = fair(mesh, inner_fairness="CONFORMAL"), fair(mesh, inner_fairness="CONFORMAL", feather=WIDTH)
    assert np.array_equal(plain.vertices, soft.vertices)


@pytest.mark.parametrize(
    ("options", "text"),
    [
        ({"outline": "MENDED"}, "Outline: Smooth"),
        ({"continuity": "G2"}, "Join: Curvature"),
    ],
)
def test_options_that_a_band_can_not_have_are_refused(options: dict[str, object], text: str) -> None:
    with pytest.raises(ValueError, match=f"^{text}.*Feather 0$"):
        fair(swollen(), feather=WIDTH, **options)


@pytest.mark.parametrize("value", [-0.1, float("nan"), float("inf")])
def test_a_width_is_a_positive_number(value: float) -> None:
    with pytest.raises(ValueError, match="feather: expected 0 or a positive number"):
        FairOptions(feather=value)


def test_options_of_another_version_are_read_as_far_as_they_are_known() -> None:
    known = asdict(FairOptions(equation="MINIMAL", feather=0.2))
    assert FairOptions.parsed(json.dumps(known)) == FairOptions(equation="MINIMAL", feather=0.2)
    assert FairOptions.parsed(json.dumps({"load": 1.0, "equation": "MINIMAL"})) == FairOptions(equation="MINIMAL")
    with pytest.raises(TypeError, match="options"):
        FairOptions.parsed("[1]")
    with pytest.raises(ValueError, match="equation"):
        FairOptions.parsed('{"equation": "ROUND"}')
