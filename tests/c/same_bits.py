"""The C library fills, remeshes and measures to the bits of the Python package: python same_bits.py libfairing.so."""

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


def pointer(array: np.ndarray) -> ctypes.c_void_p:
    return array.ctypes.data_as(ctypes.c_void_p)


def new_mesh(library: ctypes.CDLL, name: str, *arguments: object) -> tuple[np.ndarray, np.ndarray]:
    """The new points and triangles of a call, which takes its last arguments from here."""
    filling, error, count = ctypes.c_void_p(), Error(), ctypes.c_size_t()
    status = getattr(library, name)(*arguments, None, None, None, ctypes.byref(filling), ctypes.byref(error))
    assert status == 0, error.message
    arrays = []
    for what, kind in (("points", ctypes.c_double), ("triangles", ctypes.c_int)):
        function = getattr(library, f"fairing_new_{what}")
        function.restype = ctypes.POINTER(kind)
        found = function(filling, ctypes.byref(count))
        arrays.append(np.ctypeslib.as_array(found, (count.value, 3)).copy())
    library.fairing_free_filling(filling)
    return arrays[0], arrays[1]


def main() -> None:
    library = ctypes.CDLL(sys.argv[1])
    points, triangles = tube()
    mesh = pointer(points), ctypes.c_size_t(len(points)), pointer(triangles), ctypes.c_size_t(len(triangles))
    made, faces = new_mesh(library, "fairing_fill", *mesh, None, None, ctypes.c_size_t(0))
    same = fairing.fill(points, triangles, edges="ignored")
    assert len(made) > 100
    assert np.array_equal(made, same.vertices)
    assert np.array_equal(faces, same.triangles)

    chosen = (np.abs(points[triangles][:, :, 2]) < 0.6).all(axis=1) & (points[triangles][:, :, 0] > 0).all(axis=1)
    made, faces = new_mesh(library, "fairing_remesh", *mesh, pointer(chosen.astype(np.uint8)))
    rim = np.intersect1d(triangles[chosen], triangles[~chosen])
    border = np.unique(np.concatenate(fairing.boundary_loops(triangles[chosen])))
    held = border[np.isin(border, rim)]
    beyond = triangles[~chosen]
    slopes = fairing.boundary_normals(points, triangles[chosen], border, outside=beyond).normals  # as the library asks
    patch = fairing.Boundary(held, slopes[np.isin(border, rim)], outside=beyond)
    again = fairing.remesh(points, triangles[chosen], patch)
    assert len(made) > 20
    assert np.array_equal(made, again.vertices)
    assert np.array_equal(faces, again.triangles)

    curvatures = np.empty(len(points))
    assert library.fairing_mean_curvature(*mesh, pointer(curvatures), None) == 0
    assert np.array_equal(curvatures, fairing.mean_curvature(points, triangles))
    print(f"{len(same.vertices)} and {len(made)} vertices, {len(points)} curvatures, the same bits")


if __name__ == "__main__":
    main()
