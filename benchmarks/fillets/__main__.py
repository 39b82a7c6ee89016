"""Seams of random hard-surface meshes: rows of quads along them as Fair Fillet makes them, and Blender's Bevel.

    python benchmarks/fillets [solids] [count [seed]]

One row for each problem, then the table of docs/quads.md; or of random solids how many are written, and how long it
takes. Seeds that nothing was tuned on, but 1 and 2. Needs bpy.
"""

from __future__ import annotations

import sys
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
sys.path += [str(Path(__file__).resolve().parents[2] / "tests" / part) for part in ("meshes", "tools")]
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

import bevels
import fairing
import solids_at_random
from bevels import corner_angles
from hard_surfaces import MAKERS, FloatArray, Polygons, Problem

COUNT, SEED = 48, 9127
Edge = tuple[int, int]


def problems(count: int, seed: int) -> Iterator[Problem]:
    """One kind of mesh after the other; all hard edges, those at one height, one chain of them, or some."""
    for number in range(count):
        rng = np.random.default_rng([seed, number])
        make = MAKERS[number % len(MAKERS)]
        seam: set[Edge] = set()
        while not seam:
            points, polygons = make(rng)
            uses = Counter((min(e), max(e)) for p in polygons for e in zip(p, [*p[1:], p[0]], strict=True))
            if max(uses.values()) == 2:
                which, seam = _chosen(points, {e for e in bevels.hard_edges(points, polygons) if uses[e] == 2}, rng)
        lengths = [np.linalg.norm(points[a] - points[b]) for a, b in uses]
        arcs = [sum(np.linalg.norm(points[a] - points[b]) for a, b in chain) for chain in _chains(seam)]
        size = np.ptp(points, axis=0).max()
        width = min(rng.uniform(0.25, 0.7) * np.median(lengths), rng.uniform(0.04, 0.15) * size, 0.4 * min(arcs))
        yield Problem(f"{seed}.{number}", f"{make.__name__}, {which}", points, polygons, seam, float(width))


def _chosen(points: FloatArray, hard: set[Edge], rng: Any) -> tuple[str, set[Edge]]:
    chains = _chains(hard)
    which = str(rng.choice(["all", "chain", "height", "some"]))
    if not chains or which == "all":
        return which, hard
    chain = chains[int(rng.integers(len(chains)))]
    if which == "chain":
        return which, set(chain)
    if which == "height":
        height = points[chain[0][0], 2]
        return which, {e for e in hard if abs(points[list(e), 2] - height).max() < 1e-6} or set(chain)
    return which, {e for each in chains if rng.random() < 0.4 for e in each} or set(chain)


def _chains(edges: set[Edge]) -> list[list[Edge]]:
    """Parted where not two of them meet."""
    beside: dict[int, list[int]] = {}
    for a, b in sorted(edges):
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    left, found = set(edges), []
    for start in [*(v for v, others in beside.items() if len(others) != 2), *beside]:
        for other in beside[start]:
            chain, at = [(start, other)], other
            while len(beside[at]) == 2 and at != start:
                before = chain[-1][0]
                at = next((v for v in beside[at] if v != before), before)
                chain.append((chain[-1][1], at))
            named = [(min(e), max(e)) for e in chain]
            if left.issuperset(named):
                left.difference_update(named)
                found.append(named)
    return found


@dataclass(frozen=True)
class Figures:
    """Of one mesh with a rounding."""

    faces: int  # new ones
    quads: float  # share of these
    fit: float  # share of the quads' angles within 50 to 130°
    poles: int  # inner vertices without four faces
    through: int  # loops from outside that leave on the other side,
    ending: int  # of so many that enter


def figures_of(made: bevels.Made) -> Figures:
    points, outside, new = made
    quads = np.array([polygon for polygon in new if len(polygon) == 4]).reshape(-1, 4)
    angles = corner_angles(points, quads) if len(quads) else np.zeros(1)
    around, beyond = Counter(v for p in new for v in p), {v for p in outside for v in p}
    through, ending = _loops(outside + new, _edges(new), set(around) & beyond)
    return Figures(
        len(new), len(quads) / max(1, len(new)), float(((angles >= 50) & (angles <= 130)).mean()),
        sum(count != 4 for v, count in around.items() if v not in beyond), through, ending,
    )  # fmt: skip


def _edges(polygons: Polygons) -> set[frozenset[int]]:
    return {frozenset(edge) for p in polygons for edge in zip(p, [*p[1:], p[0]], strict=True)}


def _loops(polygons: Polygons, inner: set[frozenset[int]], rim: set[int]) -> tuple[int, int]:
    """Walk on over vertices of four edges from each edge outside that comes to the rim: how many leave again."""
    corner = {(a, b): (p, k) for p in polygons for k, (a, b) in enumerate(zip(p, [*p[1:], p[0]], strict=True))}
    leaving: dict[int, list[int]] = {}
    for a, b in corner:
        leaving.setdefault(a, []).append(b)

    def ring(vertex: int) -> list[int]:
        """Its neighbours in their order; none at a border."""
        first, found = leaving[vertex][0], []
        at = first
        while (vertex, at) in corner and len(found) <= len(leaving[vertex]):
            found.append(at)
            polygon, k = corner[vertex, at]
            at = polygon[k - 1]
            if at == first:
                return found
        return []

    through = ending = 0
    for start in rim:
        for other in ring(start):
            if frozenset((start, other)) in inner:
                continue
            ending += 1
            before, at = other, start
            while len(around := ring(at)) == 4:
                onward = around[(around.index(before) + 2) % 4]
                before, at = at, onward
                if frozenset((before, at)) not in inner:
                    through += before != start
                    break
                if at == start:
                    break
    return through, ending


def main(count: int, seed: int) -> None:
    found: list[tuple[bool, Figures, Figures, float, float]] = []
    refused = 0
    for problem in problems(count, seed):
        try:
            start = time.process_time()
            made, rounded = bevels.fillet(problem)
        except ValueError as error:
            print(f"| {problem.name} | {problem.kind} | refused: {error} |", flush=True)
            refused += 1
            continue
        seconds = time.process_time() - start
        own, other = figures_of(made), figures_of(bevels.bevel(problem))
        in_rows = bevels.has_rows(rounded.result)
        off = bevels.off_triangles(problem, made) if in_rows else float("nan")
        found.append((in_rows, own, other, seconds, off))
        for name, each in (("", own), ("Bevel", other)):
            print(
                f"| {problem.name} | {problem.kind} | {name or in_rows} | {each.faces} | {each.fit:.3f} | {each.poles} "
                f"| {each.through} of {each.ending} | " + ("|" if name else f"{seconds:.2f} | {off:.1e} |"),
                flush=True,
            )
    _print_table(found, count, refused)


def _print_table(found: list[tuple[bool, Figures, Figures, float, float]], count: int, refused: int) -> None:
    rows = [each for each in found if each[0]]
    print(f"\n{count} problems, {refused} refused, {len(rows)} in rows; of these:")
    for name, k in (("Bevel", 2), ("Fair Fillet", 1)):
        own = [each[k] for each in rows]
        fit = sum(each.fit >= 0.95 for each in own)
        through, ending = sum(each.through for each in own), sum(each.ending for each in own)
        faces, poles = int(np.median([each.faces for each in own])), sum(each.poles for each in own)
        print(f"| {name} | {faces} | {fit} | {poles} | {through} of {ending} |")
    size = np.array([each[1].faces for each in rows])
    seconds, off = (np.array([each[k] for each in rows]) for k in (3, 4))
    print(f"seconds: median {np.median(seconds):.2f}, for 2,000 faces {np.median(2000 * seconds / size):.2f}")
    print(f"off the triangles: median {np.nanmedian(off):.1e}, most {np.nanmax(off):.1e}")


def solids(count: int, seed: int) -> None:
    """All hard edges of random solids: written or refused, and whether what is written is whole."""
    seconds, codes, spoilt = list[float](), Counter[str](), 0
    for number in range(count):
        rng = np.random.default_rng([seed, number])
        vertices, triangles = (solids_at_random.swept, solids_at_random.blocks)[number % 2](rng)
        borders = len(fairing.boundary_loops(triangles))
        edges = np.linalg.norm(vertices[triangles[:, 0]] - vertices[triangles[:, 1]], axis=1)
        start = time.process_time()
        try:
            mesh, _ = fairing.fillet_edges((vertices, triangles), width=float(edges.mean()))
        except fairing.MeshError as error:
            codes[error.code] += 1
            continue
        seconds.append(time.process_time() - start)
        crossing = fairing.self_intersections(*mesh)
        spoilt += len(crossing) > 0 or len(fairing.boundary_loops(mesh[1])) != borders
    print(f"{len(seconds)} of {count} written, {spoilt} with a crossing or another border; refused: {dict(codes)}")
    print(f"seconds: median {np.median(seconds):.2f}, most {max(seconds):.2f}")


if __name__ == "__main__":
    words = sys.argv[1:]
    run = solids if words[:1] == ["solids"] else main
    numbers = [int(word) for word in words if word.isdigit()]
    run(*(numbers + [COUNT, SEED][len(numbers) :]))
