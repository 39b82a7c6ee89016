"""Work in a thread of its own, watched from outside, and who has the meshes meanwhile. Knows nothing of Blender.

Every thread is known here, from its start on, so that `stop_all` can end them all. None of them is a daemon: Python
kills a daemon when the process ends, in the middle of the engine, and that aborts the process. Python joins the
other threads instead, and a run gives up by itself as soon as the main thread has come to its end.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Generic, Protocol, TypeVar

import fairing

Result = TypeVar("Result")
Progress = Callable[[float, str], "bool | None"]

NAME = "fairing"  # of each thread


class Owner(Protocol):
    """Who has the meshes for a while: a run, or an answer that is awaited. A button or another file may end it."""

    unwanted: bool

    def end(self) -> None:
        """Give the meshes up."""


under_way: list[Owner] = []
_holding: list[bool] = []


def is_free() -> bool:
    """Return whether nobody has the meshes: only then does Live write to them."""
    return not under_way and not _holding


@contextmanager
def holding() -> Iterator[None]:
    """Own the meshes during a `with` block."""
    _holding.append(True)
    try:
        yield
    finally:
        _holding.pop()


# Threads, each with what stops it; those that have ended as well, until the next one begins. Main thread only.
_begun: list[tuple[threading.Thread, threading.Event]] = []


def stop_all() -> None:
    """Cancel every run, and return when all threads have ended: a step of the engine later, half a second at most."""
    for _, stop in _begun:
        stop.set()
    while _begun:
        _begun.pop()[0].join()


def call_off_all() -> bool:
    """Ask every run to end; return at once, and whether none of their threads is left."""
    left = [stop for thread, stop in _begun if thread.is_alive()]
    for stop in left:
        stop.set()
    return not left


class Run(Generic[Result]):
    """One call of `work(progress)` in the background.

    `work` must touch nothing that the caller changes meanwhile: arrays of its own, never bpy data. It must ask
    `progress` now and then, and end soon once that returns False.
    """

    def __init__(self, work: Callable[[Progress], Result]) -> None:
        self._work = work
        self._stop = threading.Event()
        self._fraction = 0.0
        self._stage = ""
        self._result: Result | None = None
        self._error: BaseException | None = None
        self._thread = threading.Thread(target=self._main, name=NAME, daemon=False)
        _begun[:] = [known for known in _begun if known[0].is_alive()]
        _begun.append((self._thread, self._stop))
        self._thread.start()

    @property
    def fraction(self) -> float:
        """Finished part of the work, 0 … 1."""
        return self._fraction

    @property
    def stage(self) -> str:
        """The current stage of the work."""
        return self._stage

    @property
    def finished(self) -> bool:
        """Whether `result` would return at once."""
        return not self._thread.is_alive()

    @property
    def cancelled(self) -> bool:
        """Whether it was asked to stop, by `cancel` or by `stop_all`."""
        return self._stop.is_set()

    def cancel(self) -> None:
        """Ask the work to stop; returns at once. It has no result from then on, whatever it came to."""
        self._stop.set()

    def wait(self, seconds: float | None = None) -> bool:
        """Wait for the end, at most so long, and return whether it has come."""
        self._thread.join(seconds)
        return self.finished

    def result(self) -> Result:
        """Wait for the end; return what the work returned, or raise what it raised, or Cancelled where it was."""
        self._thread.join()
        if self.cancelled:
            raise fairing.Cancelled("the run was cancelled")
        if self._error is not None:
            raise self._error
        assert self._result is not None
        return self._result

    def _main(self) -> None:
        try:
            self._result = self._work(self._progress)
        except BaseException as error:  # handed over to whoever asks for the result
            self._error = error

    def _progress(self, fraction: float, stage: str) -> bool:
        self._fraction, self._stage = fraction, stage
        # Python declares the main thread dead before it joins the others at the end of the process.
        return not self._stop.is_set() and threading.main_thread().is_alive()
