"""A live region on arrays: what it reads, and that its answers are the fair ones for where its surroundings are."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from addon.arrays.around import outside_triangles
from addon.arrays.region import MeshArrays, make_patch
from addon.arrays.types import Floats, Ints
from addon.fair.boundary import boundary
from addon.fair.held_curves import none, with_pinned_edges
from addon.fair.solve import solve
from addon.live.region import LiveRegion, sought, surroundings
from addon.options.options import FairOptions

import fairing
from polygon_mesh import grid, on_sphere

EYE = np.eye(4)
SIZE = 24


def sphere() -> MeshArrays:
    return grid(SIZE, 0.35, on_sphere)  # 8 × 8 of 24 × 24 quads, eight rings of faces around them


@pytest.mark.parametrize("source", ["AUTOMATIC", "SURROUNDING", "INSIDE", "AVERAGE"])
def test_normals_from_the_part_are_those_from_the_whole(source: str) -> None:
    mesh = grid(SIZE, 0.35, lambda points: on_sphere(points) * (1.0 + 0.1 * points[:, :1] ** 2))
    patch = make_patch(mesh)
    around = surroundings(mesh, patch)
    part = boundary(around.mesh, around.patch, source, outside_triangles(around.mesh, around.patch)).normals
    whole = boundary(mesh, patch, source, outside_triangles(mesh, patch)).normals
    np.testing.assert_allclose(part, whole, atol=1e-13)


def test_a_refusal_names_the_vertices_of_the_whole_mesh() -> None:
    """Not those of the part that the region keeps."""
    mesh = sphere()
    region = LiveRegion(mesh, EYE, FairOptions(boundary_normals="AVERAGE"))
    patch = make_patch(mesh)
    spoilt = int(patch.vertices[patch.fixed[5]])
    positions = mesh.positions.copy()
    positions[spoilt] = np.nan
    with pytest.raises(fairing.MeshError, match=f"^Vertex {spoilt} has") as refusal:
        region.answer(positions[region.vertices], EYE)
    assert refusal.value.elements.tolist() == [spoilt]


def test_no_convergence_is_no_answer_and_a_stop_is_heard(monkeypatch: pytest.MonkeyPatch) -> None:
    mesh = grid(SIZE, 0.35, lambda points: on_sphere(points) * (1.0 + 0.2 * np.sin(3.0 * points[:, :1])))
    asked = FairOptions.engine_arguments
    with monkeypatch.context() as hasty:
        hasty.setattr(FairOptions, "engine_arguments", lambda o: {**asked(o), "max_iterations": 1, "tolerance": 1e-13})
        region = LiveRegion(mesh, EYE, FairOptions())
    assert region.answer(mesh.positions[region.vertices], EYE) is None
    patient = LiveRegion(mesh, EYE, FairOptions())
    with pytest.raises(fairing.Cancelled):
        patient.answer(mesh.positions[patient.vertices], EYE, lambda *_: False)
    assert patient.answer(mesh.positions[patient.vertices], EYE) is not None


def test_the_skin_that_the_region_had_stays_on_it() -> None:
    """Keep Detail: it turns and grows with the boundary. The region's own later places say nothing."""
    mesh = sphere()
    free = LiveRegion(mesh, EYE, FairOptions()).free
    heights = 0.01 * np.random.default_rng(5).normal(size=(len(free), 1))
    rough = mesh.positions.copy()
    rough[free] *= 1.0 + heights
    region = LiveRegion(replace(mesh, positions=rough), EYE, FairOptions(detail=1.0))
    turn, _ = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))
    turn *= np.sign(np.linalg.det(turn))
    first = region.answer(rough[region.vertices], EYE)
    moved = mesh.positions @ turn.T  # the free vertices without their skin
    second = region.answer(moved[region.vertices], EYE)
    assert first is not None
    assert second is not None
    np.testing.assert_allclose(second, first @ turn.T, atol=1e-5)
    kept = np.linalg.norm(first, axis=1) - 1.0
    assert np.corrcoef(kept, heights[:, 0])[0, 1] > 0.9
    assert kept.std() == pytest.approx(heights.std(), rel=0.25)


@pytest.mark.parametrize("steps", [1, 12])
def test_an_edge_that_runs_through_follows_its_ends(steps: int) -> None:
    """A dented fold whose surroundings are turned, stretched and sheared: a straight edge between two planes.

    Its vertices keep their shares of the edge, in however many steps it gets there.
    """
    fold = lambda points: np.column_stack([np.minimum(points[:, 0], 0), points[:, 1], -np.maximum(points[:, 0], 0)])  # noqa: E731
    mesh = grid(SIZE, 0.35, fold)
    rows = SIZE + 1
    edge = (mesh.edges % rows == SIZE // 2).all(axis=1)
    exact = mesh.positions.copy()
    free = make_patch(mesh).vertices[make_patch(mesh).free]
    mesh.positions[free] += 0.01 * np.random.default_rng(3).normal(size=(len(free), 3))
    mesh = with_pinned_edges(replace(mesh, sharp=edge), FairOptions(), none(mesh))
    region = LiveRegion(mesh, EYE, FairOptions())
    assert set(region.free.tolist()) == set(free.tolist())
    whole = np.array([[1.2, 0.3, 0.1], [-0.2, 0.9, 0.4], [0.1, -0.5, 1.1]])
    positions = mesh.positions.copy()
    for step in range(1, steps + 1):
        map_now = EYE[:3, :3] + step / steps * (whole - EYE[:3, :3])
        outside = np.setdiff1d(region.vertices, free)
        positions[outside] = exact[outside] @ map_now.T
        answer = region.answer(positions[region.vertices], EYE)
        assert answer is not None
        positions[region.free] = answer
    back = np.linalg.solve(whole, positions[region.free].T).T
    on_edge = np.isin(region.free, mesh.edges[edge])
    assert np.minimum(np.abs(back[:, 0]), np.abs(back[:, 2])).max() < 1e-6
    start = places_on_edge(mesh.positions, exact, np.sort(region.free[on_edge]), rows)
    np.testing.assert_allclose(np.sort(back[on_edge, 1]), start, atol=1e-6)


def places_on_edge(dented: Floats, exact: Floats, inner: Ints, rows: int) -> Floats:
    """Where the vertices of an edge lie on it when they keep their shares of the dented one's length."""
    path = np.concatenate([[inner[0] - rows], inner, [inner[-1] + rows]])
    lengths = np.linalg.norm(np.diff(dented[path], axis=0), axis=1).cumsum()
    ends = exact[path[[0, -1]], 1]
    places: Floats = ends[0] + lengths[:-1] / lengths[-1] * (ends[1] - ends[0])
    return places


def test_a_step_longer_than_an_edge_makes_no_hard_edge() -> None:
    """The surroundings of a plane are bent down at once: the faces inside, still flat, are not the lid of a box."""
    mesh = grid(SIZE, 0.35, lambda points: points)
    region = LiveRegion(mesh, EYE, FairOptions())
    moved = mesh.positions.copy()
    boundary = np.abs(mesh.positions[region.boundary, :2]).max()
    moved[:, 2] -= 1.5 * np.maximum(np.abs(moved[:, :2]).max(axis=1) - boundary, 0.0)
    answer = region.answer(moved[region.vertices], EYE)
    assert answer is not None
    assert answer[:, 2].max() > 0.1 * boundary


def test_the_curvature_is_continued_on_the_part_that_asks_for_it_as_by_the_operator() -> None:
    egg = grid(SIZE, 0.6, lambda points: on_sphere(points) * [1.0, 2.5, 1.0])
    mesh = replace(egg, continued=egg.positions[:, 1] > 0.0)
    options = FairOptions(continuity="G2", continuity_group="Upper")
    region = LiveRegion(mesh, EYE, options)
    answer = region.answer(mesh.positions[region.vertices], EYE)
    patch = make_patch(mesh)
    expected = solve(mesh, EYE, options).result
    assert expected.continuity == "G2" and not expected.warnings
    assert answer is not None
    np.testing.assert_allclose(answer, expected.vertices[patch.free], atol=1e-6)
    whole = solve(egg, EYE, FairOptions(continuity="G2")).result
    assert np.abs(expected.vertices - whole.vertices)[patch.free].max() > 1e-5


def test_a_lone_pin_pulls_as_by_the_operator_and_stays_where_it_is_put() -> None:
    mesh = sphere()
    pin = int(np.linalg.norm(mesh.positions[:, :2], axis=1).argmin())
    pinned, places = np.zeros(len(mesh.positions), dtype=bool), mesh.positions.copy()
    pinned[pin] = True
    places[pin] *= 1.05
    mesh, options = replace(mesh, pinned=pinned, positions=places), FairOptions(pin_group="Pin")
    region = LiveRegion(mesh, EYE, options)
    assert pin not in region.free and pin in region.vertices
    for height in (1.05, 1.02):
        places[pin] = height * places[pin] / np.linalg.norm(places[pin])
        answer = region.answer(places[region.vertices], EYE)
        assert answer is not None
        expected = solve(replace(mesh, positions=places.copy()), EYE, options).result.vertices
        np.testing.assert_allclose(answer, expected[np.isin(make_patch(mesh).vertices, region.free)], atol=1e-6)


# The strategies for a live region's surface: which are tried, in which order, and what ends them.
NOWHERE: Any = None


def region(solvable: str, tried: list[str], failing: type[Exception] | None = None) -> Any:
    """A region with one strategy that gives a surface; the others give none, or fail."""

    def strategy(name: str) -> Any:
        def ask(*_arguments: Any) -> Any:
            tried.append(name)
            if name == solvable:
                return np.zeros((1, 3))
            if failing is not None:
                raise failing("no")
            return None

        return ask

    return SimpleNamespace(**{name: strategy(name) for name in ("answer", "afresh", "stand_in")})


def test_a_search_that_was_stopped_tries_no_other_way() -> None:
    tried: list[str] = []
    go_on = iter([True, False])
    with pytest.raises(fairing.Cancelled):
        sought(region("stand_in", tried, fairing.Cancelled), NOWHERE, NOWHERE, lambda *_: next(go_on))
    assert tried == ["afresh"]


@pytest.mark.parametrize("kind", [None, fairing.Cancelled, fairing.SolverError])
def test_where_there_is_none_in_time_another_surface_stands_in(kind: type[Exception] | None) -> None:
    tried: list[str] = []
    assert sought(region("stand_in", tried, kind), NOWHERE, NOWHERE, None).stands_in
    assert tried == ["afresh", "stand_in"]
    assert sought(region("", [], kind), NOWHERE, NOWHERE, None).positions is None


def test_bad_input_gets_no_other_surface() -> None:
    tried: list[str] = []
    with pytest.raises(ValueError, match="no"):
        sought(region("stand_in", tried, ValueError), NOWHERE, NOWHERE, None)
    assert tried == ["afresh"]


def test_the_first_surface_is_near_the_answer() -> None:
    """On the sphere it is nearly the sphere, and where the vertices inside are does not count."""
    mesh = sphere()
    region = LiveRegion(mesh, EYE, FairOptions())
    positions = mesh.positions[region.vertices].copy()
    first = region.first(positions, EYE)
    np.testing.assert_allclose(np.linalg.norm(first, axis=1), 1.0, atol=5e-3)
    positions[np.searchsorted(region.vertices, region.free)] += 0.3
    np.testing.assert_array_equal(region.first(positions, EYE), first)
