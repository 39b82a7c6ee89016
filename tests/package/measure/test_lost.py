"""What a surface loses: its girth, below the lines that run on across it, and the grain of its surroundings."""

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import fairing

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]
SIZE = 40
HALF = 14  # of the patch, in cells


def sheet() -> tuple[FloatArray, FloatArray, IntArray, npt.NDArray[np.bool_]]:
    """x, y (n,) over [−1, 1]², the triangles of a grid (m, 3), and which of these are in a square in its middle."""
    steps = np.linspace(-1.0, 1.0, SIZE + 1)
    x, y = (places.ravel() for places in np.meshgrid(steps, steps))
    i, j = (index.ravel() for index in np.mgrid[:SIZE, :SIZE])
    a = i * (SIZE + 1) + j
    triangles = np.concatenate(
        [np.column_stack([a, a + 1, a + SIZE + 2]), np.column_stack([a, a + SIZE + 2, a + SIZE + 1])]
    )
    centre = np.stack([x, y], axis=1)[triangles].mean(axis=1)
    return x, y, triangles, np.abs(centre).max(axis=1) < 2.0 * HALF / SIZE


def on_cylinder(x: FloatArray, y: FloatArray, hollow: float) -> tuple[FloatArray, FloatArray]:
    """Points (n, 3) on a cylinder along y with a hollow in its middle, and the cylinder's normals."""
    lost = (
        hollow * np.cos(0.5 * np.pi * np.clip(x / 0.7, -1, 1)) ** 2 * np.cos(0.5 * np.pi * np.clip(y / 0.7, -1, 1)) ** 2
    )
    normals = np.column_stack([np.sin(x), 0.0 * x, np.cos(x)])
    return normals + np.column_stack([0.0 * x, y, 0.0 * x]) - lost[:, None] * normals, normals


def depth(hollow: float) -> float:
    x, y, triangles, inside = sheet()
    points, normals = on_cylinder(x, y, hollow)
    used = np.unique(triangles[inside])
    number = np.full(len(x), -1)
    number[used] = np.arange(len(used))
    return fairing.looks.sunken(points[used], number[triangles[inside]], normals[used])[0]


def test_a_cylinder_does_not_sink_and_a_hollow_one_does() -> None:
    assert abs(depth(0.0)) < 0.004
    found = [depth(hollow) for hollow in (0.05, 0.1, 0.2)]
    # At a line's middle it is as deep as the hollow; the median is over lines of 0.84 to 1.98 that run beside it, too.
    for share, hollow in zip(found, (0.05, 0.1, 0.2), strict=True):
        assert hollow / 1.98 / 2.0 < share < hollow / 0.84


def lost_grain(noise: float, where: str, kept: float = 0.0, ridges: bool = False) -> bool:
    """Whether grain of that many cells is lost where the patch is smoothed to a share of it."""
    x, y, triangles, inside = sheet()
    rng = np.random.default_rng(1)
    height = rng.normal(size=len(x)) * noise * 2.0 / SIZE
    if ridges:
        height = np.where(np.abs(np.round(4.0 * x) - 4.0 * x) < 0.06, 3.0 * noise * 2.0 / SIZE, 0.0)
    free = np.setdiff1d(triangles[inside], triangles[~inside])
    before, after = height.copy(), height.copy()
    after[free] *= kept
    if where == "around":  # the old patch was smooth already
        before[free] = 0.0
    points = [np.column_stack([x, y, 0.3 * np.cos(x) + z]) for z in (before, after)]
    return fairing.looks.has_lost_grain(*points, triangles[inside], triangles[~inside])


@pytest.mark.parametrize(
    ("noise", "where", "options", "is_lost"),
    [
        (0.15, "everywhere", {}, True),
        (0.1, "everywhere", {"kept": 0.8}, False),  # it was put back
        (0.005, "everywhere", {}, False),  # it is not seen
        (0.1, "around", {}, False),  # it was not there
        (0.1, "everywhere", {"ridges": True}, False),  # features are no grain
    ],
)
def test_grain_that_is_gone_is_lost(noise: float, where: str, options: dict[str, Any], is_lost: bool) -> None:
    assert lost_grain(noise, where, **options) == is_lost


def test_what_bends_as_nothing_around_is_rougher() -> None:
    x, y, triangles, inside = sheet()
    rng = np.random.default_rng(2)
    free = np.setdiff1d(triangles[inside], triangles[~inside])

    def rougher(around: float, within: float, share: float = 1.0) -> bool:
        height = rng.normal(size=len(x)) * around * 2.0 / SIZE
        height[free] = rng.normal(size=len(free)) * within * 2.0 / SIZE * (rng.random(len(free)) < share)
        return fairing.looks.is_rougher(np.column_stack([x, y, height]), triangles[inside], triangles[~inside])

    assert rougher(0.0, 0.2)
    assert not rougher(0.2, 0.2)  # as noisy as around
    assert not rougher(0.2, 0.0)
    assert not rougher(0.0, 0.2, share=0.005)  # single places are others' business
