"""The golden set: solves whose positions have to agree between compilers and platforms.

    python benchmarks/golden.py inputs FOLDER            # meshes and options, by the tests' generators
    python benchmarks/golden.py solve FOLDER OUT.npz     # with the fairing module at hand; needs numpy only
    python benchmarks/golden.py compare A.npz B.npz …    # each against the first; 1 where one differs

Positions agree to 1e-9 D where the discrete equation is solved on the given connectivity to
tolerance 1e-12; to 1e-4 D elsewhere: at the ordinary tolerance, or on a mesh of the engine's own.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

TIGHT, LOOSE = 1e-9, 1e-4  # largest distances, over D
POLISH = {"tolerance": 1e-12, "max_iterations": 1000}


def patches() -> Iterator[tuple[str, dict[str, Any], Any, dict[str, Any]]]:
    """Yield name, input arrays, and options of every case."""
    sys.path[:0] = [str(Path(__file__).resolve().parents[1] / "tests" / part) for part in ("meshes", "tools")]
    import blend
    import shapes

    for family in shapes.FAMILIES:
        patch = shapes.FAMILIES[family](400)
        yield f"{family}, 400", patch, shapes.start_from_nothing(patch), POLISH
    cap = shapes.cap(400, half_angle=60.0)
    start = shapes.start_from_nothing(cap)
    for inner in ("conformal", "inverse_distance"):
        yield f"cap, {inner}", cap, start, {"inner_fairness": inner, **POLISH}
    for equation in ("soap_film", "minimal_energy"):
        yield f"cap, {equation}", cap, start, {"equation": equation, **POLISH}
    yield "cap, constant", cap, start, {"equation": "constant", "load": 2.0, **POLISH}
    yield "cap, averaged normals", cap, start, {"normals": "averaged", **POLISH}
    yield "cap, paper", cap, start, {"method": "paper"}
    large = shapes.cap(4000)
    yield "hemisphere, 4000, ordinary tolerance", large, shapes.start_from_nothing(large), {}
    coarse = shapes.FAMILIES["linear_flux"](60)
    yield "linear flux, 60", coarse, shapes.start_from_nothing(coarse), {}
    arms = blend.cylinder_blend(1000)
    yield "three cylinders, 1000", arms, arms.vertices, {}


def write_inputs(folder: Path) -> None:
    """Write one .npz per case and cases.json, the names and options in order."""
    folder.mkdir(parents=True, exist_ok=True)
    cases = []
    for number, (name, patch, start, options) in enumerate(patches()):
        np.savez(
            folder / f"{number}.npz", vertices=start, triangles=patch.triangles,
            fixed=patch.fixed, fixed_normals=patch.fixed_normals,
        )  # fmt: skip
        cases.append({"name": name, "options": options})
    (folder / "cases.json").write_text(json.dumps(cases))


def diameter(points: np.ndarray) -> float:
    """D of the boundary, (k, 3)."""
    return float(2 * np.linalg.norm(points - points.mean(axis=0), axis=1).max())


def solve(folder: Path, target: Path) -> None:
    """Solve every case; write positions over D and what is to be expected of them."""
    import fairing

    found: dict[str, Any] = {}
    for number, case in enumerate(json.loads((folder / "cases.json").read_text())):
        given = np.load(folder / f"{number}.npz")
        arrays = {name: given[name] for name in ("fixed", "fixed_normals")}
        result = fairing.fair(given["vertices"], given["triangles"], **arrays, **case["options"])
        exact = result.polished and case["options"].get("tolerance") == POLISH["tolerance"]
        found[case["name"]] = result.vertices / diameter(given["vertices"][given["fixed"]])
        found[case["name"] + "|limit"] = np.array(TIGHT if exact else LOOSE)
        print(f"{case['name']}: {result.termination}, {result.iterations} iterations, polished {result.polished}")
    np.savez(target, **found)


def differences(first: Any, other: Any) -> Iterator[tuple[str, float, float]]:
    """Yield name, largest distance over D, and its limit, of every case."""
    for name in first:
        if not name.endswith("|limit"):
            limit = max(float(first[name + "|limit"]), float(other[name + "|limit"]))
            yield name, float(np.linalg.norm(first[name] - other[name], axis=1).max()), limit


def compare(paths: list[Path]) -> int:
    """Print a table; return 1 where a case differs by more than its limit."""
    first, *others = [np.load(path) for path in paths]
    names = [path.stem for path in paths]
    failed = False
    columns = " | ".join(f"{name} − {names[0]}" for name in names[1:])
    print(f"| case | limit | {columns} |\n" + "| --- " * (len(paths) + 1) + "|")
    rows = zip(*(differences(first, other) for other in others), strict=True)
    for row in rows:
        worst = [distance for _, distance, _ in row]
        limit = max(limit for _, _, limit in row)
        failed |= not all(distance <= limit for distance in worst)
        print(f"| {row[0][0]} | {limit:.0e} | " + " | ".join(f"{distance:.1e}" for distance in worst) + " |")
    return int(failed)


def main() -> int:
    """Do what the first argument says."""
    match sys.argv[1:]:
        case ["inputs", folder]:
            write_inputs(Path(folder))
        case ["solve", folder, target]:
            solve(Path(folder), Path(target))
        case ["compare", *paths] if len(paths) > 1:
            return compare([Path(path) for path in paths])
        case _:
            print(__doc__, file=sys.stderr)
            return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
