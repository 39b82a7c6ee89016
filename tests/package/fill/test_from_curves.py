"""Surfaces over wires: closed loops of edges without faces, and networks of them."""

import numpy as np
import pytest

import fairing
import wire_networks as networks
from fairing.results import FromCurvesResult


def whole(points: networks.Floats, result: FromCurvesResult) -> networks.Floats:
    return np.concatenate([points, result.vertices])


def tube(rings: int, lines: int) -> networks.Wires:
    return networks.revolved(lambda s: (1.0, 2.0 * s), np.linspace(0.0, 1.0, rings), lines, steps=16)


def plane(u: float, v: float) -> list[float]:
    return [3.0 * u + 0.2 * np.sin(3.0 * v), 2.0 * v + 0.3 * np.sin(2.0 * u), 0.0]


def ring(height: float, count: int = 48) -> networks.Wires:
    angles = 2.0 * np.pi * np.arange(count) / count
    points = np.stack([np.cos(angles), np.sin(angles), height * np.cos(2.0 * angles)], axis=1)
    return points, np.column_stack([np.arange(count), (np.arange(count) + 1) % count])


def joined(*parts: networks.Wires) -> networks.Wires:
    """Several wirings, side by side as they lie."""
    starts = np.cumsum([0] + [len(points) for points, _ in parts[:-1]])
    edges = [edges + start for (_, edges), start in zip(parts, starts, strict=True)]
    return np.concatenate([points for points, _ in parts]), np.concatenate(edges).astype(np.int32)


def test_three_circles_are_a_sphere() -> None:
    points, wires = networks.circles([1.0, 1.0, 1.0])
    result = fairing.surface_from_curves(points, wires)
    assert result.converged and result.equation == "least_variation"
    assert len(result.cells) == 8 and not result.left_open
    assert np.abs(np.linalg.norm(result.vertices, axis=1) - 1.0).max() < 1e-9
    at = whole(points, result)[result.triangles]
    volume = np.einsum("ij,ij->i", at[:, 0], np.cross(at[:, 1], at[:, 2])).sum() / 6.0
    assert 4.0 < volume < 4.0 / 3.0 * np.pi  # outwards, all around
    assert np.isclose(np.unique(result.cell, return_counts=True)[1], len(at) / 8, rtol=0.1).all()
    octant = np.sign(at.mean(axis=1))
    for k in range(8):
        assert len(np.unique(octant[result.cell == k], axis=0)) == 1


def test_a_flat_net_is_flat_and_its_outside_stays_open() -> None:
    points, wires = networks.net(plane, 3, 2)
    result = fairing.surface_from_curves(points, wires)
    assert result.converged and len(result.cells) == 6
    assert np.abs(result.vertices[:, 2]).max() < 1e-12
    assert [len(loop) for loop in result.left_open] == [80]


@pytest.mark.parametrize(("rings", "lines"), [(3, 4), (2, 2)])
def test_circles_and_lines_are_a_cylinder_that_is_open(rings: int, lines: int) -> None:
    points, wires = tube(rings, lines)
    result = fairing.surface_from_curves(points, wires)
    assert result.converged and len(result.cells) == (rings - 1) * lines and len(result.left_open) == 2
    assert np.abs(np.hypot(*result.vertices[:, :2].T) - 1.0).max() < 1e-9


def test_closed_gives_an_opening_its_surface() -> None:
    points, wires = tube(2, 4)
    result = fairing.surface_from_curves(points, wires, closed=True)
    assert len(result.creases) == 64 and (np.ptp(points[result.creases][:, :, 2], axis=1) < 1e-9).all()
    assert result.converged and len(result.cells) == 6 and not result.left_open
    lids = [k for k, loop in enumerate(result.cells) if np.ptp(points[loop][:, 2]) < 1e-9]
    assert len(lids) == 2
    for lid in lids:
        heights = whole(points, result)[np.unique(result.triangles[result.cell == lid]), 2]
        assert np.ptp(heights) < 1e-9 and np.count_nonzero(result.cell == lid) > 100
    walls = np.unique(result.triangles[~np.isin(result.cell, lids)])
    assert np.abs(np.hypot(*whole(points, result)[walls, :2].T) - 1.0).max() < 1e-9
    sheet = fairing.surface_from_curves(*networks.net(plane, 3, 2), closed=True)
    assert len(sheet.cells) == 6 and len(sheet.left_open) == 1


def test_a_lone_loop_bounds_a_soap_film() -> None:
    points, wires = ring(0.3)
    result = fairing.surface_from_curves(points, wires)
    assert result.converged and result.equation == "soap_film" and len(result.cells) == 1
    assert np.abs(result.mean_curvature).max() < 1e-2
    flat = fairing.surface_from_curves(*ring(0.0))
    assert flat.converged and np.abs(flat.vertices[:, 2]).max() < 1e-12


@pytest.mark.parametrize(
    ("points", "wires"),
    [networks.circles([0.7, 1.6, 1.0]), networks.bottle(1.0, 0.4, 3.0), networks.saddle(1.0, 0.5, 0.2, 3, 2)],
    ids=["ellipsoid", "bottle", "saddle"],
)
def test_all_cells_are_wound_alike_and_wires_are_edges(points: networks.Floats, wires: networks.Floats) -> None:
    result = fairing.surface_from_curves(points, wires)
    assert result.converged
    sides = result.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    assert len(np.unique(sides, axis=0)) == len(sides)
    edges = {tuple(edge) for edge in np.sort(sides, axis=1).tolist()}
    assert {tuple(edge) for edge in np.sort(wires, axis=1).tolist()} <= edges
    assert not len(fairing.self_intersections(whole(points, result), result.triangles))
    for k, loop in enumerate(result.cells):  # bounds the triangles of its cell, on its left
        (found,) = fairing.boundary_loops(result.triangles[result.cell == k])
        assert set(zip(found, np.roll(found, -1), strict=True)) == set(zip(loop, np.roll(loop, -1), strict=True))


def test_no_kink_at_a_wire_inside_but_at_a_crease() -> None:
    """A roof: over its ridge the surface bends only where the ridge is a crease."""

    def roof(u: float, v: float) -> list[float]:
        return [2.0 * u - 1.0, 2.0 * v - 1.0, -abs(2.0 * u - 1.0)]

    points, wires = networks.net(roof, 2, 2)
    ridge = wires[(points[wires][:, :, 0] == 0.0).all(axis=1)]
    sharp = fairing.surface_from_curves(points, wires, creases=ridge)
    assert sharp.converged
    assert np.abs(sharp.vertices[:, 2] + np.abs(sharp.vertices[:, 0])).max() < 1e-9
    smooth = fairing.surface_from_curves(points, wires)
    assert np.abs(smooth.vertices[:, 2] + np.abs(smooth.vertices[:, 0])).max() > 1e-2


def refused(code: str, points: networks.Floats, wires: object, **options: object) -> list[int]:
    before = points.copy()
    with pytest.raises(fairing.MeshError) as reported:
        fairing.surface_from_curves(points, wires, **options)  # type: ignore[arg-type]
    assert reported.value.code == code
    assert (points == before).all() or np.isnan(before).any()
    return reported.value.elements.tolist()


def test_what_is_refused() -> None:
    points, wires = tube(2, 4)
    assert refused("NO_CELL", points, np.empty((0, 2), np.int32)) == []
    (ring_edge,) = np.flatnonzero((wires == [1, 2]).all(axis=1))  # neither meets a line
    assert refused("WIRES_END", points, np.delete(wires, ring_edge, axis=0)) == [1, 2]
    broken = points.copy()
    broken[7] = np.nan
    assert refused("NONFINITE", broken, wires) == [7]
    assert refused("INDEX_RANGE", points, [[0, len(points)]]) == [len(points)]
    square = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    around = [[0, 1], [1, 2], [2, 3], [3, 0]]
    assert refused("WIRES_CROSS", square[[0, 2, 1, 3]], around) == [0, 1, 2, 3]
    doubled = joined((square, np.array(around)), (square + np.array([1.0, 0.0, 0.0]), np.array(around)))
    assert refused("WIRES_CROSS", *doubled) == [1, 2, 4, 7]


def test_wires_that_tell_no_cells() -> None:
    one, other = ring(0.0), ring(0.0)
    points, wires = joined(one, (other[0] + [0.0, 0.0, 2.0], other[1]))
    assert refused("NO_CELL", points, np.concatenate([wires, [[0, 48]]])) == [0, 48]  # one line between two rings
    arcs = np.linspace(0.0, np.pi, 9)
    drawing = networks.Drawing()
    for turn in np.radians([0.0, 2.0, 180.0]):  # the first two leave the poles in nearly one direction
        drawing.line([[np.sin(a) * np.cos(turn), np.sin(a) * np.sin(turn), np.cos(a)] for a in arcs])
    assert len(refused("UNCLEAR_CELLS", *drawing.wires)) == 1


def test_wrong_arguments() -> None:
    points, wires = ring(0.0)
    for message, options in (
        ("closed: True or False", {"closed": "yes"}),
        ("creases: some are not in", {"creases": [[0, 2]]}),
        ("spacing: a length", {"spacing": -1.0}),
    ):
        with pytest.raises(ValueError, match=message):
            fairing.surface_from_curves(points, wires, **options)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="edges: row 0 joins a vertex to itself"):
        fairing.surface_from_curves(points, [[3, 3]])
    with pytest.raises(fairing.Cancelled):
        fairing.surface_from_curves(points, wires, progress=lambda share, stage: False)


def test_rough_wires_get_a_thin_plate() -> None:
    points, wires = networks.bottle(1.0, 0.4, 3.0)
    length = np.linalg.norm(points[wires[:, 0]] - points[wires[:, 1]], axis=1).mean()
    rough = points + np.random.default_rng(3).normal(0.0, 0.1 * length, points.shape)
    result = fairing.surface_from_curves(rough, wires)
    assert not result.converged and result.equation == "bilaplacian" and len(result.cells) == 20
    assert [warning.code for warning in result.warnings] == ["NO_SOLUTION"]
    exact = fairing.surface_from_curves(points, wires)
    away = fairing.deviation(whole(rough, result), whole(points, exact), exact.triangles)
    assert np.sqrt(np.nanmean(away**2)) < 0.05 and np.nanmax(np.abs(away)) < 0.3
