"""Pins that pull locally: the rest of the surface is that without pins."""

from dataclasses import replace

import numpy as np
import pytest
from addon.arrays.region import MeshArrays
from addon.arrays.types import Floats, Ints
from addon.fair.local_pins import WIDTH, lone_pins, without_lone_pins
from addon.fair.solve import solve
from addon.options.options import FairOptions
from addon.verdict.outcome import outcome

from polygon_mesh import grid, on_sphere, polygon_mesh

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
        WIDTH
        * radius
        * np.ptp(mesh.positions[np.unique(mesh.triangles[mesh.in_patch[mesh.triangle_faces]])], axis=0).max()
    )
    away = np.linalg.norm(plain[:, None] - plain[pins], axis=2).min(axis=1)
    assert not lift[away > reach].any()
    assert lift.max() < 1.05 * lift[pins].max()  # nothing swells beyond a pin
    assert np.count_nonzero(lift > 0.3 * lift[pins].min()) > 3 * len(pins)  # they are hills, not thorns


def test_a_pin_beside_the_boundary_leaves_its_slope_alone() -> None:
    mesh, _ = pinned((0.3, 0.0))
    after = positions(mesh, pin_group="Pins", pin_radius=0.3)
    plain = positions(replace(mesh, pinned=np.zeros_like(mesh.pinned)))
    inside = mesh.triangles[mesh.in_patch[mesh.triangle_faces]]
    rim = np.intersect1d(inside, mesh.triangles[~mesh.in_patch[mesh.triangle_faces]])
    beside = np.setdiff1d(inside[np.isin(inside, rim).any(axis=1)], rim)
    assert np.linalg.norm((after - plain)[beside], axis=1).max() < 0.02 * PULL


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
