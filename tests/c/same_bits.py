"""The C library fills holes to the bits of the Python package: python same_bits.py libfairing.so."""

from __future__ import annotations

import ctypes
import sys

import numpy as np

import fairing

COLUMNS, ROWS = 24, 18


class Error(ctypes.Structure):
    _fields_ = [("code", ctypes.c_char * 32), ("message", ctypes.c_char * 480), ("rest", ctypes.c_int * 18)]


def tube() -> tuple[np.ndarray, np.ndarray]:
    """Bent a little, with two holes in its side."""
    row, column = np.divmod(np.arange(COLUMNS * (ROWS + 1)), COLUMNS)
    turn, height = 2 * np.pi * column / COLUMNS, 2.0 * row / ROWS - 1
    points = np.column_stack([np.cos(turn) + 0.2 * height**2, np.sin(turn), height])
    quad = np.arange(COLUMNS * ROWS)
    beside = quad // COLUMNS * COLUMNS + (quad + 1) % COLUMNS
    halves = [
        np.column_stack([quad, beside, beside + COLUMNS]),
        np.column_stack([quad, beside + COLUMNS, quad + COLUMNS]),
    ]
    triangles = np.concatenate(halves).astype(np.int32)
    gone = np.isin(triangles, [8 * COLUMNS + 3, 10 * COLUMNS + 12, 10 * COLUMNS + 13]).any(axis=1)
    return points, triangles[~gone]


def by_c(library: ctypes.CDLL, points: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    filling, error, count = ctypes.c_void_p(), Error(), ctypes.c_size_t()
    none = None
    status = library.fairing_fill(
        points.ctypes.data_as(ctypes.c_void_p), ctypes.c_size_t(len(points)),
        triangles.ctypes.data_as(ctypes.c_void_p), ctypes.c_size_t(len(triangles)),
        none, none, ctypes.c_size_t(0), none, none, none, ctypes.byref(filling), ctypes.byref(error),
    )  # fmt: skip
    assert status == 0, error.message
    arrays = []
    for name, kind in (("points", ctypes.c_double), ("triangles", ctypes.c_int)):
        function = getattr(library, f"fairing_new_{name}")
        function.restype = ctypes.POINTER(kind)
        pointer = function(filling, ctypes.byref(count))
        arrays.append(np.ctypeslib.as_array(pointer, (count.value, 3)).copy())
    library.fairing_free_filling(filling)
    return arrays[0], arrays[1]


def main() -> None:
    points, triangles = tube()
    made, faces = by_c(ctypes.CDLL(sys.argv[1]), points, triangles)
    same = fairing.fill(points, triangles, edges="ignored")
    assert len(made) > 100
    assert np.array_equal(made, same.vertices)
    assert np.array_equal(faces, same.triangles)
    print(f"{len(made)} vertices, the same bits")


if __name__ == "__main__":
    main()
