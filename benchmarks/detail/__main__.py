"""Detail put back: amplitude and spectrum of noise, the base, edges, seconds; and pictures.

    python benchmarks/detail [--pictures FOLDER]

A noisy sphere with a swelling: noise inside the patch afterwards against that of the same noise without swelling, in
bands of wavelengths. Processor time of one thread, the least of three. Pictures need the meshes that
`benchmarks/common/real_meshes.py` names.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

import numpy as np
from scipy.sparse import coo_array, diags_array
from scipy.sparse.linalg import splu

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

import cases
import fairing
from cases import Case
from engine import FloatArray

BANDS = (4.0, 6.0, 9.0)  # edges: wavelengths between which noise is compared


def spectrum(case: Case, heights: FloatArray, where: FloatArray) -> FloatArray:
    """Root mean squares at the vertices `where` in the bands of wavelengths that BANDS divide."""
    triangles = np.concatenate([case.inside, case.outside])
    rows, columns, values = fairing.cotan_laplacian(case.skin, triangles)
    count = len(case.skin)
    stiffness = coo_array((values, (rows, columns)), shape=(count, count)).tocsr()
    areas = np.zeros(count)
    corners = case.skin[triangles]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 6
    np.add.at(areas, triangles, area[:, None])
    edge = np.sqrt(8 * area.mean() * 3 / 2 / np.sqrt(3))
    result, left = [], heights
    for wavelength in BANDS:
        bending = (wavelength * edge / (2 * np.pi)) ** 4 / 4 * (stiffness @ diags_array(1 / areas) @ stiffness)
        smooth = splu((diags_array(areas) + bending).tocsc()).solve(areas * left)
        result.append(np.sqrt(((left - smooth)[where] ** 2).mean()))
        left = smooth
    return np.array(result)


def seconds(case: Case, **options: object) -> float:
    """The least of three."""
    best = np.inf
    for _ in range(3):
        start = time.process_time()
        case.fair(threads=1, **options)
        best = min(best, time.process_time() - start)
    return best


def row(case: Case, name: str, **options: object) -> str:
    """One line of the table; heights are those over the unit sphere."""
    result = case.fair(detail=1.0, **options)
    free = case.free
    directions = case.skin / np.linalg.norm(case.skin, axis=1)[:, None]
    wanted = np.linalg.norm(case.skin, axis=1) - 1
    kept = wanted.copy()
    kept[free] = ((result.vertices - result.base) * directions).sum(axis=1)[free]
    ratios = spectrum(case, kept, free) / spectrum(case, wanted, free)
    base = np.abs(np.linalg.norm(result.base[free], axis=1) - 1)
    ends = np.concatenate([case.inside[:, [k, (k + 1) % 3]] for k in range(3)])
    lengths = [np.linalg.norm(p[ends[:, 0]] - p[ends[:, 1]], axis=1) for p in (case.vertices, result.vertices)]
    edges = lengths[1] / lengths[0]
    true = lengths[1] / np.linalg.norm(case.skin[ends[:, 0]] - case.skin[ends[:, 1]], axis=1)
    with_detail, without = seconds(case, detail=1.0, **options), seconds(case, **options)
    figures = [name, len(free), f"{kept[free].std() / wanted[free].std():.2f}", *(f"{ratio:.2f}" for ratio in ratios)]
    figures += [f"{np.sqrt((base**2).mean()) / case.diameter:.1e}", f"{base.max() / case.diameter:.1e}"]
    figures += [f"{edges.min():.2f} … {edges.max():.2f}", f"{true.min():.2f} … {true.max():.2f}"]
    figures += [f"{with_detail:.3f}", f"{with_detail / without:.2f}"]
    return "| " + " | ".join(map(str, figures)) + " |"


def main() -> None:
    """Print the table; write the pictures where they are asked for."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--pictures", type=Path)
    arguments = parser.parse_args()
    for count in (2000, 8000, 30000):
        for along_normal in (False, True):
            case = cases.sphere(count, 0.25, 21, along_normal=along_normal)
            print(row(case, "normal" if along_normal else "isotropic"), flush=True)
    if arguments.pictures:
        import sheets  # these need Pillow

        sheets.write(arguments.pictures)


if __name__ == "__main__":
    main()
