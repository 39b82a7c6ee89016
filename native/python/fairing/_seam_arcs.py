"""Seams as arcs between the vertices where they meet or end, and the lines beside each of them."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from fairing._found_line import FoundLine, NoRowsError
from fairing._types import FloatArray, IntArray

RIGHT, LEFT = 0, 1
_SAME = 1e-6  # of an arc's length: roundoff of feet

End = tuple[int, int]
"""An arc and one of its ends: 0 where it begins, 1 where it ends."""


@dataclass(frozen=True)
class Arc:
    """A seam from one meeting to the next."""

    vertices: list[int]
    ways: FloatArray
    """Along it at each vertex, from 0."""
    closed: bool
    """The first vertex then comes last, too."""

    @property
    def length(self) -> float:
        return float(self.ways[-1])


def arcs_of(seams: IntArray, points: FloatArray) -> list[Arc]:
    beside: dict[int, list[int]] = {}
    for a, b in np.unique(np.sort(seams, axis=1), axis=0).tolist():
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    meetings = [v for v, others in beside.items() if len(others) != 2]
    used: set[tuple[int, int]] = set()
    found = []
    for start in [*meetings, *beside]:
        for second in beside[start]:
            if (start, second) in used:
                continue
            chain = [start, second]
            while len(beside[chain[-1]]) == 2 and chain[-1] != start:
                chain.append(next(v for v in beside[chain[-1]] if v != chain[-2]))
            used |= {pair for a, b in pairwise(chain) for pair in ((a, b), (b, a))}
            steps = np.linalg.norm(np.diff(points[chain], axis=0), axis=1)
            closed = chain[0] == chain[-1] and len(beside[start]) == 2
            found.append(Arc(chain, np.concatenate([[0.0], np.cumsum(steps)]), closed))
    return found


class Label(NamedTuple):
    """Which arc, on which side, and how far along it; at a meeting's vertex: that, with arc −1."""

    arc: int
    side: int
    way: float
    vertex: int = -1


@dataclass
class Run:
    """The line on one side of an arc, in the arc's direction."""

    points: list[int]
    segments: list[int]
    """Of the line, between one point and the next."""
    ways: FloatArray
    """Of the feet along the arc."""
    closed: bool


@dataclass
class Network:
    """Arcs and what is on their sides."""

    arcs: list[Arc]
    runs: dict[tuple[int, int], Run] = field(default_factory=dict)
    """By arc and side."""
    onward: dict[End, tuple[End, list[int], list[int]]] = field(default_factory=dict)
    """Where the line that comes to an arc's end goes on beside another one's: the points in between, and segments."""


def network_of(line: FoundLine, points: FloatArray) -> Network:
    """Raises NoRowsError where an arc has not one line on either side."""
    result = Network(arcs_of(line.seams, points))
    labels = _labels(line, result.arcs)
    for chain, segments, closed in line.chains():
        _add_chain(result, labels, chain, segments, closed)
    if len(result.runs) != 2 * len(result.arcs):
        raise NoRowsError
    return result


def _labels(line: FoundLine, arcs: list[Arc]) -> list[Label | None]:
    """Of each point of the line."""
    place: dict[tuple[int, int], tuple[int, int, int]] = {}
    meetings = {v for arc in arcs if not arc.closed for v in (arc.vertices[0], arc.vertices[-1])}
    for number, arc in enumerate(arcs):
        for k, (a, b) in enumerate(pairwise(arc.vertices)):
            place[a, b], place[b, a] = (number, LEFT, k), (number, RIGHT, k)
    found: list[Label | None] = []
    rows = zip(line.feet.tolist(), line.corner.tolist(), line.foot_along.tolist(), strict=True)
    for (tail, head), corner, along in rows:
        at = place.get((tail, head))
        if corner and tail in meetings:
            found.append(Label(-1, 0, 0.0, tail))
        elif at is None:
            found.append(None)
        else:
            number, side, k = at
            step = 0.0 if corner else along
            ways = arcs[number].ways
            found.append(Label(number, side, float(ways[k] + step if side == LEFT else ways[k + 1] - step)))
    return found


def _add_chain(
    network: Network, labels: list[Label | None], chain: list[int], segments: list[int], closed: bool
) -> None:
    """Part a chain where it comes from one arc's side to another's."""
    kinds = [_kind(labels[p]) for p in chain]
    if not any(kinds):
        raise NoRowsError
    if closed:
        named = [k for k, kind in enumerate(kinds[:-1]) if kind]
        turn = next((k for at, k in enumerate(named) if kinds[k] != kinds[named[at - 1]]), 0)
        chain = [*chain[turn:-1], *chain[: turn + 1]]
        segments = [*segments[turn:], *segments[:turn]]
        kinds = [*kinds[turn:-1], *kinds[: turn + 1]]
        if len(set(filter(None, kinds))) == 1:
            _add_ring(network, labels, (chain, segments), next(filter(None, kinds)))
            return
    pieces: list[tuple[int, int]] = []
    for k in [k for k, kind in enumerate(kinds) if kind]:
        if pieces and kinds[k] == kinds[pieces[-1][1]]:
            pieces[-1] = (pieces[-1][0], k)
        else:
            pieces.append((k, k))
    if not closed:
        pieces[0] = (0, pieces[0][1])
        pieces[-1] = (pieces[-1][0], len(chain) - 1)
    found = [next(filter(None, kinds[first : last + 1])) for first, last in pieces]
    for (first, last), kind in list(zip(pieces, found, strict=True))[: -1 if closed else None]:
        _add_run(network, labels, (chain[first : last + 1], segments[first:last]), kind, False)
    for k in range(len(pieces) - 1):
        (come, came_on), (go, goes_on) = found[k], found[k + 1]
        last, first = pieces[k][1], pieces[k + 1][0]
        network.onward[come, 1 if came_on == RIGHT else 0] = (
            (go, 0 if goes_on == RIGHT else 1), chain[last : first + 1], segments[last:first]
        )  # fmt: skip


def _add_ring(
    network: Network, labels: list[Label | None], found: tuple[list[int], list[int]], kind: tuple[int, int]
) -> None:
    """A closed chain beside one arc, which is closed, or begins and ends at one meeting: then it is cut there."""
    if network.arcs[kind[0]].closed:
        _add_run(network, labels, found, kind, True)
        return
    chain, segments = found
    ways = [(k, label.way) for k, label in enumerate(labels[p] for p in chain[:-1]) if label and label.arc >= 0]
    sign = 1 if kind[1] == RIGHT else -1
    falls = [sign * (before[1] - after[1]) for before, after in pairwise([*ways, ways[0]])]
    cut = int(np.argmax(falls))
    last, first = ways[cut][0], ways[(cut + 1) % len(ways)][0]
    count = len(chain) - 1
    run = [(first + k) % count for k in range((last - first) % count + 1)]
    gap = [(last + k) % count for k in range((first - last) % count + 1)]
    _add_run(network, labels, ([chain[k] for k in run], [segments[k] for k in run[:-1]]), kind, False)
    ends = (kind[0], 1), (kind[0], 0)
    end, other = ends if kind[1] == RIGHT else ends[::-1]
    network.onward[end] = other, [chain[k] for k in gap], [segments[k] for k in gap[:-1]]


def _kind(label: Label | None) -> tuple[int, int] | None:
    return None if label is None or label.arc < 0 else (label.arc, label.side)


def _add_run(
    network: Network,
    labels: list[Label | None],
    found: tuple[list[int], list[int]],
    kind: tuple[int, int],
    closed: bool,
) -> None:
    chain, segments = found
    if kind in network.runs or network.arcs[kind[0]].closed != closed:
        raise NoRowsError
    own = [labels[p] for p in chain]
    known = [k for k, label in enumerate(own) if label is not None and label.arc >= 0]
    ways = np.array([own[k].way for k in known])  # type: ignore[union-attr]
    if kind[1] == LEFT:
        chain, segments, ways = chain[::-1], segments[::-1], ways[::-1]
        known = [len(chain) - 1 - k for k in known[::-1]]
    arc = network.arcs[kind[0]]
    if closed:
        chain, segments, ways, known = _from_begin(chain, segments, ways, known, arc.length)
    if (np.diff(ways) < -_SAME * arc.length).any():
        raise NoRowsError
    at = np.interp(np.arange(len(chain)), known, ways)
    network.runs[kind] = Run(chain, segments, at, closed)


def _from_begin(
    chain: list[int], segments: list[int], ways: FloatArray, known: list[int], length: float
) -> tuple[list[int], list[int], FloatArray, list[int]]:
    """A closed run that begins where the way along the arc is least; its first point comes last, a turn later."""
    drop = int(np.argmin(np.diff(ways))) + 1 if len(ways) > 1 and np.diff(ways).min() < -0.5 * length else 0
    start = known[drop] if drop < len(known) else 0
    count = len(chain) - 1
    order = [(start + k) % count for k in range(count)]
    at = {k: way for k, way in zip(known, ways.tolist(), strict=True) if k < count}
    kept = [(place, at[k]) for place, k in enumerate(order) if k in at]
    turned = np.array([way for _, way in kept])
    return (
        [*(chain[k] for k in order), chain[start]],
        [segments[k] for k in order],
        np.append(turned, turned[0] + length),
        [*(place for place, _ in kept), count],
    )
