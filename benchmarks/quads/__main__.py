"""Quads over holes of real meshes: rows as *Fair Fill* writes them, and what others make of the same holes.

    python benchmarks/quads [real | sizes | peers | picture …]

`real` prints one row for each hole, `peers` one for each program that is installed, `sizes` patches at four sizes.
All need shared/data beside the checkout. Seeds that nothing was tuned on.
"""

from __future__ import annotations

import multiprocessing
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

import fairing
import peers as others
from cases import Hole, natural, random_discs, subdivided
from holes import FloatArray
from judged import Figures, figures_of

SEED = 5408
LONGEST = 30.0  # seconds that a peer may take
FINEST = 240  # edges of a boundary over which surfaces are compared
MOST = 320  # edges of a boundary when parted


def filled(hole: Hole, faces: str = "quads", spacing: float = 0.0) -> tuple[fairing.FillResult, float]:
    """The result and its seconds of processor time, one thread."""
    start = time.process_time()
    options = {"faces": faces, "spacing": spacing, "edges": "ignored", "threads": 1}
    result = fairing.fill(hole.points, hole.outside, [hole.loop], **options)
    return result, time.process_time() - start


def off_fine(hole: Hole, *results: fairing.FillResult) -> list[float]:
    """How far new vertices are from the surface in triangles a fifth as long, over its D."""
    rim = hole.points[hole.loop]
    edge = float(np.linalg.norm(np.roll(rim, -1, axis=0) - rim, axis=1).mean())
    fine, _ = filled(hole, "triangles", 0.2 * edge)
    corners = np.concatenate([hole.points, fine.vertices])[fine.triangles]
    size = 2 * float(np.linalg.norm(rim - rim.mean(axis=0), axis=1).max())
    return [float(_distances(each.vertices, corners).max(initial=0.0)) / size for each in results]


def _distances(at: FloatArray, corners: FloatArray) -> FloatArray:
    """(k,) to the planes of the nearest triangles by their middles, or to what is nearer of 5 of them."""
    _, near = cKDTree(corners.mean(axis=1)).query(at, k=min(5, len(corners)))
    a, b, c = np.moveaxis(corners[near.reshape(len(at), -1)], 2, 0)
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    height: FloatArray = np.abs(((at[:, None] - a) * normals).sum(axis=-1)).min(axis=1)
    return height


def row_of(hole: Hole) -> tuple[str, Figures | None, dict[str, Any]]:
    """One line, the figures of the quads, and whether they are in rows."""
    try:
        result, seconds = filled(hole)
    except fairing.MeshError as error:
        return f"| {hole.name} | {len(hole.loop)} | refused: {error.code} |", None, {}
    assert result.quads is not None
    faces = result.quads.quads.tolist() + result.quads.triangles.tolist()
    found = figures_of(np.concatenate([hole.points, result.vertices]), faces, result.loops[0])
    in_rows = "NO_QUAD_ROWS" not in [warning.code for warning in result.warnings]
    plain = off = float("nan")
    if len(hole.loop) <= FINEST:
        off, plain = off_fine(hole, result, filled(hole, "triangles")[0])
    more = {"rows": in_rows, "off": off, "plain": plain, "seconds": seconds, "triangles": len(result.quads.triangles)}
    line = (
        f"| {hole.name} | {len(hole.loop)} | {found.faces} | {in_rows} | {found.untouched} | {found.fit:.3f} | "
        f"{found.least:.0f} to {found.most:.0f}° | {found.poles} | {off:.1e}; {plain:.1e} | {seconds:.2f} |"
    )
    return line, found, more


HEAD = "| hole | edges | faces | rows | untouched | 50 to 130° | angles | poles | off ÷ D, and triangles' | s |"


def table(holes: Iterator[Hole]) -> Iterator[str]:
    """A row for each hole, and their sums."""
    yield HEAD
    rows = []
    for hole in holes:
        line, found, more = row_of(hole)
        yield line
        if found is not None:
            rows.append((found, more))
    good = [(found, more) for found, more in rows if more["rows"]]
    fit = np.array([found.fit for found, _ in good])
    yield (
        f"{len(rows)} filled, {len(good)} in rows; untouched {sum(f.untouched for f, _ in rows)}; one triangle at most "
        f"{sum(m['triangles'] <= 1 for _, m in good)}; 95 % of angles fit {np.mean(fit >= 0.95):.0%}, "
        f"all {fit.mean():.1%}; "
        f"poles {np.median([f.poles for f, _ in good])} median, {max(f.poles for f, _ in good)} most; "
        f"off {np.nanmedian([m['off'] for _, m in good]):.1e}, "
        f"triangles {np.nanmedian([m['plain'] for _, m in good]):.1e}; "
        f"s {np.median([m['seconds'] for _, m in good]):.2f} median, {max(m['seconds'] for _, m in good):.2f} most"
    )


def real() -> Iterator[str]:
    """Forty holes: random discs, and those of a plane with holes."""
    yield from table(iter([*random_discs(36, SEED), *list(natural())[:8]]))


def sizes() -> Iterator[str]:
    """Twenty patches at four sizes: as they are, and with each edge of the mesh in two, four and eight."""
    for level in range(4):
        yield f"each edge in {2**level}"
        holes = [hole for hole in random_discs(20, SEED + 1) if len(hole.loop) << level <= MOST]
        yield from table(subdivided(hole, level) for hole in holes)


def peers() -> Iterator[str]:
    """Others on twenty of these holes."""
    yield "| program | done | boundary untouched | quads | 50 to 130° | poles, median | s, median |"
    holes = list(random_discs(20, SEED))
    counts = [len(filled(hole)[0].triangles) // 2 for hole in holes]
    for name, call in others.installed().items():
        others.ready(name)
        found = []
        for hole, count in zip(holes, counts, strict=True):
            made = guarded(call, hole, count)
            if made is not None:
                (points, faces, loop), seconds = made
                found.append((figures_of(points, faces, loop), seconds))
        if not found:
            yield f"| {name} | 0 of {len(holes)} |"
            continue
        shapes = [figures for figures, _ in found]
        yield (
            f"| {name} | {len(found)} of {len(holes)} | {sum(f.untouched for f in shapes)} | "
            f"{np.mean([f.quads for f in shapes]):.0%} | {np.mean([f.fit for f in shapes]):.1%} | "
            f"{np.median([f.poles for f in shapes]):.0f} | {np.median([s for _, s in found]):.2f} |"
        )


def guarded(call: Callable[[Hole, int], Any], hole: Hole, count: int) -> Any:
    """What it makes and its seconds; None where it fails, crashes or takes too long."""
    context = multiprocessing.get_context("fork")
    receive, send = context.Pipe(False)

    def work() -> None:
        begin = time.process_time()
        send.send((call(hole, count), time.process_time() - begin))

    process = context.Process(target=work)
    process.start()
    send.close()
    try:
        made = receive.recv() if receive.poll(LONGEST) else None
    except EOFError:
        made = None
    process.kill()
    process.join()
    return None if made is None or made[0] is None else made


def picture() -> Iterator[str]:
    """The picture of docs/quads.md."""
    import sheet  # with bpy

    path = Path(__file__).resolve().parents[2] / "docs/pictures/quads.webp"
    sheet.save(path)
    yield str(path)


TABLES: dict[str, Callable[[], Iterator[str]]] = {"real": real, "sizes": sizes, "peers": peers, "picture": picture}


def main(chosen: list[str]) -> None:
    """The tables named, or all."""
    for name in chosen or TABLES:
        print(f"\n{name}: {TABLES[name].__doc__}\n")
        for line in TABLES[name]():
            print(line, flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
