"""Laws of every public call: motion, scale, numbering and winding, threads, repetition, cancelling, refusals."""

from contextlib import suppress
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

import fairing
import shapes
from calls import ROWS, Found, Motion, Scene
from solving import fair_patch

RUNS = [name for name, row in ROWS.items() if row.runs]
TURN = np.linalg.qr(np.random.default_rng(5).standard_normal((3, 3)))[0]
TURN *= np.sign(np.linalg.det(TURN))
MOTIONS = {
    "turned": Motion(TURN, shift=0.7),
    "small": Motion(TURN, 1e-3),
    "large": Motion(TURN, 2.0**40, -3.0),
    "renumbered": Motion(seed=3),
    "turned over": Motion(over=True),
}


@cache
def plain(name: str) -> tuple[Scene, Found]:
    scene = ROWS[name].scene()
    return scene, ROWS[name].call(scene)


def bits(found: Found) -> list[bytes]:
    parts = [part for _, _, values in found for part in (values if isinstance(values, tuple) else (values,))]
    return [np.asarray(part).tobytes() for part in parts]


def test_every_call_has_a_row() -> None:
    """Those of whole meshes by their files and objects have tests of their own."""
    modules = fairing, fairing.borders, fairing.looks, fairing.maps
    public = {name: getattr(module, name) for module in modules for name in module.__all__}
    calls = {name for name, value in public.items() if callable(value) and name.islower()}
    elsewhere = {"fair_faces", "fill_holes", "fillet_edges", "fair_edges", "outer_borders"}
    assert calls - elsewhere == {name.partition(":")[0] for name in ROWS} - {"Solver"}


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("name", ROWS)
def test_a_result_moves_with_its_mesh(name: str, motion: str) -> None:
    """New meshes lie on the surface of those before: ties among their edges are decided by rounding."""
    row, (scene, before), moved = ROWS[name], plain(name), MOTIONS[motion]
    after = row.call(moved.of(scene))
    within = row.within if motion != "renumbered" or row.numbers is None else row.numbers
    assert moved.difference(scene, before, after) < within


@pytest.mark.parametrize("name", ROWS)
def test_the_same_bits_again(name: str) -> None:
    """And what is given keeps its own: its arrays can't be written to."""
    scene, before = plain(name)
    assert bits(ROWS[name].call(scene)) == bits(before)


@pytest.mark.parametrize("name", RUNS)
def test_the_same_bits_for_any_number_of_threads(name: str) -> None:
    scene, before = plain(name)
    for threads in (1, 2, 3):
        assert bits(ROWS[name].call(scene, threads=threads)) == bits(before)


def test_a_large_patch_has_the_same_bits_for_any_number_of_threads() -> None:
    """All loops and the factor are shared among threads there."""
    patch = shapes.catenoid(12_000)
    one = fair_patch(patch, threads=1).vertices
    assert all(np.array_equal(fair_patch(patch, threads=threads).vertices, one) for threads in (2, 3))


class MineError(Exception):
    """Raised by a callback."""


@pytest.mark.parametrize("name", RUNS)
def test_a_call_is_interrupted_wherever_it_asks(name: str) -> None:
    """Fractions rise from 0 to 1, stages have names; False of any kind cancels, what is raised comes out as it is."""
    scene, before = plain(name)
    asked: list[float] = []

    def watch(fraction: float, stage: str) -> None:
        assert stage and fraction >= max(asked, default=0.0)
        asked.append(fraction)

    assert bits(ROWS[name].call(scene, progress=watch)) == bits(before)
    assert asked[0] >= 0.0 and asked[-1] <= 1.0
    ways = [(fairing.Cancelled, False), (fairing.Cancelled, np.False_), (MineError, None)]
    places = [0, 0, 0, *range(1, len(asked), max(1, len(asked) // 8))]
    for k, last in enumerate(places):
        error, answer = ways[k % 3]
        left = iter(range(last))

        def stop(fraction: float, stage: str, left: Any = left, answer: Any = answer) -> Any:
            if next(left, None) is not None:
                return True
            if answer is None:
                raise MineError
            return answer

        # The first question always comes; how many follow depends on the time.
        with suppress(error) if last else pytest.raises(error):
            assert bits(ROWS[name].call(scene, progress=stop)) == bits(before)


@pytest.mark.parametrize("answer", [0, 1, 0.0, "", "no", []])
@pytest.mark.parametrize("name", RUNS)
def test_other_answers_are_refused(name: str, answer: Any) -> None:
    """A callback that returns its fraction would cancel at zero."""
    with pytest.raises(TypeError, match=r"progress: the callback returned .*False cancels"):
        ROWS[name].call(plain(name)[0], progress=lambda fraction, stage: answer)


@pytest.mark.parametrize("name", ROWS)
def test_what_is_not_finite_is_refused_or_left_out(name: str) -> None:
    """By name, never by a crash."""
    scene, _ = plain(name)
    points, other = scene.points.copy(), scene.other.copy()
    at = np.setdiff1d(scene.inside, scene.rim)[:1]
    points[at, 1] = other[at, 1] = np.nan
    with suppress(ValueError, fairing.SolverError):
        ROWS[name].call(replace(scene, points=points, other=other))


LOOK = {"conformal_map", "interpolate"}  # rows that look at the vertices themselves
UNCOUNTED = {"boundary_loops", "components", "edges_with_uses"}  # know no number of vertices


@pytest.mark.parametrize("wrong", [-1, 10**6, 2**31, -(2**40)])
@pytest.mark.parametrize("name", [name for name in ROWS if name not in LOOK])
def test_triangles_of_no_vertex_are_refused(name: str, wrong: int) -> None:
    if name in UNCOUNTED and wrong == 10**6:
        return
    scene, _ = plain(name)
    faces = scene.faces.astype(np.int64)
    faces[np.flatnonzero(scene.chosen)[-1], 1] = wrong
    faces[np.flatnonzero(~scene.chosen)[-1], 1] = wrong
    with pytest.raises(fairing.MeshError) as caught:
        ROWS[name].call(replace(scene, faces=faces))
    assert caught.value.code == "INDEX_RANGE"
    assert str(wrong) in str(caught.value)
