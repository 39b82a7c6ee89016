"""Nothing breaks the engine: arguments, interruptions, memory, threads, repetition."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fairing
import hard_inputs
import shapes
from curves import FloatArray
from hard_inputs import Input

CAP = shapes.cap(60)
CLEAN = hard_inputs.of_patch(CAP)


def call(**options: Any) -> fairing.FairResult:
    settings: dict[str, Any] = {
        "vertices": CAP.vertices, "triangles": CAP.triangles, "fixed": CAP.fixed, "fixed_normals": CAP.fixed_normals,
    }  # fmt: skip
    settings.update(options)
    return fairing.fair(settings.pop("vertices"), settings.pop("triangles"), **settings)


def with_entry(array: Any, value: Any) -> Any:
    """A copy, of a wider type if need be, whose first entry is another."""
    kind = np.int64 if type(value) is int else type(value)  # numpy 1 on Windows takes an int for 32 bits
    result = array.astype(np.result_type(array, kind))
    result.reshape(-1)[0] = value
    return result


# Arguments


class Unwilling:
    """Not to be had as an array."""

    def __array__(self, *_: Any, **__: Any) -> Any:
        raise TypeError("no array")


@pytest.mark.parametrize(
    "option", ["vertices", "triangles", "fixed", "fixed_normals", "reference", "neighbours", "inner_fairness"]
)
@pytest.mark.parametrize("value", [[[0, 0], [1, 2, 3]], Unwilling(), {"a": 1}, b"mesh", [[None, 1, 2]]])
def test_what_is_no_array_is_named(option: str, value: Any) -> None:
    with pytest.raises(ValueError, match=option):
        call(**{option: value})


@pytest.mark.parametrize(
    ("option", "value"),
    [
        ("vertices", None),
        ("vertices", CAP.vertices.astype(complex)),
        ("vertices", CAP.vertices.astype(object)),
        ("vertices", CAP.vertices > 0),
        ("vertices", CAP.vertices[None]),
        ("vertices", 1.0),
        ("vertices", "mesh"),
        ("triangles", None),
        ("triangles", CAP.triangles[None]),
        ("triangles", CAP.triangles.astype(float)),
        ("triangles", with_entry(CAP.triangles, 2**31)),
        ("triangles", with_entry(CAP.triangles, -(2**40))),
        ("triangles", with_entry(CAP.triangles.astype(np.uint64), np.uint64(2**63))),
        ("fixed", 3),
        ("fixed", CAP.fixed.astype(float)),
        ("fixed", with_entry(CAP.fixed, 2**31)),
        ("fixed", with_entry(CAP.fixed, -(2**40))),
        ("fixed", with_entry(CAP.fixed, -1)),
        ("fixed", with_entry(CAP.fixed, len(CAP.vertices))),
        ("fixed_normals", CAP.fixed_normals[:, :2]),
        ("fixed_normals", CAP.normals),
        ("reference", CAP.vertices.astype(complex)),
        ("neighbours", np.array([[0, -1]])),
        ("inner_fairness", np.array([[0.0, 1.0]])),
        ("inner_fairness", np.array([[0.0, 1.0, -1.0]])),
        ("inner_fairness", np.array([[0.0, 1e6, 1.0]])),
        ("inner_fairness", np.array([[0.5, 1.0, 1.0]])),
        ("inner_fairness", np.array([[0.0, 1e300, 1.0]])),
        ("vertices", CAP.vertices.ravel()),
        ("fixed", CAP.fixed[:, None]),
        ("fixed", np.append(CAP.fixed, CAP.fixed[0])),
        ("fixed_normals", 0 * CAP.fixed_normals),
        ("reference", CAP.vertices[:-1]),
        ("neighbours", np.array([[0, 1, 2]])),
        ("neighbours", np.array([[0, 100000]])),
        ("tolerance", None),
        ("tolerance", 0.0),
        ("tolerance", float("nan")),
        ("tolerance", "small"),
        ("tolerance", float("inf")),
        ("max_iterations", 2.5),
        ("max_iterations", True),
        ("max_iterations", 2**31),
        ("max_iterations", 0),
        ("threads", -1),
        ("threads", 1.5),
        ("threads", 2**31),
        ("levels", 2**31),
        ("load", None),
        ("load", 1.0),
        ("progress", 7),
    ],
)
def test_wrong_arguments_of_every_kind_are_named(option: str, value: Any) -> None:
    with pytest.raises(ValueError, match=option):
        call(**{option: value})


@pytest.mark.parametrize("value", [-1, len(CAP.vertices), 2**31, -(2**40), np.uint64(2**63)])
def test_named_indices_out_of_range_are_elements(value: Any) -> None:
    """Of `fixed` the vertices that it names, of `triangles` the rows."""
    for option, array, elements, kind in (
        ("fixed", CAP.fixed, [value], "vertex"),
        ("triangles", CAP.triangles, [0], "triangle"),
    ):
        wide = array.astype(np.uint64) if isinstance(value, np.uint64) else array
        with pytest.raises(fairing.MeshError) as caught:
            call(**{option: with_entry(wide, value)})
        assert caught.value.code == "INDEX_RANGE"
        assert list(caught.value.elements) == elements
        assert caught.value.kind == kind
        assert option.rstrip("s") in str(caught.value)


# Interruptions


def recorded(item: Input, **options: Any) -> int:
    """How often progress is reported."""
    calls: list[float] = []
    item.fair(progress=lambda fraction, stage: calls.append(fraction), **options)
    return len(calls)


@pytest.mark.parametrize(
    ("method", "kind"), [("global", "uniform"), ("global", "shape_preserving"), ("paper", "uniform")]
)
@pytest.mark.parametrize("raises", [False, True])
def test_interrupted_at_every_call(method: str, kind: str, raises: bool) -> None:
    """`Input.fair` sees that arrays keep their bits; a callback that fails comes through unchanged."""

    class MineError(Exception):
        pass

    total = recorded(CLEAN, method=method, inner_fairness=kind)
    assert total > 5
    for last in range(1, total + 1, max(1, total // 40)):
        calls: list[str] = []

        def stop(fraction: float, stage: str, last: int = last, calls: list[str] = calls) -> bool:
            calls.append(stage)
            if raises and len(calls) == last:
                raise MineError(stage)
            return len(calls) < last

        try:
            CLEAN.fair(method=method, inner_fairness=kind, progress=stop)
        except (MineError, fairing.Cancelled) as error:
            assert isinstance(error, MineError) == raises
            assert len(calls) == last
        else:  # questions depend on the time too: there may be fewer than at first
            assert last > 1
            assert calls[-1] == "done"
            assert len(calls) < last


def test_false_of_numpy_cancels() -> None:
    with pytest.raises(fairing.Cancelled):
        CLEAN.fair(progress=lambda fraction, stage: np.False_)
    assert CLEAN.fair(progress=lambda fraction, stage: np.True_).converged


@pytest.mark.parametrize("answer", [0, 1, 0.0, np.float64(0), "", "no", [], {}])
def test_other_answers_are_refused(answer: Any) -> None:
    """A callback that returns its fraction would cancel at zero."""
    with pytest.raises(TypeError, match=r"progress: the callback returned .*False cancels"):
        CLEAN.fair(progress=lambda fraction, stage: answer)


def test_a_callback_may_call_again() -> None:
    """A fairing from within the progress of another: no lock is held."""
    inner: list[FloatArray] = []
    result = CLEAN.fair(progress=lambda fraction, stage: inner.append(CLEAN.fair().vertices) or True)
    assert inner
    assert all(np.array_equal(vertices, result.vertices) for vertices in inner)


# Memory, threads, processes


# In a thread, whose stack is there from the start: the kernel ends a process whose main stack can't grow.
STARVED = """
import resource, sys, threading, time
sys.path.insert(0, sys.argv[1])
import numpy as np, fairing, hard_inputs, shapes
item = hard_inputs.of_patch(shapes.catenoid(2000))

def starve():
    time.sleep(0.5)  # the main thread waits by then: where its stack cannot grow the kernel ends it
    for spare in [*range(0, 20_000_000, 1_000_000), 10**9]:
        used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (used + spare, resource.RLIM_INFINITY))
        for method in ("global", "paper"):
            try:
                assert np.isfinite(item.fair(method=method, max_iterations=10).vertices).all()
                print("solved", flush=True)
            except (MemoryError, fairing.SolverError) as error:
                print("refused", flush=True)

thread = threading.Thread(target=starve)
thread.start()
thread.join()
"""


def run_alone(script: str, timeout: float = 120) -> subprocess.CompletedProcess[str]:
    """The script in a process of its own, with the tests' folder as its argument; one heap for all threads."""
    paths = os.pathsep.join(path for path in sys.path if path)
    return subprocess.run(
        [sys.executable, "-c", script, str(Path(__file__).parent)],
        capture_output=True, text=True, check=False, timeout=timeout,
        env={**os.environ, "PYTHONPATH": paths, "MALLOC_ARENA_MAX": "1"},
    )  # fmt: skip


@pytest.mark.skipif(sys.platform != "linux", reason="RLIMIT_AS and /proc are Linux's")
def test_without_memory_it_refuses_and_lives() -> None:
    """The address space may grow by 0 … 19 MB and at last by 1 GB: wherever it ends, an error, and on it goes."""
    done = run_alone(STARVED)
    assert done.returncode == 0, done.stderr
    words = done.stdout.split()
    assert len(words) == 42
    assert words[0] == "refused"
    assert words[-2:] == ["solved", "solved"]


FORKED = """
import os, sys
sys.path.insert(0, sys.argv[1])
import numpy as np, hard_inputs, shapes
item = hard_inputs.of_patch(shapes.catenoid(2000))
control = item.fair().vertices
child = os.fork()
same = np.array_equal(item.fair().vertices, control)
if child == 0:
    os._exit(0 if same else 1)
sys.exit(os.waitpid(child, 0)[1] or not same)
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork on this system")
def test_a_fork_goes_on() -> None:
    """After a solve with several threads, parent and child solve again, at the same time."""
    done = run_alone(FORKED)
    assert done.returncode == 0, done.stderr


# Repetition
