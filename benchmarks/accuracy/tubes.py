"""How far the ends of a pipe may lean before no harmonic surface of revolution joins them.

    python benchmarks/accuracy/tubes.py [length in radii …]

Profiles (r, z) with tangent angle φ satisfy r′ = cos φ, z′ = sin φ, φ′ = 2H − sin φ / r, H′ = c / r (then r H′ = c, so
Δ_B H = 0). Both ends have radius 1; their tangents lean by the same angle from the straight pipe, positive: necking.
The straight pipe is followed in that angle until no solution is found with steps of a thousandth of a radian.
"""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_bvp

FloatArray = NDArray[np.float64]
LARGEST = 0.6  # radians
SMALLEST_STEP = 0.001
THINNEST = 0.03  # radius below which a profile counts as pinched off


def solve(length: float, lean: float, guess: Any) -> Any:
    """The profile from a neighbouring one (its x, y, p); p = (c, arc length)."""

    def slope(_: FloatArray, y: FloatArray, p: FloatArray) -> FloatArray:
        r = np.maximum(y[0], 0.5 * THINNEST)
        along = np.vstack([np.cos(y[2]), np.sin(y[2]), 2 * y[3] - np.sin(y[2]) / r, p[0] / r])
        return np.asarray(p[1] * along)

    def ends(a: FloatArray, b: FloatArray, _: FloatArray) -> FloatArray:
        upright = 0.5 * np.pi
        return np.array([a[0] - 1, a[1], a[2] - upright - lean, b[0] - 1, b[1] - length, b[2] - upright + lean])

    return solve_bvp(slope, ends, guess.x, guess.y, p=guess.p, tol=1e-6, max_nodes=40000)


class Straight:
    """The straight pipe as a first guess."""

    def __init__(self, length: float) -> None:
        self.x = np.linspace(0, 1, 400)
        one = np.ones_like(self.x)
        self.y = np.vstack([one, length * self.x, 0.5 * np.pi * one, 0.5 * one])
        self.p = np.array([0.0, length])


def reach(length: float, sign: float) -> tuple[float, float, float]:
    """Largest lean in degrees, and the smallest and largest radius there."""
    last: Any = Straight(length)
    lean, step = 0.0, 0.02
    while step > SMALLEST_STEP and lean < LARGEST:
        tried = solve(length, sign * (lean + step), last)
        if tried.status == 0 and tried.y[0].min() > THINNEST:
            last, lean = tried, lean + step
        else:
            step *= 0.5
    return float(np.degrees(lean)), float(last.y[0].min()), float(last.y[0].max())


def main() -> None:
    """Print the table."""
    lengths = [float(word) for word in sys.argv[1:]] or [3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 12.0]
    print("| length, radii | necking up to, ° | radii there | bulging up to, ° | radii there |\n" + "| --: " * 5 + "|")
    for length in lengths:
        inward, outward = reach(length, 1.0), reach(length, -1.0)
        cells = [f"{angle:.1f} | {low:.2f} … {high:.2f}" for angle, low, high in (inward, outward)]
        print(f"| {length:g} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
