"""Colours of a surface for a texture: texels are covered once, edges are graded, harmonic values are exact."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

import fairing

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def sheet(cells: int = 8, seed: int = 0, shaken: float = 0.3) -> tuple[Floats, Ints]:
    """(n, 3) in the unit square, shaken inside, and triangles whose diagonals go either way."""
    rng = np.random.default_rng(seed)
    steps = np.linspace(0.0, 1.0, cells + 1)
    flat = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    inside = (np.abs(flat - 0.5) < 0.5 - 1e-9).all(axis=1)
    flat[inside] += shaken / cells * rng.uniform(-1.0, 1.0, (np.count_nonzero(inside), 2))
    row, column = np.divmod(np.arange(cells**2), cells)
    a = row * (cells + 1) + column
    b, c, d = a + 1, a + cells + 2, a + cells + 1
    other = (rng.random(cells**2) < 0.5)[:, None]
    first = np.where(other, np.stack([a, b, d], axis=1), np.stack([a, b, c], axis=1))
    second = np.where(other, np.stack([b, c, d], axis=1), np.stack([a, c, d], axis=1))
    return np.column_stack([flat, np.zeros(len(flat))]), np.concatenate([first, second])


def border_sides(triangles: Ints) -> NDArray[np.bool_]:
    """(m, 3): sides that no other triangle has."""
    ends = np.sort(np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2), axis=2)
    keys = ends @ [int(triangles.max()) + 1, 1]
    _, number, count = np.unique(keys, return_inverse=True, return_counts=True)
    found: NDArray[np.bool_] = count[number].reshape(keys.shape) == 1
    return found


@pytest.mark.parametrize("snapped", [False, True])
def test_each_texel_has_one_triangle(snapped: bool) -> None:
    """Also where corners and edges run through the middles of texels."""
    points, triangles = sheet(9)
    places = 90.0 * points[:, :2] + 5.0
    if snapped:
        places = np.round(places - 0.5) + 0.5
    low, high = places.min(axis=0), places.max(axis=0)
    owners, count = fairing.texel_owners(places[triangles], 110, 120)
    middles = np.stack(np.meshgrid(np.arange(110) + 0.5, np.arange(120) + 0.5), axis=-1)
    within = ((middles > low) & (middles < high)).all(axis=2)
    assert (owners[within] >= 0).all()
    assert count == np.count_nonzero(owners >= 0)
    away = ((middles < low) | (middles > high)).any(axis=2)
    assert (owners[away] < 0).all()
    turned, same = fairing.texel_owners(places[triangles[:, ::-1]], 110, 120)
    assert same == count
    assert np.array_equal(turned, owners)


def test_what_lies_beyond_the_image_comes_in_on_its_other_side() -> None:
    points, triangles = sheet(3)
    corners = 20.0 * points[triangles][..., :2] + 7.25
    here, count = fairing.texel_owners(corners, 32, 40)
    there, again = fairing.texel_owners(corners + np.array([-3 * 32, 2 * 40]), 32, 40)
    assert count == again > 300
    assert np.array_equal(here, there)
    across, _ = fairing.texel_owners(corners + np.array([20, 0]), 32, 40)
    assert np.array_equal(np.roll(here, 20, axis=1), across)


def test_what_is_no_place_covers_nothing_and_what_is_vast_all() -> None:
    corners = np.array([[[0.0, 0.0], [np.nan, 0.0], [0.0, 9.0]], [[-1e6, -1e6], [1e6, -1e6], [0.0, 1e6]]])
    assert (fairing.texel_owners(corners[:1], 8, 8)[0] == -1).all()
    assert (fairing.texel_owners(corners[1:], 8, 8)[0] == 0).all()


def test_values_are_linear_in_each_triangle() -> None:
    points, triangles = sheet(5)
    corners = 60.0 * points[triangles][..., :2]
    values = np.stack([2.0 * corners[..., 0] - corners[..., 1], np.ones_like(corners[..., 1])], axis=2)
    found = fairing.texel_values(corners, values, 70, 70)
    y, x = np.mgrid[:70, :70] + 0.5
    covered = np.isfinite(found[..., 0])
    assert np.array_equal(covered, fairing.texel_owners(corners, 70, 70)[0] >= 0)
    assert np.abs(found[covered, 0] - (2.0 * x - y)[covered]).max() < 1e-4
    assert np.abs(found[covered, 1] - 1.0).max() < 1e-6


def test_a_graded_mesh_is_fine_where_it_should_be_and_the_same_surface() -> None:
    points, triangles = sheet(4)
    bent = points + np.column_stack([np.zeros((len(points), 2)), points[:, 0] ** 2])
    chosen = border_sides(triangles) & (points[triangles][..., 1] < 1e-9)
    finest = 0.01
    mesh = fairing.graded_mesh(bent, triangles, chosen, finest)
    again = np.einsum("skw,swx->skx", mesh.weights, bent[triangles[mesh.parent]])
    assert np.abs(again - mesh.vertices[mesh.triangles]).max() < 1e-12
    assert np.array_equal(mesh.vertices[: len(bent)], bent)
    ends = np.sort(np.stack([mesh.triangles, np.roll(mesh.triangles, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    _, count = np.unique(ends, axis=0, return_counts=True)
    assert count.max() == 2
    assert np.count_nonzero(count == 1) == np.count_nonzero(border_sides(mesh.triangles))
    lengths = np.linalg.norm(mesh.vertices[ends[:, 0]] - mesh.vertices[ends[:, 1]], axis=1)
    away = mesh.vertices[ends].mean(axis=1)[:, 1]
    assert (lengths[away < finest] <= finest + 1e-12).all()
    assert (
        lengths <= np.maximum(finest, 0.25 * 1.5 * (away + lengths))
    ).all()  # along edges it is further than straight
    assert lengths.max() > 10.0 * finest
    sides = mesh.vertices[np.roll(mesh.triangles, -1, axis=1)] - mesh.vertices[mesh.triangles]
    whole = np.linalg.norm(bent[np.roll(triangles, -1, axis=1)] - bent[triangles], axis=2)[chosen].sum()
    assert np.linalg.norm(sides, axis=2)[mesh.chosen].sum() == pytest.approx(whole)


def test_nothing_is_halved_where_no_side_is_chosen() -> None:
    points, triangles = sheet(4)
    mesh = fairing.graded_mesh(points, triangles, np.zeros(triangles.shape, dtype=bool), 1e-3)
    assert np.array_equal(mesh.triangles, triangles)


@pytest.mark.parametrize("seed", range(3))
def test_nothing_flows_across_a_free_border(seed: int) -> None:
    """Given at two opposite sides, the other two free: linear."""
    points, triangles = sheet(10, seed)
    known = np.flatnonzero((points[:, 0] < 1e-9) | (points[:, 0] > 1.0 - 1e-9))
    wanted = np.column_stack([3.0 * points[:, 0] - 1.0, np.ones(len(points))])
    found = fairing.harmonic_extension(points, triangles, known, wanted[known])
    assert np.abs(found - wanted).max() < 1e-7


def test_how_a_flat_surface_is_cut_does_not_count() -> None:
    """Slivers with wide angles among the triangles, which cotangents of their own would turn the answer by."""
    points, triangles = sheet(6, shaken=0.45)
    rng = np.random.default_rng(5)
    known = np.unique(triangles[border_sides(triangles)])
    given = rng.uniform(size=(len(known), 2))
    found = fairing.harmonic_extension(points, triangles, known, given)
    flipped = triangles.copy()
    for a, b in rng.integers(len(triangles), size=(4000, 2)):
        shared = np.intersect1d(flipped[a], flipped[b])
        if len(shared) != 2 or a == b:
            continue
        one, other = (np.setdiff1d(flipped[t], shared)[0] for t in (a, b))
        turns = [_area(points, (one, shared[k], other)) for k in (0, 1)]
        if turns[0] * turns[1] < 0.0 and min(map(abs, turns)) > 1e-4:
            for t, k in ((a, 0), (b, 1)):
                corners = np.array([one, shared[k], other])
                flipped[t] = corners if turns[k] > 0.0 else corners[::-1]
    assert np.count_nonzero((flipped != triangles).any(axis=1)) > 10
    again = fairing.harmonic_extension(points, flipped, known, given)
    assert np.abs(again - found).max() < 1e-5
    assert found.min() >= given.min() and found.max() <= given.max()


def _area(points: Floats, corners: tuple[int, int, int]) -> float:
    a, b, c = points[list(corners), :2]
    return float(np.cross(b - a, c - a))


def test_pieces_without_a_known_vertex_have_no_values() -> None:
    points, triangles = sheet(3)
    twice = np.concatenate([points, points + 5.0]), np.concatenate([triangles, triangles + len(points)])
    found = fairing.harmonic_extension(*twice, [0, 3], [[1.0], [1.0]])
    assert found[: len(points)] == pytest.approx(1.0)
    assert np.isnan(found[len(points) :]).all()


@pytest.mark.parametrize("spoilt", ["turned", "three at an edge"])
def test_surfaces_that_branch_or_are_wound_against_themselves_have_values(spoilt: str) -> None:
    """A regular sheet, on which the mesh's own weights are as good."""
    points, triangles = sheet(8, shaken=0.0)
    if spoilt == "turned":
        triangles[::3] = triangles[::3, ::-1]
    else:
        a, b = triangles[20, :2]
        points = np.concatenate([points, [[*points[[a, b], :2].mean(axis=0), 0.1]]])
        triangles = np.concatenate([triangles, [[a, b, len(points) - 1]]])
    known = np.flatnonzero((points[:, 0] < 1e-9) | (points[:, 0] > 1.0 - 1e-9))
    found = fairing.harmonic_extension(points, triangles, known, points[known, :1])
    assert np.abs(found[:81, 0] - points[:81, 0]).max() < (1e-3 if spoilt == "turned" else 0.02)


def test_bad_arguments_are_refused() -> None:
    points, triangles = sheet(2)
    chosen = np.ones(triangles.shape, dtype=bool)
    with pytest.raises(ValueError, match="finest"):
        fairing.graded_mesh(points, triangles, chosen, 0.0)
    with pytest.raises(ValueError, match="chosen"):
        fairing.graded_mesh(points, triangles, chosen[:1], 0.1)
    with pytest.raises(ValueError, match="finite"):
        fairing.graded_mesh(points * np.nan, triangles, chosen, 0.1)
    with pytest.raises(ValueError, match="values"):
        fairing.harmonic_extension(points, triangles, [0], [[1.0], [2.0]])
    with pytest.raises(ValueError, match="finite"):
        fairing.harmonic_extension(points, triangles, [0], [[np.inf]])
    with pytest.raises(fairing.MeshError):
        fairing.harmonic_extension(points, triangles, [99], [[1.0]])
    with pytest.raises(ValueError, match="corners"):
        fairing.texel_owners(points, 4, 4)
    with pytest.raises(ValueError, match="texel"):
        fairing.texel_owners(points[triangles][..., :2], 0, 4)
    with pytest.raises(ValueError, match="values"):
        fairing.texel_values(points[triangles][..., :2], np.ones((1, 3, 1)), 4, 4)
