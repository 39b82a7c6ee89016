"""No call of the engine stops Python's other threads: a thread counts meanwhile."""

import sys
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

import shapes
from fairing import _core

CAP = shapes.cap(4000)
POINTS = np.ascontiguousarray(CAP.vertices, float)
FACES = np.ascontiguousarray(CAP.triangles, np.int32)
FIXED = np.ascontiguousarray(CAP.fixed, np.int32)
NORMALS = POINTS / np.linalg.norm(POINTS, axis=1)[:, None]
NONE, NO_EDGES = np.empty(0, np.int32), np.empty((0, 2), np.int32)
# Two parts of the cap, and the line between them.
HIGH = POINTS[FACES].mean(axis=1)[:, 2] > 0.5
TOP, RIM = np.ascontiguousarray(FACES[HIGH]), np.ascontiguousarray(FACES[~HIGH])
LINE = np.intersect1d(TOP, RIM).astype(np.int32)
LOOP = _core.hole_loops(POINTS, FACES, None)[0]
EDGES = np.concatenate([FACES[:, [0, 1]], FACES[:, [1, 2]]])
FLAT = np.ascontiguousarray(POINTS[FIXED, :2])
ENDS = np.eye(3)[:2]
COUNT, VALUES = len(POINTS), np.ones(len(POINTS))

CALLS: dict[str, tuple[Any, ...]] = {
    "bad_outline": (POINTS, RIM, LINE),
    "boundary_loops": (FACES,),
    "boundary_normals": (POINTS, TOP, RIM, LINE, NO_EDGES, False),
    "chain_end": (POINTS[:2000],),
    "components": (FACES, FIXED, COUNT),
    "conformal_distortion": (POINTS, POINTS, FACES),
    "conformal_map": (POINTS, FACES, FIXED, FLAT),
    "cotan_laplacian": (POINTS, FACES),
    "crossing_edges": (EDGES, POINTS),
    "curvatures_around": (POINTS, TOP, RIM, LINE, None),
    "denoised": (POINTS, FACES, FIXED, 0.1 * VALUES, 1, None),
    "drawn_to": (POINTS, FACES, FIXED, POINTS, VALUES),
    "expected_count": (POINTS, FACES, None, None, (0.0, False, False)),
    "expected_fill": (POINTS, FACES, LOOP, False, 0.0),
    "fair_curve": (ENDS, ENDS[::-1], np.linspace(0.0, 1.0, 50)),
    "feather_weights": (POINTS, TOP, RIM, 0.3, NONE),
    "fill_loops": (POINTS, LOOP, [np.ascontiguousarray(NORMALS[LOOP[0]])], False, "soap_film", None),
    "flipped_triangles": (POINTS, FACES, None),
    "girth": (POINTS, FACES, None),
    "hard_edges": (POINTS, FACES, NO_EDGES),
    "hole_loops": (POINTS, FACES, None),
    "interpolate": (POINTS, FACES, FIXED, FLAT),
    "judged": (POINTS, TOP, RIM, LINE, LINE, POINTS, TOP, NONE, NO_EDGES, False, None),
    "least_bent": (POINTS, FACES, FIXED),
    "mean_curvature": (POINTS, FACES, None, None, "fitted"),
    "mend_outline": (POINTS, RIM, LINE),
    "mesh_levels": (POINTS, FACES, None, 0),
    "outer_borders": (POINTS, FACES, LOOP),
    "paired_quads": (POINTS, FACES, NO_EDGES),
    "remesh": (POINTS, FACES, None, None, (NONE, NONE), NO_EDGES, (0.0, False, False), 1, None),
    "self_intersections": (POINTS, FACES, None),
    "signed_distances": (POINTS, POINTS, FACES),
    "soft_base": (POINTS, FACES, FIXED, POINTS, np.ones(COUNT, bool), (0.1, 2.0, 0.1), 1, None),
    "surrounding_normals": (POINTS, RIM, LINE, NO_EDGES),
    "touching_edges": (EDGES, POINTS),
    "triangulated": (POINTS, FACES.ravel(), np.full(len(FACES), 3, np.int32)),
    "turned_triangles": (FACES, COUNT),
    "vertex_normals": (POINTS, FACES, "fitted"),
    "visible_join": (POINTS, TOP, RIM, LINE),
}
# They need more than a cap, or take no time, and are bound in the same way.
ELSEWHERE = {
    "fair", "cut_fillet", "fillet_rows", "on_wrong_side", "seam_room", "new_patch", "first_mesh", "wire_cells",
    "cells_of_triangles", "hard_ways", "refuse_large",
}  # fmt: skip


@pytest.fixture
def _nobody_is_interrupted() -> Iterator[None]:
    """Python changes threads where one waits, and nowhere else."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(1000.0)
    yield
    sys.setswitchinterval(before)


def counted_during(call: Callable[[], object]) -> int:
    """How often another thread had its turn."""
    turns, ended = 0, False
    figures: list[int] = []

    def work() -> None:
        nonlocal ended
        figures.append(turns)
        for _ in range(500):  # a short call may be over before the other thread wakes
            call()
            if turns > figures[0]:
                break
        figures.append(turns)
        ended = True

    thread = threading.Thread(target=work)
    thread.start()
    while not ended and thread.is_alive():
        turns += 1
        time.sleep(0)
    thread.join()
    return figures[1] - figures[0]


@pytest.mark.usefixtures("_nobody_is_interrupted")
@pytest.mark.parametrize("name", CALLS)
def test_other_threads_go_on(name: str) -> None:
    assert counted_during(lambda: getattr(_core, name)(*CALLS[name])) > 0


@pytest.mark.usefixtures("_nobody_is_interrupted")
def test_a_call_that_keeps_the_lock_is_seen() -> None:
    numbers = list(range(1000))
    assert counted_during(lambda: sorted(numbers, reverse=True)) == 0


def test_every_function_of_the_engine_is_asked() -> None:
    functions = {name for name in dir(_core) if type(getattr(_core, name)).__name__ == "builtin_function_or_method"}
    assert functions - ELSEWHERE == set(CALLS)
