"""Open borders that become fair: noisy windows in cylinders and spheres."""

import numpy as np
import pytest

import fairing
import windows
from windows import Kind, Window


def fair(window: Window, start: np.ndarray, **options: object) -> fairing.FairResult:  # type: ignore[type-arg]
    return fairing.fair(start, window.triangles, fixed=window.outline, fixed_normals=window.normals, **options)  # type: ignore[arg-type]


@pytest.mark.parametrize("kind", ["cylinder", "sphere"])
@pytest.mark.parametrize("around", [24, 48])
def test_a_noisy_window_comes_back(kind: Kind, around: int) -> None:
    """From noise of a quarter edge along each axis: the surface to 1e-6, and half of the border's noise goes."""
    window = windows.window(kind, around, 3)
    start = window.noisy(0.25, 4)
    result = fair(window, start, open_border="faired")
    assert result.converged
    assert result.equation == "least_variation"
    assert window.off_surface(result.vertices).max() < 1e-6
    assert window.off_border(result.vertices) < 0.55 * window.off_border(start)
    assert "OPEN_BORDER_IN_SELECTION" not in {reported.code for reported in result.warnings}
    assert np.isin(window.border, result.fixed).sum() == 0
    assert np.array_equal(result.vertices[window.outline], start[window.outline])


def test_the_fair_curve_does_not_drift_within_the_surface() -> None:
    """Another noise across the surface alone leaves the border where it is within the surface, to .01 edges."""
    window = windows.window("sphere", 24, 11)
    start = window.noisy(0.25, 11)
    lifted = start * (1.0 + 0.03 * np.cos(5 * np.arange(len(start))))[:, None]
    lifted[window.outline] = window.vertices[window.outline]
    places = [fair(window, points, open_border="faired").vertices[window.border] for points in (start, lifted)]
    assert np.linalg.norm(places[0] - places[1], axis=1).max() < 0.01 * window.border_edge


def test_a_border_between_held_ends_meets_them() -> None:
    """Two thirds of the window are in the selection; the rest of its border is fixed."""
    window = windows.window("sphere", 48, 5)
    kept = window.border[:16]
    fixed = np.concatenate([window.outline, kept])
    start = window.noisy(0.25, 6)
    start[kept] = window.vertices[kept]
    result = fairing.fair(
        start, window.triangles, fixed=fixed, fixed_normals=window.vertices[fixed], open_border="faired"
    )
    assert result.converged
    assert window.off_surface(result.vertices).max() < 1e-6
    assert np.array_equal(result.vertices[kept], start[kept])
    assert window.off_border(result.vertices) < 0.55 * window.off_border(start)


def test_a_fair_border_keeps_its_place() -> None:
    window = windows.window("sphere", 48, 7)
    result = fair(window, window.vertices, open_border="faired")
    edge = np.linalg.norm(window.vertices[window.border[1]] - window.vertices[window.border[0]])
    assert np.linalg.norm(result.vertices - window.vertices, axis=1)[window.border].max() < 0.01 * edge
