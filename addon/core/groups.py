"""Numbers that belong together."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from .arrays import Ints


def groups(count: int, pairs: Iterable[tuple[int, int]]) -> list[Ints]:
    """Return 0 … count − 1 in groups, each ascending, of which those of a pair are in one."""
    leader = list(range(count))
    for one, other in pairs:
        leader[_leader_of(leader, one)] = _leader_of(leader, other)
    numbers = np.array([_leader_of(leader, number) for number in range(count)], dtype=np.int64)
    return [np.flatnonzero(numbers == number) for number in np.unique(numbers)]


def _leader_of(leader: list[int], number: int) -> int:
    """Follow the path to the one that leads itself, and shorten it."""
    while leader[number] != number:
        leader[number] = leader[leader[number]]
        number = leader[number]
    return number
