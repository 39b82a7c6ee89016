"""The memory that a call takes at its peak."""

from __future__ import annotations

import ctypes
import platform
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fairing
import shapes

# 2.4 with all fields in double precision and a copy of everything for each level, 1.7 with copies of the input, lists
# of uniform weights and old fields of the iteration.
MOST = 1.35  # kB for each free vertex, above the input
CALL = """
import sys
from pathlib import Path
import numpy as np
import fairing

def kilobytes(name):
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith(name))

made = {key: value for key, value in np.load(sys.argv[1]).items()}
vertices, triangles, fixed, normals = (made[key] for key in ("vertices", "triangles", "fixed", "normals"))
before = kilobytes("VmRSS")
Path("/proc/self/clear_refs").write_text("5")  # the peak starts anew
result = fairing.fair(vertices, triangles, fixed=fixed, fixed_normals=normals, threads=1)
assert result.converged
print(kilobytes("VmHWM") - before)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the peak is read from Linux's /proc")
def test_a_large_patch_takes_little_for_each_vertex(tmp_path: Path) -> None:
    patch = shapes.cap(40_000)
    path = tmp_path / "patch.npz"
    np.savez(
        path, vertices=patch.vertices, triangles=patch.triangles, fixed=patch.fixed, normals=patch.fixed_normals
    )  # fmt: skip
    # 1.18 kB; what a helper holds at the same time depends on when it runs.
    call = [sys.executable, "-c", CALL, str(path)]
    peaks = [float(subprocess.run(call, capture_output=True, text=True, check=True).stdout) for _ in range(3)]
    assert min(peaks) <= MOST * len(patch.free)


class _Heap(ctypes.Structure):
    """What the GNU C library says of its heap, bytes (mallinfo2)."""

    _fields_ = [
        (name, ctypes.c_size_t)
        for name in ("arena", "pieces", "a", "b", "mapped", "c", "d", "taken", "free", "end")
    ]  # fmt: skip


def _square(n: int) -> tuple[dict[str, Any], int]:
    """A flat square of n² vertices for `fair`, its border fixed, and the number of free vertices."""
    i, j = np.divmod(np.arange(n * n), n)
    a = np.arange(n * n).reshape(n, n)[:-1, :-1].ravel()
    triangles = np.vstack([np.column_stack([a, a + 1, a + n + 1]), np.column_stack([a, a + n + 1, a + n])])
    fixed = np.flatnonzero((i == 0) | (i == n - 1) | (j == 0) | (j == n - 1))
    given = {
        "vertices": np.column_stack([j, i, 0 * i]) / n,
        "triangles": triangles,
        "fixed": fixed,
        "fixed_normals": np.tile([0.0, 0.0, 1.0], (len(fixed), 1)),
    }
    return given, n * n - len(fixed)


def _by_fair(given: dict[str, Any], progress: Callable[[float, str], bool]) -> None:
    fairing.fair(**given, threads=1, progress=progress)


def _by_solver(given: dict[str, Any], progress: Callable[[float, str], bool]) -> None:
    solver = fairing.Solver(given["triangles"], fixed=given["fixed"], threads=1)
    solver.solve(given["vertices"], fixed_normals=given["fixed_normals"], progress=progress)


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="only its allocator is told to keep memory")
@pytest.mark.parametrize("call", [_by_fair, _by_solver])
def test_a_large_call_takes_its_arrays_from_memory_that_it_keeps(
    call: Callable[[dict[str, Any], Callable[[float, str], bool]], None],
) -> None:
    libc = ctypes.CDLL(None)
    libc.mallinfo2.restype = _Heap
    mapped: list[int] = []

    def note(fraction: float, _stage: str) -> bool:
        mapped.append(libc.mallinfo2().mapped)
        return fraction < 0.3

    given, free = _square(720)
    with pytest.raises(fairing.Cancelled):
        call(given, note)
    grown = max(mapped) - mapped[0]
    assert grown < 10 * free, f"{grown / free:.0f} bytes a vertex came from the system"
