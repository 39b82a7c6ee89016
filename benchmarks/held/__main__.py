"""What holds inside a patch: tables of docs/curves.md.

Means and worst of meshes and noises of seeds that nothing was tuned on: limits and smoothing were tried on 0 and 1.

python benchmarks/held [creases | fades | pins | pulled | windows …]
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

import creased
import fairing
import pulled
import shapes
import test_held_curves
import test_spread_pins
import windows
from engine import FloatArray

SEEDS = range(2, 8)


def _averaged(patch: creased.Creased) -> FloatArray:
    """Normals (k, 3) at the fixed vertices, the mean of both exact sides on the curve."""
    sums = np.zeros_like(patch.vertices)
    for triangle in patch.triangles:
        a, b, c = patch.vertices[triangle]
        normal = np.cross(b - a, c - a)
        sums[triangle] += normal / np.linalg.norm(normal)
    normals = patch.normals.copy()
    normals[patch.curve] = sums[patch.curve]
    return normals[patch.fixed]


def _fair(patch: creased.Creased, crease: bool, seed: int = 0) -> fairing.FairResult:
    return fairing.fair(
        patch.noisy(0.25, seed), patch.triangles, fixed=patch.fixed, fixed_normals=_averaged(patch),
        creases=patch.curve if crease else None, threads=1,
    )  # fmt: skip


def _told(values: list[float], form: str = ".1e") -> str:
    return f"{np.mean(values):{form}} ({np.max(values):{form}})"


def creases() -> None:
    """Largest distances to the exact sides over D."""
    for name, make in (("box edge", creased.box_edge), ("box corner", creased.box_corner), ("lid", creased.lid)):
        for n in (5, 8) if name == "lid" else (8, 16):
            patches = [make(n, seed) for seed in SEEDS]
            cells = [
                _told([p.error(_fair(p, crease, seed).vertices) for seed, p in zip(SEEDS, patches, strict=True)])
                for crease in (False, True)
            ]
            print(f"| {name}, {len(patches[0].free)} | {cells[0]} | {cells[1]} |", flush=True)


def _peak_at_tip(n: int, seed: int) -> float:
    patch = creased.fading_fold(n, seed)
    result = _fair(patch, True, seed)
    tip = patch.curve[np.argmax(patch.vertices[patch.curve, 1])]
    near = patch.free[np.linalg.norm(result.vertices - result.vertices[tip], axis=1)[patch.free] < 0.25]
    return float(np.abs(result.mean_curvature[near]).max())


def fades() -> None:
    """Largest |H| near the end of a fold, and on a lifted smooth curve."""
    for n in (12, 24):
        free = len(creased.fading_fold(n).free)
        print(f"| fold, {free} | {_told([_peak_at_tip(n, seed) for seed in SEEDS], '.2f')} |", flush=True)
    for n in (12, 24, 48):
        patch, result = test_held_curves.lifted_line(n)
        inside = np.setdiff1d(np.arange(len(result.vertices)), patch.outline)
        print(f"| smooth curve, {len(inside)} | {np.abs(result.mean_curvature[inside]).max():.2f} |", flush=True)


def pins() -> None:
    """H at a pin that lifts a disc's middle by 0.1 D."""
    for n_free in (1000, 4000, 16000):
        patch = shapes.plane(n_free)
        pin = test_spread_pins.near(patch, [(0.0, 0.0)])
        told = []
        for radius in (0.0, 0.1):
            result, _ = test_spread_pins.lifted(patch, pin, [0.1], pin_radius=radius, threads=1)
            told.append(float(result.mean_curvature[pin[0]]) * test_spread_pins.size(patch))
        print(f"| {n_free} | {told[0]:.2f} | {told[1]:.2f} |", flush=True)


def pulled_pins() -> None:
    """Pins pulled off surfaces: what became of them, seconds, and whether a noisy start gives the same."""
    for n_free in (300, 1000):
        pulled.told(pulled.exact_cases(2, n_free))


def _opened(kind: windows.Kind, around: int, seed: int, own_edge: bool) -> list[float]:
    """Distances off the border before, after, and of the best least-squares fit; off the surface before and after."""
    window = windows.window(kind, around, seed)
    start = window.noisy(0.25, seed, edge=window.border_edge if own_edge else window.edge)
    result = fairing.fair(
        start, window.triangles, fixed=window.outline, fixed_normals=window.normals, open_border="faired", threads=1
    )
    if not result.converged:
        raise RuntimeError(f"{kind}, {around} around, seed {seed}: {result.termination}")
    border = [window.off_border(start), window.off_border(result.vertices), window.least_squares(start)]
    return border + [float(window.off_surface(points).max()) for points in (start, result.vertices)]


def noisy_windows() -> None:
    """Distances of noisy windows to the exact border and the exact surface; noise by the border's edge, by the mean."""
    for own_edge in (True, False):
        for around in (24, 48, 96):
            for kind in ("cylinder", "sphere"):
                rows = [_opened(kind, around, seed, own_edge) for seed in SEEDS]  # type: ignore[arg-type]
                forms = (".3f", ".4f", ".4f", ".3f", ".0e")
                cells = [_told([row[k] for row in rows], form) for k, form in enumerate(forms)]
                print(f"| {'own' if own_edge else 'mean'}, {around}, {kind} | {' | '.join(cells)} |", flush=True)


TABLES: dict[str, Callable[[], None]] = {
    "creases": creases, "fades": fades, "pins": pins, "pulled": pulled_pins, "windows": noisy_windows,
}  # fmt: skip


def main() -> None:
    for name in sys.argv[1:] or TABLES:
        TABLES[name]()


if __name__ == "__main__":
    main()
