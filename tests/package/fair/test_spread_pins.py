"""Pins that lift the surface over a radius: exactly at their place, with an H that no mesh changes."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.special import j0

import fairing
import shapes
from curves import FloatArray
from grids import halves, numbered
from meshing import IntArray
from shapes import Patch


def size(patch: Patch) -> float:
    """D."""
    held = patch.vertices[patch.fixed]
    return 2.0 * float(np.linalg.norm(held - held.mean(axis=0), axis=1).max())


def near(patch: Patch, places: list[tuple[float, float]]) -> IntArray:
    """Free vertices next to places (y, z) of the plane, counted from its middle, in units of D."""
    middle = patch.vertices[patch.fixed].mean(axis=0)
    wanted = middle + size(patch) * np.array([(0.0, y, z) for y, z in places])
    away = np.linalg.norm(patch.vertices[patch.free][:, None] - wanted, axis=2)
    return patch.free[away.argmin(axis=0)]


def lifted(
    patch: Patch, pins: IntArray, lifts: list[float], **options: object
) -> tuple[fairing.FairResult, FloatArray]:
    """The surface, and the (p, 3) places of the pins: lifted by shares of D along the plane's normal."""
    start = patch.vertices.copy()
    start[pins] += size(patch) * np.array(lifts)[:, None] * patch.fixed_normals[0]
    fixed = np.concatenate([patch.fixed, pins])
    normals = np.vstack([patch.fixed_normals, np.zeros((len(pins), 3))])
    result = fairing.fair(start, patch.triangles, fixed=fixed, fixed_normals=normals, **options)  # type: ignore[arg-type]
    assert np.array_equal(result.vertices[pins], start[pins])
    return result, start[pins]


def test_the_profile_is_the_closed_form_of_a_clamped_disc() -> None:
    """A small lift of a disc's middle: Δ²u = λ g with u = u′ = 0 at the rim, integrated in one dimension."""
    disc = shapes.plane(2500)
    held = disc.vertices[disc.fixed]
    middle = held.mean(axis=0)
    stretch = np.abs(held - middle).max(axis=0)
    vertices = np.column_stack([np.zeros(len(disc.vertices)), *((disc.vertices - middle)[:, 1:] / stretch[1:]).T])
    rim = vertices[disc.fixed] / np.linalg.norm(vertices[disc.fixed], axis=1)[:, None]
    vertices[disc.fixed] = rim
    pin = disc.free[np.argmin(np.linalg.norm(vertices[disc.free], axis=1))]
    vertices[pin] = 0.002 * disc.fixed_normals[0]
    fixed = np.append(disc.fixed, pin)
    normals = np.vstack([disc.fixed_normals, np.zeros(3)])
    result = fairing.fair(vertices, disc.triangles, fixed=fixed, fixed_normals=normals, pin_radius=0.1)
    assert result.converged
    radius = np.linalg.norm(result.vertices[:, 1:], axis=1)
    height = result.vertices @ disc.fixed_normals[0] / 0.002
    r, profile = clamped_profile(0.1 * 2.0)
    assert np.abs(height - np.interp(radius, r, profile)).max() < 0.01
    r, narrow = clamped_profile(0.04 * 2.0)
    assert np.abs(height - np.interp(radius, r, narrow)).max() > 0.03


def clamped_profile(rho: float) -> tuple[FloatArray, FloatArray]:
    """r and u(r) / u(0) of the disc of radius 1, by cumulative sums. g: heat after eight implicit steps."""
    r = np.linspace(1e-6, 1.0, 20001)
    step = r[1] - r[0]
    wave = np.linspace(0.0, 60.0 / rho, 4001)
    coarse = np.linspace(0.0, 1.0, 401)
    heat = (j0(wave * coarse[:, None]) * wave * (1.0 + (rho * wave) ** 2 / 16.0) ** -8).sum(axis=1)
    flux = np.cumsum(np.interp(r, coarse, heat) * r) * step / r  # of Δu
    laplacian = np.cumsum(flux) * step
    slope = np.cumsum(laplacian * r) * step / r
    slope -= slope[-1] * r  # a paraboloid, whose Laplacian is constant, clamps the rim
    height = np.cumsum(slope) * step
    height -= height[-1]
    return r, height / height[0]


def test_the_pin_acts_on_its_own_side_of_a_slit() -> None:
    """A flat square with a slit whose edges are held: beyond it, two edges away from the pin, nothing rises."""
    n = 40
    s, t = (x.ravel() for x in np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1), indexing="ij"))
    vertices = np.column_stack([s, t, 0 * s])
    number = numbered(n + 1, n + 1)
    triangles = halves(number)
    border = (s < 1e-9) | (s > 1 - 1e-9) | (t < 1e-9) | (t > 1 - 1e-9)
    slit = (np.abs(s - 0.5) < 1e-9) & (t > 0.2 - 1e-9)
    held = np.flatnonzero(border | slit)
    pin = number[n // 2 + 4, n // 2]
    vertices[pin, 2] = 0.02
    fixed = np.append(held, pin)
    result = fairing.fair(vertices, triangles, fixed=fixed, fixed_normals=np.tile([0.0, 0.0, 1.0], (len(fixed), 1)))
    assert result.converged
    assert "PINS_NOT_SPREAD" not in {reported.code for reported in result.warnings}
    beyond = (s < 0.5 - 1e-9) & (t > 0.4)
    assert np.abs(result.vertices[beyond, 2]).max() < 0.01 * 0.02


def test_a_folded_surface_has_no_spread_pins() -> None:
    """A pin that goes up and aside: the first surface with the radius is folded, the pin is led to another one."""
    patch = shapes.plane(300)
    pin = near(patch, [(0.0, 0.0)])
    pulled = replace(patch, vertices=patch.vertices.copy())
    pulled.vertices[pin, 2] += 0.2 * size(patch)
    result, _ = lifted(pulled, pin, [0.2])
    assert result.equation == "harmonic"
    assert result.converged
    assert not result.warnings
    assert len(fairing.looks.flipped_triangles(result.vertices, patch.triangles)) == 0


def test_a_far_pin_lifts_a_hill_not_a_needle() -> None:
    """0.3 D: beside the surface there is a needle, on one ring of triangles, which converges as well."""
    reported = []
    for n_free in (400, 1600):
        patch = shapes.plane(n_free)
        pin = near(patch, [(0.0, 0.0)])
        result, _ = lifted(patch, pin, [0.3])
        assert result.converged
        assert not result.warnings
        reported.append(float(result.mean_curvature[pin[0]]) * size(patch))
    assert reported[0] == pytest.approx(reported[1], rel=0.05)


def test_the_tip_of_a_needle_is_reported() -> None:
    """As far as the patch is wide, with or without a radius, and in least variation; not on a low hill."""
    patch = shapes.plane(100)
    pin = near(patch, [(0.0, 0.0)])
    for lift, sharp in ((0.1, False), (1.0, True)):
        for how in ({}, {"pin_radius": 0.0}, {"equation": "least_variation"}):
            result, _ = lifted(patch, pin, [lift], **how)  # type: ignore[arg-type]
            assert result.converged or sharp  # at a tip the variation is infinite: its descent may stall
            named = [list(reported.elements) for reported in result.warnings if "tips" in reported.figures]
            assert named == ([[pin[0]]] if sharp else [])


def test_pins_keep_to_points_where_the_curvature_is_joined() -> None:
    """With the reason; where the tangent join has the curvature already, the pin has its radius."""
    codes, pins = [], []
    for patch in (shapes.torus(600), shapes.cap(600)):
        pin = patch.free[[len(patch.free) // 2]]
        pins.append(int(pin[0]))
        fixed = np.concatenate([patch.fixed, pin])
        result = fairing.fair(
            patch.vertices, patch.triangles, fixed=fixed, continuity="G2", fixed_curvatures=patch.mean_curvature[fixed],
            fixed_normals=np.vstack([patch.fixed_normals, np.zeros((1, 3))]),
        )  # fmt: skip
        assert result.converged
        assert result.continuity == "G2"
        codes.append([(reported.code, list(reported.elements)) for reported in result.warnings])
    assert codes[0] == [("PINS_NOT_SPREAD", [pins[0]])]
    assert codes[1] == []


def test_pins_that_are_too_much_say_so() -> None:
    """Lifts to either side that no surface with the radius makes: in points, with the reason."""
    patch = shapes.plane(600)
    pins = near(patch, [(-0.04, 0.0), (0.04, 0.0)])
    result, _ = lifted(patch, pins, [1.0, -1.0], otherwise="stop")
    named = [set(reported.elements) for reported in result.warnings if reported.code == "PINS_NOT_SPREAD"]
    assert named == [set(pins), set(pins)]  # tips of needles, and in points
