"""Seconds of the stages of a call, and shares of its progress."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter

Progress = Callable[[float, str], "bool | None"]


class Watch:
    """Seconds of the stages, and the callback's share of each."""

    def __init__(self, progress: Progress | None) -> None:
        self.seconds: dict[str, float] = {}
        self._progress = progress
        self._begin = self._last = perf_counter()

    def lap(self, stage: str) -> None:
        now = perf_counter()
        self.seconds[stage] = now - self._last
        self.seconds["total"] = now - self._begin
        self._last = now

    def part(self, begin: float, end: float) -> Progress | None:
        progress = self._progress
        if progress is None:
            return None
        return lambda fraction, stage: progress(begin + (end - begin) * fraction, stage)
