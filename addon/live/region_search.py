"""The ways to a live region's surface that take their time. Knows nothing of Blender."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import fairing

from ..arrays.types import Floats
from ..fair.engine import Progress
from ..words.words import said
from .region import LiveRegion

LEISURE = 3.0  # seconds of the processor for each of the three ways to an answer: other work is no reason to give up

Ask = Callable[[Floats, Floats, Progress], "Floats | None"]


@dataclass(frozen=True)
class Found:
    """How a search has ended."""

    positions: Floats | None = None  # (k, 3) of the region's free vertices; None: there is no surface
    stands_in: bool = False  # the surface of least variation instead of the one that was asked for


def sought(region: LiveRegion, positions: Floats, matrix: Floats, progress: Progress) -> Found:
    """Search for the surface itself, from the last answer and afresh, then for the one that stands in for it.

    positions: (n, 3) of region.vertices; matrix: (4, 4) to world space. Ends early where `progress` says so.
    """
    for ask in (region.answer, region.afresh, region.stand_in):
        if progress(0.0, "") is False:  # even to begin may take a while
            break
        answer = _in_time(ask, positions, matrix, progress)
        if answer is not None:
            return Found(answer, ask == region.stand_in)
    return Found()


def first(region: LiveRegion, positions: Floats, matrix: Floats, progress: Progress) -> Found:
    """Search for a new region's surface, then for the one that stands in, however long that takes.

    Raises what engine.REFUSALS lists where there is none, and fairing.Cancelled.
    """
    for ask in (region.answer, region.stand_in):
        try:
            answer = ask(positions, matrix, progress)
        except fairing.SolverError:
            continue
        if answer is not None:
            return Found(answer, ask == region.stand_in)
    raise fairing.SolverError(said("no_surface_for_region"))


def _in_time(ask: Ask, positions: Floats, matrix: Floats, progress: Progress) -> Floats | None:
    end = time.thread_time() + LEISURE

    def goes_on(part: float, stage: str) -> bool:
        return progress(part, stage) is not False and time.thread_time() < end

    try:
        return ask(positions, matrix, goes_on)
    except (fairing.Cancelled, fairing.SolverError):
        return None
