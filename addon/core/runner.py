"""Work in a thread of its own, watched from outside. Knows nothing of Blender."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Generic, TypeVar

Result = TypeVar("Result")
Progress = Callable[[float, str], "bool | None"]


_unfinished: set[threading.Thread] = set()


def wait_for_all(seconds: float) -> bool:
    """Wait for the threads of all runs, cancelled ones too, each at most so long; tell whether all ended."""
    for thread in tuple(_unfinished):
        thread.join(seconds)
    return not any(thread.is_alive() for thread in tuple(_unfinished))


class Run(Generic[Result]):
    """One call of `work(progress)` in the background.

    `work` must touch nothing that the caller changes meanwhile: arrays of its own, never bpy data.
    """

    def __init__(self, work: Callable[[Progress], Result]) -> None:
        self._work = work
        self._stop = threading.Event()
        self._fraction = 0.0
        self._stage = ""
        self._result: Result | None = None
        self._error: BaseException | None = None
        # A daemon: a cancelled engine may finish its step while Blender closes.
        self._thread = threading.Thread(target=self._main, name="fairing", daemon=True)
        _unfinished.add(self._thread)
        self._thread.start()

    @property
    def fraction(self) -> float:
        """Finished part of the work, 0 … 1."""
        return self._fraction

    @property
    def stage(self) -> str:
        """What the work is at."""
        return self._stage

    @property
    def finished(self) -> bool:
        """Whether `result` would return at once."""
        return not self._thread.is_alive()

    def cancel(self) -> None:
        """Ask the work to stop; returns at once. Its result, should there be one, is of no use then."""
        self._stop.set()

    def wait(self, seconds: float | None = None) -> bool:
        """Wait for the end, at most so long, and tell whether it has come."""
        self._thread.join(seconds)
        return self.finished

    def result(self) -> Result:
        """Wait for the end; return what the work returned, or raise what it raised."""
        self._thread.join()
        if self._error is not None:
            raise self._error
        assert self._result is not None
        return self._result

    def _main(self) -> None:
        try:
            self._result = self._work(self._progress)
        except BaseException as error:  # handed over to whoever asks for the result
            self._error = error
        finally:
            _unfinished.discard(self._thread)

    def _progress(self, fraction: float, stage: str) -> bool:
        self._fraction, self._stage = fraction, stage
        return not self._stop.is_set()
