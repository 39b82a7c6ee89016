"""The search for a lost live region's surface: Blender goes on meanwhile, and nothing that came too late is written.

A background process would wait for a search; these tests look at it as a window does, at every tick.
"""

import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

import bpy
import numpy as np
import pytest

import meshes
from extension import module
from test_live import drag, flank, now, switch, table_mountain


class Slow:
    """A region's search for an answer, which takes until it is let go, and then gives what the real one would."""

    def __init__(self, real: Callable[..., Any]) -> None:
        self.real, self.go, self.begun = real, threading.Event(), 0
        self.inside = self.most_inside = self.clashes = 0
        self.hears = False  # that it is to stop; else it takes as long as the test wants

    def __call__(self, region: Any, positions: Any, matrix: Any, progress: Any = None) -> Any:
        """Wait as the engine works: asked to stop, it ends a while later."""
        if threading.current_thread() is threading.main_thread():
            self.clashes += self.inside  # asked while a search has its solver
            return None  # not in time
        self.begun += 1
        self.inside += 1
        self.most_inside = max(self.inside, self.most_inside)
        while not self.go.wait(0.01):
            if self.hears and not progress(0.0, ""):
                time.sleep(0.1)
                break
        self.inside -= 1
        return self.real(region, positions, matrix)


@pytest.fixture
def home(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    found = module("live.live")
    monkeypatch.setattr(found, "moment", lambda: 0.0)
    yield found
    switch(False)
    module("run.runner").stop_all()


@pytest.fixture
def slow(home: Any, monkeypatch: pytest.MonkeyPatch) -> Iterator[Slow]:
    kind = module("live.region").LiveRegion
    slow = Slow(kind.answer)
    table_mountain()
    monkeypatch.setattr(kind, "answer", lambda *given: slow(*given))
    yield slow
    slow.go.set()
    assert slow.clashes == 0


def tick(home: Any) -> float | None:
    """Let the timer look, as it does in a window, once the changes have ended."""
    home.live.changed_at = 0.0
    wait: float | None = home._complete_later()
    return wait


def wait_for(home: Any, seconds: float = 20.0) -> None:
    """Look at every tick until no search goes on."""
    end = time.monotonic() + seconds
    while tick(home) is not None:
        assert time.monotonic() < end
        time.sleep(0.01)


def lose(home: Any) -> Any:
    """Drag so that the region is lost, and begin to search; returns where everything is then."""
    drag(flank(now()), (0.0, 0.0, 0.05))
    assert home.live.stands_in()
    assert tick(home) == home.TICK
    assert home.live.message == home.SEARCHING
    return now()


def test_blender_goes_on_while_the_surface_is_searched_for(home: Any, slow: Slow) -> None:
    carried = lose(home)
    for _ in range(5):
        assert tick(home) == home.TICK
        assert np.array_equal(now(), carried)
    slow.go.set()
    wait_for(home)
    assert (home.live.stands_in(), home.live.message, slow.begun) == (False, "", 1)
    assert 1e-4 < np.abs(now() - carried).max() < 0.1


def test_a_change_meanwhile_makes_the_answer_worthless(home: Any, slow: Slow) -> None:
    """What was searched for the old place is not written; no step waits for it, nor asks the region beside it."""
    lose(home)
    for _ in range(3):  # after one that failed, the next change doesn't ask
        drag(flank(now()), (0.0, 0.0, 0.01))
    carried = now()
    assert tick(home) == home.TICK  # the old search has not ended yet
    assert slow.begun == 1
    slow.go.set()
    for _ in range(100):
        if slow.begun == 2:
            break
        assert np.array_equal(now(), carried)
        assert tick(home) == home.TICK
        time.sleep(0.01)
    wait_for(home)
    assert (slow.begun, slow.most_inside) == (2, 1)
    assert not home.live.stands_in()
    found = now()
    slow.real = lambda *_: None  # from here on nothing is found: what stands must be what a fresh region would give
    switch(False)
    meshes.leave()
    np.testing.assert_allclose(meshes.positions(bpy.data.objects["Grid"]), found, atol=1e-6)


def test_undo_meanwhile(home: Any, slow: Slow) -> None:
    """The step back is the state before the drag, whatever the search finds for the state that was left."""
    start = now()
    bpy.ops.ed.undo_push(message="before")
    drag(flank(start), (0.0, 0.0, 0.05))
    bpy.ops.ed.undo_push(message="drag")
    assert tick(home) == home.TICK
    bpy.ops.ed.undo()
    bpy.context.view_layer.update()
    slow.go.set()
    wait_for(home)
    np.testing.assert_allclose(now(), start, atol=2e-5)
    assert not home.live.stands_in()


def test_leaving_edit_mode_meanwhile(home: Any, slow: Slow) -> None:
    """Nothing is written to a mesh that is edited no more; back in edit mode the search begins anew."""
    carried = lose(home)
    meshes.leave()
    assert tick(home) is None
    slow.go.set()
    module("run.runner").stop_all()
    assert tick(home) is None
    obj = bpy.data.objects["Grid"]
    np.testing.assert_array_equal(meshes.positions(obj), carried)
    meshes.edit(obj)
    bpy.context.view_layer.update()
    assert home.live.waits(obj)
    wait_for(home)
    assert not home.live.stands_in()
    assert np.abs(now() - carried).max() > 1e-4


@pytest.mark.parametrize("how", ["switched off", "forgotten", "another file", "the mesh is gone"])
def test_a_search_that_nobody_waits_for_writes_nothing(home: Any, slow: Slow, how: str) -> None:
    carried = lose(home)
    search = home.live.sessions["Grid"].search
    if how == "switched off":
        switch(False)
    elif how == "forgotten":
        assert bpy.ops.mesh.fair_live_forget() == {"FINISHED"}
        bpy.context.view_layer.update()
    elif how == "another file":
        slow.hears = True
        bpy.ops.wm.read_homefile(use_empty=True)
    else:
        bpy.data.meshes.remove(bpy.data.objects["Grid"].data)
    assert tick(home) is None
    assert search.cancelled
    slow.go.set()
    module("run.runner").stop_all()
    assert tick(home) is None
    if how in ("switched off", "forgotten"):
        assert np.array_equal(now(), carried)
    assert home.live.message in ("", home.SEARCHING)


def test_a_script_waits_for_the_search(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without a window nobody would look at the timer: switching Live on gives the fair surface at once."""
    home = module("live.live")
    assert home.moment() is None
    table_mountain()
    switch(False)
    monkeypatch.setattr(home, "PATIENCE", -1.0)
    before = now()
    drag(flank(before), (0.0, 0.0, 0.05))
    switch(True)
    assert not home.live.stands_in()
    assert np.abs(now() - before).max(axis=1)[np.abs(before[:, :2]).max(axis=1) < 0.5].max() > 1e-4
    switch(False)
