"""Surfaces of least variation against their goals: pipes, tapers, elbows, bends, joints, mesh independence.

    python benchmarks/variation [--seed 81] [pipe | taper | elbow | bend | joint | agreement | start | order | …]

With the paths of `benchmarks/accuracy`. Radii and distances in radii of the tube, D as everywhere.
"""

from __future__ import annotations

import argparse
import itertools
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))

import fairing
import joints
import measures
import profiles
import shapes
import tubes
from joints import Arm, flat_arm
from tubes import FloatArray, Tube

MOST_STEPS = 60
Row = tuple[str, str, bool]  # name, what was measured, whether the goal is met


@dataclass(frozen=True)
class Solved:
    """A result and the seconds of CPU that it took."""

    result: fairing.FairResult
    seconds: float

    @property
    def sound(self) -> bool:
        """Converged without any warning: no crossings, no flips."""
        return bool(self.result.converged) and not self.result.warnings

    @property
    def text(self) -> str:
        """Steps, sizes, seconds and warnings."""
        codes = " ".join(warning.code for warning in self.result.warnings)
        return f"{self.result.iterations} steps, {self.result.levels[-1]} vertices, {self.seconds:.2f} s {codes}"


def solved(tube: Tube) -> Solved:
    """One thread, from the outline alone."""
    start = time.process_time()
    result = tube.faired(max_iterations=MOST_STEPS)
    return Solved(result, time.process_time() - start)


def radii(result: fairing.FairResult) -> FloatArray:
    """Distances from the axis of a straight tube."""
    return np.asarray(np.hypot(result.vertices[:, 0], result.vertices[:, 1]))


def pipe_rows(seed: int) -> Iterator[Row]:
    """Radius within [0.8, 1.2] where the ends lean by 10° at most."""
    for length in (3.0, 5.0, 7.0, 10.0):
        for lean in (-15.0, -10.0, -5.0, 0.0, 5.0, 10.0, 15.0):
            made = solved(tubes.pipe(length, lean, seed=seed))
            low, high = float(radii(made.result).min()), float(radii(made.result).max())
            met = made.sound and (abs(lean) > 10 or 0.8 <= low <= high <= 1.2)
            yield f"pipe {length:g} leaning {lean:g}°", f"radius {low:.3f} … {high:.3f}, {made.text}", met


def taper_rows(seed: int) -> Iterator[Row]:
    """Unequal radii: no bulge where the ends don't lean outwards."""
    for last in (0.75, 0.5, 0.35):
        for lean in (-10.0, 0.0, 5.0, 10.0):
            made = solved(tubes.pipe(5.0, lean, (1.0, last), seed=seed))
            low, high = float(radii(made.result).min()), float(radii(made.result).max())
            met = made.sound and (lean < 0 or high < 1 + 1e-6)
            yield f"taper to {last:g} leaning {lean:g}°", f"radius {low:.3f} … {high:.3f}, {made.text}", met


def elbow_rows(seed: int) -> Iterator[Row]:
    """90° within 0.05 of the torus."""
    for bend in (2.0, 3.0):
        for degrees in (30.0, 60.0, 90.0, 120.0, 150.0, 180.0):
            made = solved(tubes.elbow(bend, degrees, seed=seed))
            off = tubes.off_torus(made.result.vertices, bend)
            met = made.sound and (degrees != 90 or off < 0.05)
            yield f"elbow {degrees:g}° of radius {bend:g}", f"{off:.3f} off the torus, {made.text}", met


def bend_rows(seed: int) -> Iterator[Row]:
    """An answer without crossings."""
    for bend, degrees in ((3.0, 45.0), (3.0, 90.0), (2.5, 60.0)):
        made = solved(tubes.s_bend(bend, degrees, seed=seed))
        yield f"S-bend {degrees:g}° of radius {bend:g}", made.text, made.sound


# Each with the radius of its widest tube 1.
JOINTS = {
    "radii 1, 1, 1 at 120°": [flat_arm(0), flat_arm(120), flat_arm(240)],
    "radii 1, 0.7, 0.5 at 120°": [flat_arm(0), flat_arm(120, 0.7), flat_arm(240, 0.5)],
    "the same, leaning 8°, −8°, 5°": [
        flat_arm(0, 1.0, 3.0, 8.0), flat_arm(120, 0.7, 3.0, -8.0), flat_arm(240, 0.5, 3.0, 5.0),
    ],
    "T, radii 1, 1, 0.5": [flat_arm(0), flat_arm(180), flat_arm(90, 0.5, 2.5)],
    "Y of 70°, radii 1, 0.8, 0.5": [flat_arm(180), flat_arm(35, 0.8, 4.0), flat_arm(-35, 0.5, 4.0)],
    "finger of radius 0.3 on a pipe": [flat_arm(0), flat_arm(180), flat_arm(60, 0.3, 2.5)],
    "corner, radii 1, 0.7, 0.5": [Arm((1, 0, 0)), Arm((0, 1, 0), 0.7), Arm((0, 0, 1), 0.5)],
    "arms of 6, 7 and 10 radii": [flat_arm(0, 1.0, 6.0), flat_arm(120, 0.7, 5.0), flat_arm(240, 0.5, 5.0)],
}  # fmt: skip


def joint_rows(seed: int) -> Iterator[Row]:
    """Three tubes that meet: an answer without crossings, from three meshes the same."""
    for name, arms in JOINTS.items():
        for around in (24, 36):
            tubes_ = [joints.joint(arms, around=around, seed=seed + k) for k in range(3)]
            made = [solved(tube) for tube in tubes_]
            crossed = sum(
                len(fairing.self_intersections(one.result.vertices, tube.triangles)) > 0
                for tube, one in zip(tubes_, made, strict=True)
            )
            met = all(one.result.converged for one in made) and not crossed
            text = "; ".join(one.text for one in made)
            yield f"{name}, {around} around", f"{100 * _mesh_distance(tubes_, made):.2f} % of D apart, {text}", met


def _mesh_distance(inputs: list[Tube], made: list[Solved]) -> float:
    """Largest distance between two of three surfaces, chords included, in units of D."""
    surfaces = [(one.result.vertices, tube.triangles) for tube, one in zip(inputs, made, strict=True)]
    pairs = [(0, 1), (0, 2), (1, 2)]
    return max(measures.two_sided_distance(surfaces[i], surfaces[j]) for i, j in pairs) / inputs[0].diameter


def elbow_agreement_rows(seed: int) -> Iterator[Row]:
    """Three irregular meshes of an elbow within 0.3 % of D of each other, chords left out."""
    for around, bend, degrees in itertools.product((24, 36), (2.0, 3.0), (60.0, 90.0, 120.0, 150.0, 180.0)):
        inputs = [tubes.elbow(bend, degrees, around=around, seed=seed + k) for k in range(3)]
        made = [solved(tube) for tube in inputs]
        surfaces = [one.result.vertices for one in made]
        away = max(
            tubes.apart(inputs[i], surfaces[i], surfaces[j], bend) for i, j in itertools.permutations(range(3), 2)
        ) / inputs[0].diameter  # fmt: skip
        off = max(tubes.off_torus(surface, bend) for surface in surfaces)
        text = f"{100 * away:.2f} % of D apart, {off:.3f} off the torus, {'; '.join(one.text for one in made)}"
        yield f"elbow {degrees:g}° of radius {bend:g}, {around} around", text, away < 3e-3


def agreement_rows(seed: int) -> Iterator[Row]:
    """Three irregular meshes within 0.3 % of D of each other, the rims' chords included."""
    shapes: dict[str, Callable[[int], Tube]] = {
        "pipe 5 leaning 5°": lambda own: tubes.pipe(5.0, 5.0, around=36, seed=own),
        "pipe 10 leaning 5°": lambda own: tubes.pipe(10.0, 5.0, around=36, seed=own),
        "taper to 0.5 leaning 5°": lambda own: tubes.pipe(5.0, 5.0, (1.0, 0.5), around=36, seed=own),
        "elbow 90°": lambda own: tubes.elbow(3.0, 90.0, around=36, seed=own),
        "S-bend 60° of radius 2.5": lambda own: tubes.s_bend(2.5, 60.0, around=36, seed=own),
    }
    for name, make in shapes.items():
        made = [(tube, solved(tube)) for tube in map(make, range(seed, seed + 3))]
        away = _mesh_distance([tube for tube, _ in made], [one for _, one in made])
        met = away < 3e-3 and all(one.result.converged for _, one in made)
        yield f"three meshes, {name}", f"{100 * away:.2f} % of D from each other", met


def start_rows(seed: int) -> Iterator[Row]:
    """Four interiors of noise: the same surface within 1e-4 D."""
    shapes = {
        "pipe 5 leaning 10°": tubes.pipe(5.0, 10.0, seed=seed),
        "taper to 0.5 leaning 5°": tubes.pipe(5.0, 5.0, (1.0, 0.5), seed=seed),
        "elbow 90° of radius 3": tubes.elbow(3.0, 90.0, seed=seed),
        "elbow 150° of radius 2": tubes.elbow(2.0, 150.0, seed=seed),
        "S-bend 60° of radius 2.5": tubes.s_bend(2.5, 60.0, seed=seed),
    }
    for name, tube in shapes.items():
        made = [tube.faired(max_iterations=MOST_STEPS, seed=k).vertices for k in range(4)]
        away = max(float(np.linalg.norm(other - made[0], axis=1).max()) for other in made[1:]) / tube.diameter
        yield f"four starts, {name}", f"{away:.1e} D apart", away < 1e-4


def order_rows(seed: int) -> Iterator[Row]:
    """Least radius against the profile of one dimension."""
    exact = float(profiles.least(profiles.Ends(1.0, 1.0, 5.0, 10.0)).r.min())
    last = np.nan
    for around in (16, 24, 36, 54):
        made = solved(tubes.pipe(5.0, 10.0, around=around, seed=seed))
        error = abs(float(radii(made.result).min()) - exact)
        order = np.log(last / error) / np.log(1.5)
        yield f"pipe 5 leaning 10°, {around} edges around", f"error {error:.5f}, order {order:.1f}, {made.text}", True
        last = error


def functional_rows(seed: int) -> Iterator[Row]:
    """Least and largest radius of pipes, by one-dimensional profiles, for three functionals."""
    for functional in ("all directions", "principal lines", "mean curvature"):
        for length, lean in ((5.0, 5.0), (5.0, 10.0), (10.0, 10.0), (10.0, -10.0)):
            name = f"{functional}, pipe {length:g} leaning {lean:g}°"
            try:
                r = profiles.least(profiles.Ends(1.0, 1.0, length, lean), functional, functional == "all directions").r
            except RuntimeError as error:
                yield name, str(error), False
                continue
            yield name, f"radius {r.min():.3f} … {r.max():.3f}", bool(0.8 <= r.min() <= r.max() <= 1.2)


PACE_SHAPES = {"cylinder": shapes.cylinder, "catenoid": shapes.catenoid, "r H' = c": shapes.linear_flux}
PACE_STYLES = {"regular": shapes.Style(jitter=0.0), "irregular": shapes.Style(layout="random", stretch=2.5, jitter=0.0)}


def pace_rows(seed: int) -> Iterator[Row]:
    """At most three times as long as the harmonic surface; one thread, CPU."""
    for count, (name, make), (kind, style) in itertools.product(
        (1000, 10_000, 50_000), PACE_SHAPES.items(), PACE_STYLES.items()
    ):
        patch = make(count, replace(style, seed=seed))
        boundary = fairing.Boundary(vertices=patch.fixed, normals=patch.fixed_normals)

        def seconds(
            equation: str, patch: shapes.Patch = patch, boundary: fairing.Boundary = boundary
        ) -> tuple[float, bool]:
            start = time.process_time()
            options = fairing.Options.of(equation=equation)
            result = fairing.fair(shapes.start_from_nothing(patch), patch.triangles, boundary, options, threads=1)
            return time.process_time() - start, bool(result.converged)

        harmonic, _ = seconds("harmonic")
        even, converged = seconds("least_variation")
        ratio = even / harmonic
        yield f"{name}, {kind}, {count:,}", f"{ratio:.1f} times the harmonic {harmonic:.3f} s", converged and ratio <= 3


TABLES = (
    pipe_rows, taper_rows, elbow_rows, bend_rows, joint_rows, agreement_rows, elbow_agreement_rows, start_rows,
    order_rows, functional_rows, pace_rows,
)  # fmt: skip


def main() -> None:
    """Print the tables; a miss is marked."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("words", nargs="*", help="tables whose names hold one of these; all without any")
    parser.add_argument("--seed", type=int, default=81, help="of the irregular meshes, the next ones too")
    asked = parser.parse_args()
    for table in TABLES:
        if asked.words and not any(word in table.__name__ for word in asked.words):
            continue
        for name, text, met in table(asked.seed):
            print(f"| {name} | {text} | {'met' if met else 'MISS'} |", flush=True)


if __name__ == "__main__":
    main()
