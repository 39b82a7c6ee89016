"""`spacing` and `inner` of fairing.fill and fairing.remesh: new edges as the outline's nearby, or all of one length."""

from typing import Any

import numpy as np
import pytest

import fairing
import holes
from holes import FloatArray

EMPTY = np.empty((0, 3), dtype=int)


def uneven_circle() -> FloatArray:
    """Radius 1, edges four times as long on the left (x < 0) as on the right, growing in between."""
    turn = np.linspace(0.0, 2 * np.pi, 4000, endpoint=False)
    density = 4.0 ** (0.5 * (1.0 + np.tanh(6.0 * np.cos(turn))))
    share = np.cumsum(density) / density.sum()
    chosen = np.interp(np.arange(64) / 64, share, turn)
    return np.column_stack([np.cos(chosen), np.sin(chosen), 0 * chosen])


CIRCLE = uneven_circle()
MEAN = float(np.linalg.norm(CIRCLE - np.roll(CIRCLE, 1, axis=0), axis=1).mean())


def disc(**options: Any) -> fairing.FillResult:
    """A flat surface over the circle."""
    return fairing.fill(CIRCLE, EMPTY, [np.arange(64)], normals=np.tile([0.0, 0.0, 1.0], (64, 1)), **options)


def lengths(result: fairing.FillResult | fairing.RemeshResult, old: FloatArray) -> tuple[FloatArray, FloatArray]:
    """(e, 3) middles and (e,) lengths of new edges away from the circle."""
    points = np.concatenate([old, result.vertices])
    ends = points[holes.edges_of(result.triangles)]
    middles = ends.mean(axis=1)
    inside = np.linalg.norm(middles, axis=1) < 0.75
    return middles[inside], np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)[inside]


def ratio(result: fairing.FillResult | fairing.RemeshResult, old: FloatArray = CIRCLE) -> float:
    """Of edges on the left to those on the right."""
    middles, found = lengths(result, old)
    return float(np.median(found[middles[:, 0] < -0.3]) / np.median(found[middles[:, 0] > 0.3]))


def typical(result: fairing.FillResult) -> float:
    return float(np.median(lengths(result, CIRCLE)[1]))


@pytest.mark.parametrize("factor", [0.5, 1.0, 2.0])
def test_edges_follow_the_outlines_or_have_one_length(factor: float) -> None:
    even = disc(spacing=factor * MEAN, inner="even")
    assert ratio(even) == pytest.approx(1.0, abs=0.15)
    assert 0.7 < typical(even) / (factor * MEAN) < 1.4
    graded = disc(spacing=factor * MEAN, inner="outline")
    assert ratio(graded) > 1.5
    assert 0.6 < typical(graded) / (factor * MEAN) < 1.6


SQUARE = np.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]])


@pytest.mark.parametrize("spacing", [0.4, 0.2, 0.1])
@pytest.mark.parametrize("dome", [False, True])
def test_the_wanted_length_holds_inside_an_outline_of_four_edges(spacing: float, dome: bool) -> None:
    """Its edges stay, and new ones grow towards them; angles stay above 18°."""
    slope = SQUARE / np.sqrt(6.0) + [0.0, 0.0, np.sqrt(2.0 / 3.0)]
    normals = slope if dome else np.tile([0.0, 0.0, 1.0], (4, 1))
    result = fairing.fill(SQUARE, EMPTY, [np.arange(4)], normals=normals, spacing=spacing)
    assert result.converged
    points = np.concatenate([SQUARE, result.vertices])
    edges = holes.edges_of(result.triangles)
    ends = points[edges]
    inner = np.abs(ends.mean(axis=1)[:, :2]).max(axis=1) < 0.5
    lengths = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    assert 0.7 < np.median(lengths[inner]) / spacing < 1.7
    corner = lengths[(edges < 4).any(axis=1)]
    assert corner.max() < 2.01
    assert corner.min() > spacing
    assert holes.angles(points, result.triangles).min() > 18.0


@pytest.mark.parametrize("equation", ["soap_film", "harmonic"])
@pytest.mark.parametrize("width", [0.001, 0.01, 0.05])
@pytest.mark.parametrize("aside", [0.0, 0.3])
def test_a_slit_of_four_edges_is_filled(width: float, aside: float, equation: str) -> None:
    """Its only diagonal cuts off sharp corners at both ends: a vertex has to come in all the same."""
    slit = np.array([[0.0, 0, 0], [0.5 - aside, -width, 0], [1, 0, 0], [0.5 + aside, 0.5 * width, 0]])
    result = fairing.fill(
        slit, np.empty((0, 3), int), [[0, 1, 2, 3]], normals=[[0, 0, 1]] * 4, spacing=0.3, equation=equation
    )  # fmt: skip
    assert result.converged
    assert np.abs(result.vertices[:, 2]).max() < 1e-9
    corners = np.concatenate([slit, result.vertices])[result.triangles]
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2].sum() / 2
    assert area == pytest.approx(0.75 * width)
