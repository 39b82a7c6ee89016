"""Holes and bridges: exact surfaces, real meshes, peers.

    python benchmarks/fill [hemisphere | peers | truth | caps | shapes | elbows …]

Prints all tables of docs/fill.md, in one run where none is named. Processor time, one thread. `truth` needs
shared/data beside the checkout, `peers` takes what is installed of pymeshfix, PyMeshLab and MeshLib.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

sys.path += [str(Path(__file__).resolve().parents[2] / "tests" / part) for part in ("meshes", "tools")]
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

import bridges
import fairing
import hole_fillers
import holes
import known_surfaces
import measures
import real_meshes
from holes import FloatArray, IntArray

SEED_TRUE, COUNT_TRUE = 6701, 140  # never used otherwise


def timed(vertices: FloatArray, triangles: IntArray, *loops: Any, **options: Any) -> tuple[fairing.FillResult, float]:
    """The filling and its seconds of processor time."""
    start = time.process_time()
    result = fairing.fill(vertices, triangles, *loops, threads=1, **options)
    return result, time.process_time() - start


def shape_of(vertices: FloatArray, result: fairing.FillResult | fairing.RemeshResult) -> str:
    """Least angle of triangles without an edge on the boundary, and the highest valence of a new vertex."""
    points = np.concatenate([vertices, result.vertices])
    inner = (result.triangles < len(vertices)).sum(axis=1) < 2
    angles = holes.angles(points, result.triangles[inner])
    valence = np.bincount(measures.edges(result.triangles).ravel())[len(vertices) :].max()
    return f"{angles.min():.0f}° | {valence}"


def hemisphere() -> Iterator[str]:
    """Rims of a hemisphere, normals from the surroundings."""
    yield "| rim | new vertices | error of the apex | largest error | least angle | valence | s |"
    for edges in (12, 24, 48, 96, 192):
        vertices, triangles = holes.bowl(edges)
        result, seconds = timed(vertices, triangles)
        lengths = np.linalg.norm(result.vertices, axis=1)
        apex = abs(lengths[result.vertices[:, 2].argmax()] - 1)
        shape = shape_of(vertices, result)
        yield f"| {edges} | {len(lengths)} | {apex:.1e} | {abs(lengths - 1).max():.1e} | {shape} | {seconds:.3f} |"


def caps() -> Iterator[str]:
    """Holes of other openings in a sphere, rims of 48 edges."""
    yield "| half-angle | new vertices | converged | largest error | s |"
    for half_angle in (30, 60, 75, 90, 110, 130, 140, 150, 160, 170):
        result, seconds = timed(*holes.bowl(48, half_angle), [np.arange(48)])
        error = abs(np.linalg.norm(result.vertices, axis=1) - 1).max()
        yield f"| {half_angle}° | {len(result.vertices)} | {result.converged} | {error:.1e} | {seconds:.2f} |"


def shapes() -> Iterator[str]:
    """Holes in other surfaces that are known, rims of different fineness."""
    yield from known_surfaces.shapes()


def elbows() -> Iterator[str]:
    """Bridges around bends of radius 1, and by how much they miss the torus."""
    yield "| bend | radius | new vertices | converged | angle | least angle | valence | equation | off the torus | s |"
    for (bend, radius), (vertices, triangles, loops) in bridges.elbows().items():
        result, seconds = timed(vertices, triangles, loops, bridge=True)
        yield (
            f"| {bend:g}° | {radius:g} | {len(result.vertices)} | {result.converged} | "
            f"{result.boundary_angle.max():.1f}° | {shape_of(vertices, result)} | {result.equation} | "
            f"{bridges.off_torus(result.vertices, radius):.3f} | {seconds:.2f} |"
        )


def peers() -> Iterator[str]:
    """The height of a hemisphere's apex that other hole fillers give."""
    others = hole_fillers.installed()
    yield "| rim | " + " | ".join([*others, "ours"]) + " |"
    for edges in (12, 24, 48, 96):
        vertices, triangles = holes.bowl(edges)
        heights = []
        for fill in others.values():
            filled, _ = fill(vertices, triangles, 2 * np.sin(np.pi / edges))
            near_axis = np.hypot(filled[:, 0], filled[:, 1]) + 10 * (filled[:, 2] < -0.5)
            heights.append(f"{filled[near_axis.argmin(), 2]:.3f}")
        ours = fairing.fill(vertices, triangles).vertices
        heights.append(f"{np.linalg.norm(ours[ours[:, 2].argmax()]):.6f}")
        yield f"| {edges} | {' | '.join(heights)} |"


def truth() -> Iterator[str]:
    """Holes cut into real meshes at random: the mean distance of what was there from the surface, in % of the hole."""
    others = {"MeshLib": hole_fillers.installed().get("MeshLib")}
    fillers = {"ours": filled_by_us, **{name: fill for name, fill in others.items() if fill}}
    off: dict[str, list[float]] = {name: [] for name in fillers}
    seconds = dict.fromkeys(fillers, 0.0)
    for patch in real_meshes.random_patches(COUNT_TRUE, SEED_TRUE):
        loops = fairing.boundary_loops(patch.outside)
        if len(loops) != 1:  # the mesh has other holes
            continue
        rim = patch.whole[loops[0]]
        inner = np.delete(patch.vertices, patch.fixed, axis=0)
        length = float(np.linalg.norm(rim - np.roll(rim, 1, axis=0), axis=1).mean())
        for name, fill in fillers.items():
            start = time.process_time()
            try:
                found = abs(fairing.deviation(inner, *fill(patch.whole, patch.outside, length))).mean()
            except fairing.MeshError:
                found = np.inf
            seconds[name] += time.process_time() - start
            off[name].append(100 * found / np.linalg.norm(np.ptp(rim, axis=0)))
    yield "| | holes | not filled | off, median | nine of ten | worst | s, all |"
    for name, values in off.items():
        failed = int(np.isinf(values).sum())
        parts = " | ".join(f"{share:.2g}" for share in np.quantile(values, (0.5, 0.9, 1.0)))
        yield f"| {name} | {len(values)} | {failed} | {parts} | {seconds[name]:.0f} |"
    for name in off.keys() - {"ours"}:
        ours, theirs = np.array(off["ours"]), np.array(off[name])
        yield f"Nearer by a tenth: ours {(ours < 0.9 * theirs).sum()}, {name} {(theirs < 0.9 * ours).sum()}."


def filled_by_us(vertices: FloatArray, triangles: IntArray, _length: float) -> hole_fillers.Mesh:
    """The defaults."""
    result = fairing.fill(vertices, triangles, threads=1)
    return np.concatenate([vertices, result.vertices]), np.concatenate([triangles, result.triangles])


TABLES: dict[str, Callable[[], Iterator[str]]] = {
    "hemisphere": hemisphere, "peers": peers, "caps": caps, "shapes": shapes,
    "elbows": elbows, "truth": truth,
}  # fmt: skip


def main(chosen: list[str]) -> None:
    """The tables named, or all."""
    for name in chosen or TABLES:
        print(f"\n{name}: {TABLES[name].__doc__}\n")
        for line in TABLES[name]():
            print(line, flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
