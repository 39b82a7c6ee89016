"""What fades: the band around the patch, and pins that pull locally."""

from dataclasses import replace
from functools import cache
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from addon.arrays.region import MeshArrays
from addon.arrays.types import Floats, Ints
from addon.fair.local_pins import WIDTH as REACH
from addon.fair.local_pins import lone_pins, pulled, without_lone_pins
from addon.fair.solve import pose, solve
from addon.options.options import FairOptions
from addon.verdict.outcome import Fairing, outcome

import fairing
from polygon_mesh import grid, on_sphere, polygon_mesh

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


def test_what_is_pinned_hidden_or_on_a_border_stays_in_the_band() -> None:
    mesh = swollen()
    usual = band(mesh, fair(mesh, falloff=WIDTH))
    pin = int(usual[0])
    pinned = mesh.pinned.copy()
    pinned[pin] = True
    hidden = np.zeros(len(mesh.in_patch), dtype=bool)
    hidden[mesh.corner_faces[mesh.corner_vertices == usual[-1]][0]] = True
    of_hidden = mesh.corner_vertices[hidden[mesh.corner_faces]]
    done = fair(replace(mesh, pinned=pinned, hidden=hidden), falloff=WIDTH)
    assert np.array_equal(band(mesh, done), np.setdiff1d(usual, [pin, *of_hidden]))
    wide = fair(mesh, falloff=2.0)
    rows = np.arange((SIZE + 1) ** 2).reshape(SIZE + 1, SIZE + 1)
    assert np.array_equal(wide.vertices, rows[1:-1, 1:-1].ravel())


def test_the_mirror_holds_in_the_band() -> None:
    mesh = replace(swollen(), mirror_x=True)
    rows = np.arange((SIZE + 1) ** 2).reshape(SIZE + 1, SIZE + 1)
    points = mesh.positions.copy()
    points[rows[:, ::-1][:, : SIZE // 2]] = points[rows[:, : SIZE // 2]] * (-1.0, 1.0, 1.0)
    points[rows[:, SIZE // 2], 0] = 0.0
    free = fair(mesh).vertices
    points[free] *= 1.0 + 0.02 * np.random.default_rng(3).normal(size=(len(free), 1))  # only there is it not symmetric
    mesh = replace(mesh, positions=points)
    done = fair(mesh, falloff=WIDTH)
    assert not any("mirror" in warning for warning in done.warnings)
    after = points.copy()
    after[done.vertices] = done.positions
    assert np.array_equal(after[rows], after[rows[:, ::-1]] * (-1.0, 1.0, 1.0))
    pinned = mesh.pinned.copy()
    pinned[band(mesh, done)[0]] = True
    lopsided = fair(replace(mesh, pinned=pinned), falloff=WIDTH)
    assert any("X mirror is on, but the selection is not symmetric" in warning for warning in lopsided.warnings)


BY_GROUP = {"vertex_group": "Soft"}  # `MeshArrays.parts` are its weights


def weighed(parts: Floats) -> Fairing:
    return fair(replace(swollen(), parts=parts), **BY_GROUP)


def soft(reach: float) -> Floats:
    """Weights that fall off around the middle, to 0 at this distance from it."""
    away = np.linalg.norm(swollen().positions[:, :2], axis=1)
    return np.asarray(np.clip(1.5 - 1.5 * away / reach, 0.0, 1.0))


def test_weights_are_the_engines() -> None:
    """Patch and band go as `fair(weights=…)` says; vertices without a weight keep their bits, inside too."""
    mesh, parts = swollen(), soft(0.6)
    done = weighed(parts)
    problem = pose(replace(mesh, parts=parts), EYE, FairOptions(**BY_GROUP))[0]
    patch = problem.patch
    own = fairing.fair(
        problem.points, patch.triangles, fixed=patch.fixed, fixed_normals=problem.normals, outside=problem.outside,
        weights=parts[problem.vertices],
    )  # fmt: skip
    number = np.searchsorted(problem.vertices, done.vertices, sorter=np.argsort(problem.vertices))
    assert np.array_equal(done.positions, own.vertices[np.argsort(problem.vertices)[number]])
    assert np.array_equal(done.vertices, np.flatnonzero(parts > 0.0))
    narrow = weighed(soft(0.3))
    assert np.array_equal(narrow.vertices, np.flatnonzero(soft(0.3) > 0.0))
    assert len(narrow.vertices) < len(fair(mesh).vertices)


def test_weights_elsewhere_are_left_alone() -> None:
    """Only what weights join to the selection takes part: not the other end of the group."""
    apart = soft(0.5)
    corner = np.linalg.norm(swollen().positions - swollen().positions[2 * (SIZE + 1) + 2], axis=1) < 0.06
    assert corner.any()
    assert not apart[corner].any()
    with_corner = weighed(np.where(corner, 1.0, apart))
    assert np.array_equal(with_corner.vertices, weighed(apart).vertices)
    assert not np.isin(np.flatnonzero(corner), with_corner.vertices).any()


def test_feather_and_weights_are_multiplied() -> None:
    """So features in the band are painted out."""
    mesh = swollen()
    left = (mesh.positions[:, 0] < 0.0).astype(np.float64)
    both = fair(replace(mesh, parts=left), falloff=WIDTH, **BY_GROUP)
    whole = fair(mesh, falloff=WIDTH)
    assert np.array_equal(both.vertices, whole.vertices[left[whole.vertices] > 0.0])


@pytest.mark.parametrize("options", [{"falloff": 0.2}, {"detail": 1.0}], ids=str)
def test_a_closed_piece_is_refused_for_what_it_is(options: dict[str, float]) -> None:
    """With a band or its old skin, too: there is no boundary that could say how far around to look."""
    corners = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
    sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    mesh = polygon_mesh(corners, sides, np.ones(6, dtype=bool))
    with pytest.raises(ValueError, match=r"nothing (is left to hold|holds)"):
        fair(mesh, **options)


# Pins that pull locally: the rest of the surface is that without pins.
PULL = 0.06  # a tenth of the selection's half-width


SPHERE = grid(32, 0.6, on_sphere)


def positions(mesh: MeshArrays, **options: str | float) -> Floats:
    """All vertices after a run."""
    chosen = FairOptions(**options)  # type: ignore[arg-type]
    found = outcome(mesh, np.eye(4), chosen, solve(mesh, np.eye(4), chosen))
    assert found.verdict.grade == "GOOD"
    after = mesh.positions.copy()
    after[found.vertices] = found.positions
    return after


def pinned(*at: tuple[float, float]) -> tuple[MeshArrays, Ints]:
    """The sphere with vertices pulled out of it and pinned."""
    points, pinned = SPHERE.positions.copy(), np.zeros(len(SPHERE.positions), dtype=bool)
    for place in at:
        pin = int(np.linalg.norm(points[:, :2] - place, axis=1).argmin())
        pinned[pin] = True
        points[pin] *= 1.0 + PULL
    return replace(SPHERE, positions=points, pinned=pinned), np.flatnonzero(pinned)


@pytest.mark.parametrize("radius", [0.05, 0.1])
def test_three_pins_lift_the_surface_around_them_and_nothing_else(radius: float) -> None:
    mesh, pins = pinned((0.2, 0.0), (-0.15, 0.2), (-0.1, -0.25))
    assert lone_pins(mesh).nonzero()[0].tolist() == pins.tolist()
    after = positions(mesh, pin_group="Pins", pin_radius=radius)
    assert np.array_equal(after[pins], mesh.positions[pins])
    plain = positions(replace(mesh, pinned=np.zeros_like(mesh.pinned)))
    lift = np.linalg.norm(after - plain, axis=1)
    reach = (
        REACH
        * radius
        * np.ptp(mesh.positions[np.unique(mesh.triangles[mesh.in_patch[mesh.triangle_faces]])], axis=0).max()
    )
    away = np.linalg.norm(plain[:, None] - plain[pins], axis=2).min(axis=1)
    assert not lift[away > reach].any()
    assert lift.max() < 1.05 * lift[pins].max()  # nothing swells beyond a pin
    assert np.count_nonzero(lift > 0.3 * lift[pins].min()) > 3 * len(pins)  # they are hills, not thorns


def test_pins_in_a_row_are_a_curve() -> None:
    mesh, pins = pinned((0.2, 0.0))
    edge = mesh.edges[(mesh.edges == pins[0]).any(axis=1)][0]
    assert not lone_pins(replace(mesh, pinned=np.isin(np.arange(len(mesh.pinned)), edge))).any()


def test_pins_that_alone_hold_a_closed_surface_hold_it_as_a_whole() -> None:
    mesh, pins = pinned((0.2, 0.0), (-0.15, 0.2))
    options = FairOptions(pin_group="Pins")
    assert without_lone_pins(mesh, options)[1].nonzero()[0].tolist() == pins.tolist()
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    closed = polygon_mesh(corners, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]], [True] * 4)
    closed = replace(closed, pinned=np.arange(4) == 0)
    assert without_lone_pins(closed, options)[0] is closed


def test_a_pin_leaves_the_far_side_of_something_thin_alone() -> None:
    x, y = (np.arange(81) % 9 / 8.0, np.arange(81) // 9 / 8.0)
    top = np.stack([x, y, np.zeros(81)], axis=1)
    cells = np.array([[k, k + 1, k + 10] for k in range(71) if k % 9 < 8])
    sheets = np.concatenate([top, top - [0.0, 0.0, 0.01]])
    own = sheets.copy()
    own[40, 2] = 0.1
    patch = SimpleNamespace(
        vertices=np.arange(162), triangles=np.concatenate([cells, cells[:, ::-1] + 81]), fixed=np.arange(0)
    )
    problem: Any = SimpleNamespace(patch=patch, own_points=own)
    lift = (pulled(problem, sheets, np.arange(162) == 40, 0.1) - sheets)[:, 2]
    assert lift[40] == 0.1
    assert np.count_nonzero(lift) > 1
    assert not lift[81:].any()
