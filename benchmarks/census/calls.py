"""Calls by the dozen for rows of limits.toml: each kind reaches rooms of the engine that plain patches do not."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

import fairing
import joints
import problems
import scan_regions
import solids_at_random
import tubes
from engine import FloatArray
from joints import flat_arm
from meshing import IntArray
from real_meshes import RealPatch

Call = tuple[str, Callable[[], Any], Any]  # name, the call, the exact surface where one is known
LARGEST = {"fill": 700, "remesh": 700, "least variation": 300, "paper": 900}  # vertices of a patch
USUAL = 1000  # of other kinds
# Of a hundred problems of all kinds.
SHARES = {
    "patches": 20, "scans": 5, "fill": 9, "pins": 6, "detail": 6, "jagged": 6, "remesh": 4, "feather": 3, "G2": 6,
    "mended": 3, "least variation": 3, "tubes": 6, "weights": 3, "equations": 4, "again": 2, "paper": 3, "fillet": 5,
    "hard": 6, "mixed": 8, "curves": 4,
}  # fmt: skip


def patches(kind: str, count: int, seed: int) -> Iterator[tuple[RealPatch, np.random.Generator]]:
    """Random patches of the real meshes, and the generator that made them."""
    return problems.random_patches(count, seed, LARGEST.get(kind, USUAL))


def calls(kind: str, count: int, seed: int) -> Iterator[Call]:
    """Of a kind: KINDS, MAKERS, or "patches" with the closed forms and options of problems.py."""
    if kind in MAKERS:
        yield from MAKERS[kind](count, seed)
        return
    if kind != "patches":
        for patch, rng in patches(kind, count, seed):
            call = KINDS[kind](patch, rng)
            if call is not None:
                yield patch.name, call, None
        return
    for problem in [*problems.exact(seed, (300,)), *problems.patches(count, seed)]:
        if len(problem.vertices) <= USUAL:
            yield problem.name + problem.kind, _faired(problem), problem


def of_all_kinds(count: int, seed: int) -> Iterator[tuple[str, Call]]:
    """The kind and the call; some `count`, shared out by SHARES."""
    for number, (kind, share) in enumerate(SHARES.items()):
        for call in calls(kind, max(1, share * count // 100), 100 * seed + number):
            yield kind, call


def _tubes(count: int, seed: int) -> Iterator[Call]:
    """Pipes, elbows, S-bends and joints of three arms in turns; of three equations, or bridged."""
    rng = np.random.default_rng(seed)
    makers = (_pipe, _elbow, _s_bend, _joint)
    for number in range(count):
        make = makers[number % 4]
        tube = make(rng)
        equation = ("least_variation", "automatic", "harmonic")[number // 4 % 3]
        if make is not _joint and number % 5 == 4:
            yield f"bridge{make.__name__} {number}", _bridged(tube), None
        else:
            yield f"{equation}{make.__name__} {number}", _along(tube, equation), None


def _scans(count: int, seed: int) -> Iterator[Call]:
    """Large regions of scans, with noise of up to a quarter edge; some with weights or a pin."""
    rng = np.random.default_rng(seed)
    for number in range(count):
        name = list(scan_regions.MESHES)[number % 2]
        wanted, noise = int(rng.integers(1600, 7000)), float(rng.choice([0.0, 0.1, 0.25]))
        vertices, triangles = scan_regions.scan(name, wanted)
        vertices = scan_regions.shaken(vertices, triangles, noise)
        region = scan_regions.region(vertices, triangles, int(rng.integers(5000)), wanted)
        weights = "conformal" if number % 5 == 4 else "uniform"
        fixed, normals = region.fixed, region.normals
        if number % 5 == 2:
            inside = np.setdiff1d(np.arange(len(region.vertices)), fixed)
            fixed, normals = np.append(fixed, rng.choice(inside)), np.vstack([normals, [[0.0, 0.0, 1.0]]])
        problem = problems.Problem(
            f"{name} {number}", "scan", region.vertices, region.triangles, fixed, normals, {"inner_fairness": weights}
        )
        yield problem.name, _faired(problem), None


def _solid(rng: np.random.Generator) -> solids_at_random.Mesh:
    return (solids_at_random.swept, solids_at_random.blocks)[int(rng.integers(2))](rng)


def _fillets(count: int, seed: int) -> Iterator[Call]:
    """Of all hard edges of random solids; with other widths, profiles and joins."""
    rng = np.random.default_rng(seed)
    for number in range(count):
        vertices, triangles = _solid(rng)
        edge = float(np.linalg.norm(vertices[triangles[:, 0]] - vertices[triangles[:, 1]], axis=1).mean())
        width = edge * float(rng.uniform(0.5, 2.5))
        options: dict[str, Any] = {"width": width, "threads": 1}
        if number % 4 == 1:
            options["profile"] = float(rng.uniform(-1.0, 1.0))
        if number % 4 == 2:
            options |= {"width_2": width * float(rng.uniform(0.5, 1.5)), "spacing": 0.3 * width}
        if number % 4 == 3:
            options["continuity"] = "G2"
        yield f"fillet {number}", partial(fairing.fillet, vertices, triangles, **options), None


def _hard(count: int, seed: int) -> Iterator[Call]:
    """Holes and regions of random solids, across their edges."""
    rng = np.random.default_rng(seed)
    for number in range(count):
        vertices, triangles = _solid(rng)
        edges, uses = fairing.edges_with_uses(triangles)
        inner = np.setdiff1d(np.arange(len(vertices)), edges[uses == 1])
        radius = float(np.ptp(vertices, axis=0).max() * rng.uniform(0.1, 0.3))
        near = np.linalg.norm(vertices[triangles].mean(axis=1) - vertices[rng.choice(inner)], axis=1) < radius
        near &= np.isin(triangles, inner).all(axis=1)
        part, around = triangles[near], triangles[~near]
        solve = _hole if number % 2 else _region
        yield f"{solve.__name__[1:]} {number}", partial(solve, vertices, part, around), None


def _hole(vertices: FloatArray, part: IntArray, around: IntArray) -> Any:
    return fairing.fill(vertices, around, fairing.boundary_loops(part), threads=1)


def _region(vertices: FloatArray, part: IntArray, around: IntArray) -> Any:
    fixed = np.intersect1d(part, around)
    normals = fairing.surrounding_normals(vertices, around, fixed).normals
    return fairing.fair(vertices, part, fixed=fixed, fixed_normals=normals, outside=around, threads=1)


def _style(rng: np.random.Generator) -> dict[str, int]:
    return {"around": int(rng.integers(10, 17)), "seed": int(rng.integers(1000))}


def _pipe(rng: np.random.Generator) -> tubes.Tube:
    return tubes.pipe(float(rng.uniform(2.0, 9.0)), float(rng.uniform(-15.0, 15.0)), **_style(rng))


def _elbow(rng: np.random.Generator) -> tubes.Tube:
    return tubes.elbow(float(rng.uniform(1.5, 4.0)), float(rng.uniform(30.0, 180.0)), **_style(rng))


def _s_bend(rng: np.random.Generator) -> tubes.Tube:
    return tubes.s_bend(float(rng.uniform(1.5, 4.0)), float(rng.uniform(30.0, 90.0)), **_style(rng))


def _joint(rng: np.random.Generator) -> tubes.Tube:
    angles = np.array([0.0, 120.0, 240.0]) + rng.uniform(-30.0, 30.0, 3)
    arms = [flat_arm(float(angle), float(rng.uniform(0.5, 1.0)), float(rng.uniform(2.5, 4.0))) for angle in angles]
    return joints.joint(arms, seed=int(rng.integers(1000)))


def _along(tube: tubes.Tube, equation: str) -> Callable[[], Any]:
    return lambda: tube.faired(equation=equation)


def _bridged(tube: tubes.Tube) -> Callable[[], Any]:
    normals = np.zeros_like(tube.vertices)
    normals[tube.fixed] = tube.normals
    loops = fairing.boundary_loops(tube.triangles)
    none = np.zeros((0, 3), dtype=np.int64)
    return lambda: fairing.fill(tube.vertices, none, loops, bridge=True, normals=normals, threads=1)


def _faired(problem: problems.Problem) -> Callable[[], Any]:
    return lambda: fairing.fair(
        problem.vertices, problem.triangles, fixed=problem.fixed, fixed_normals=problem.normals, threads=1,
        **problem.options,
    )  # fmt: skip


def _fair(patch: RealPatch, **options: Any) -> Callable[[], Any]:
    return lambda: fairing.fair(
        patch.vertices, patch.triangles, fixed=patch.fixed, fixed_normals=patch.normals, threads=1, **options
    )


def _within(patch: RealPatch, noise: float, rng: np.random.Generator, **options: Any) -> Callable[[], Any]:
    """With the mesh around, shaken by a share of the edges."""
    edge = np.linalg.norm(patch.vertices[patch.triangles[:, 0]] - patch.vertices[patch.triangles[:, 1]], axis=1).mean()
    vertices = patch.whole + rng.normal(scale=noise * edge, size=patch.whole.shape)
    numbers = patch.vertices_in_mesh
    return lambda: fairing.fair(
        vertices, numbers[patch.triangles], fixed=numbers[patch.fixed], outside=patch.outside, threads=1, **options
    )


def _filled(patch: RealPatch, _: np.random.Generator) -> Callable[[], Any]:
    loops = [patch.vertices_in_mesh[loop] for loop in fairing.boundary_loops(patch.triangles)]
    return lambda: fairing.fill(patch.whole, patch.outside, loops, bridge=len(loops) > 1, threads=1)


def _jagged(patch: RealPatch, rng: np.random.Generator) -> Callable[[], Any]:
    """With a boundary that hardly any surface meets."""
    edge = np.linalg.norm(patch.vertices[patch.triangles[:, 0]] - patch.vertices[patch.triangles[:, 1]], axis=1).mean()
    vertices, size = patch.vertices.copy(), (len(patch.fixed), 3)
    vertices[patch.fixed] += rng.normal(scale=0.4 * edge, size=size)
    normals = patch.normals + rng.normal(scale=0.6, size=size)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    return lambda: fairing.fair(vertices, patch.triangles, fixed=patch.fixed, fixed_normals=normals, threads=1)


def _remeshed(patch: RealPatch, rng: np.random.Generator) -> Callable[[], Any]:
    spacing = float(rng.choice([0.0, 0.03, 0.06]))
    return lambda: fairing.remesh(
        patch.vertices, patch.triangles, fixed=patch.fixed, fixed_normals=patch.normals, spacing=spacing, threads=1
    )


def _feathered(patch: RealPatch, rng: np.random.Generator) -> Callable[[], Any]:
    return _within(patch, 0.1, rng, detail=float(rng.choice([0.0, 1.0])), feather=0.15)


def _pinned(patch: RealPatch, rng: np.random.Generator) -> Callable[[], Any] | None:
    beside = patch.triangles[np.isin(patch.triangles, patch.fixed).any(axis=1)]
    inside = np.setdiff1d(np.arange(len(patch.vertices)), np.union1d(patch.fixed, beside))
    if len(inside) < 4:
        return None
    pins = rng.choice(inside, int(rng.integers(1, 4)), replace=False)
    vertices = patch.vertices.copy()
    vertices[pins] += rng.normal(scale=0.02 * np.ptp(vertices, axis=0).max(), size=(len(pins), 3))
    fixed = np.append(patch.fixed, pins)
    normals = np.vstack([patch.normals, np.tile([0.0, 0.0, 1.0], (len(pins), 1))])
    radius = float(rng.choice([0.05, 0.1, 0.2]))
    return lambda: fairing.fair(
        vertices, patch.triangles, fixed=fixed, fixed_normals=normals, pin_radius=radius, threads=1
    )


def _detailed(patch: RealPatch, rng: np.random.Generator) -> Callable[[], Any]:
    return _within(patch, 0.1, rng, detail=1.0)


def _weighted(patch: RealPatch, rng: np.random.Generator) -> Callable[[], Any]:
    return _fair(patch, inner_fairness=str(rng.choice(["conformal", "inverse_distance", "shape_preserving"])))


def _of_other_equation(patch: RealPatch, rng: np.random.Generator) -> Callable[[], Any]:
    name = str(rng.choice(["constant", "soap_film", "minimal_energy", "automatic"]))
    return _fair(patch, equation=name, bulge=float(rng.choice([-1.0, 1.0, 4.0])) if name == "constant" else 0.0)


def _mixed(patch: RealPatch, rng: np.random.Generator) -> Callable[[], Any]:
    """Several options at once, each in every third call; normals of the surroundings, which "mended" finds itself."""
    rare = rng.random(9) < 1 / 3
    options: dict[str, Any] = {}
    if rare[0]:
        options["inner_fairness"] = str(rng.choice(["conformal", "inverse_distance", "shape_preserving"]))
    if rare[1]:
        options["continuity"] = "G2"
    elif rare[2]:
        options |= {"equation": "constant", "bulge": float(rng.uniform(-2.0, 2.0))}
    if rare[3]:
        options["detail"] = float(rng.uniform(0.2, 1.0))
    if rare[4]:
        options["outline"] = "mended"
    else:
        options["fixed_normals"] = patch.normals
    if rare[5]:
        options["start"] = str(rng.choice(["given", "least_variation", "loft", "smoothed"]))
    if rare[6]:
        options["normals"] = "averaged"
    if rare[7]:
        options |= {"tolerance": 1e-9, "otherwise": "stop"}
    if rare[8]:
        options["preview"] = lambda points: None
    return _within(patch, float(rng.choice([0.0, 0.1])), rng, **options)


def _curved(patch: RealPatch, rng: np.random.Generator) -> Callable[[], Any] | None:
    """A path from boundary to boundary as a crease or a smooth curve; or with part of the border free."""
    if rng.random() < 0.3:
        kept = len(patch.fixed) // 2
        return lambda: fairing.fair(
            patch.vertices, patch.triangles, fixed=patch.fixed[:kept], fixed_normals=patch.normals[:kept],
            open_border="faired", threads=1,
        )  # fmt: skip
    edges = fairing.edges_with_uses(patch.triangles)[0]
    lengths = np.linalg.norm(patch.vertices[edges[:, 0]] - patch.vertices[edges[:, 1]], axis=1)
    count = len(patch.vertices)
    graph = coo_array((lengths, (edges[:, 0], edges[:, 1])), shape=(count, count)).tocsr()
    first, last = rng.choice(patch.fixed, 2, replace=False)
    before = dijkstra(graph, directed=False, indices=first, return_predecessors=True)[1]
    path = [int(last)]
    while before[path[-1]] >= 0:
        path.append(int(before[path[-1]]))
    inner = np.setdiff1d(path, patch.fixed)
    if len(inner) < 2:
        return None
    fixed = np.append(patch.fixed, inner)
    normals = np.vstack([patch.normals, np.tile([0.0, 0.0, 1.0], (len(inner), 1))])
    curves: dict[str, Any] = {"creases": np.array(path)} if rng.random() < 0.5 else {"smooth_curves": inner}
    return lambda: fairing.fair(
        patch.vertices, patch.triangles, fixed=fixed, fixed_normals=normals, threads=1, **curves
    )


def _again(patch: RealPatch, rng: np.random.Generator) -> Callable[[], Any]:
    """While the boundary moves; with another load; then from the last answer's vertices."""
    continuity = str(rng.choice(["G1", "G2"]))
    around = fairing.surrounding_normals(patch.whole, patch.outside, patch.vertices_in_mesh[patch.fixed])
    curvatures = around.curvatures if continuity == "G2" else None
    steps = rng.normal(scale=np.ptp(patch.vertices[patch.fixed], axis=0).max(), size=(3, 3)) * [[0.005], [0.02], [0.1]]
    part = patch.fixed[: len(patch.fixed) // 2]

    def solved() -> Any:
        solver = fairing.Solver(patch.triangles, fixed=patch.fixed, continuity=continuity, threads=1)
        vertices = patch.vertices.copy()
        solver.solve(vertices, patch.normals, patch.vertices, fixed_curvatures=curvatures)
        for step in steps:
            vertices[part] += step
            last = solver.solve(vertices, patch.normals, patch.vertices, fixed_curvatures=curvatures)
        if continuity == "G1":
            solver.change(equation="constant", bulge=0.3)
            last = solver.solve(vertices, patch.normals, patch.vertices)
        return fairing.fair(
            last.vertices, patch.triangles, fixed=patch.fixed, fixed_normals=patch.normals, threads=1, start="given"
        )

    return solved


KINDS: dict[str, Callable[[RealPatch, np.random.Generator], Callable[[], Any] | None]] = {
    "fill": _filled,
    "pins": _pinned,
    "detail": _detailed,
    "jagged": _jagged,
    "remesh": _remeshed,
    "feather": _feathered,
    "G2": lambda patch, rng: _within(patch, 0.0, rng, continuity="G2"),
    "mended": lambda patch, rng: _within(patch, 0.1, rng, outline="mended"),
    "least variation": lambda patch, _: _fair(patch, equation="least_variation"),
    "weights": _weighted,
    "equations": _of_other_equation,
    "again": _again,
    "mixed": _mixed,
    "curves": _curved,
    "paper": lambda patch, _: _fair(patch, method="paper"),
}
MAKERS = {"tubes": _tubes, "scans": _scans, "fillet": _fillets, "hard": _hard}
