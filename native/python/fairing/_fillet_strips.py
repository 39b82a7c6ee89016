"""The strips beside all arcs of some seams, and how their ends are joined."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from fairing._columns import strip_of
from fairing._cut_anew import wall_way
from fairing._found_line import FoundLine, NoRowsError
from fairing._seam_arcs import LEFT, RIGHT, End, Network, network_of
from fairing._strip_surface import Solved
from fairing._strips import Hook, Spot, Strip, WallPoint, corner_between, side_of, without_hook
from fairing._types import FloatArray


@dataclass
class Seams:
    """What the rows are made for."""

    points: FloatArray
    line: FoundLine
    width: float
    spacing: float
    linked: Callable[[int], int]
    """The seam's vertex to which the edge at a point of the line leads, or −1."""
    must: Callable[[int], bool]
    """Whether the mesh outside needs a point of the line."""

    @property
    def rows(self) -> int:
        return 2 * max(1, round(self.width / self.spacing))


@dataclass
class Ends:
    """The corners where the lines of two arcs meet, or the ways around them."""

    corners: dict[End, Spot] = field(default_factory=dict)
    """By the arc's end at which the line arrives,"""
    around: dict[End, list[Spot]] = field(default_factory=dict)
    """or a way from where it arrives to where it leaves."""


@dataclass
class Strips:
    """Of each arc one, and the surface that it lies on."""

    network: Network
    ends: Ends
    strips: list[Strip]
    on: list[Solved]


def strips_of(seams: Seams, solved: list[Solved]) -> Strips:
    """Raises NoRowsError."""
    network = network_of(seams.line, seams.points)
    ends = _ends_of(network, seams)
    strips = [_strip(network, ends, number, seams) for number in range(len(network.arcs))]
    on = [_surface_at(solved, strip) for strip in strips]
    for number, (strip, surface) in enumerate(zip(strips, on, strict=True)):
        _add_walled(strip, [which for which in (0, 1) if not continues(network, (number, which))], seams)
        surface.refine(strip, seams.rows, seams.width)
    return Strips(network, ends, strips, on)


def continues(network: Network, end: End) -> bool:
    """Whether lines lead on beyond an arc's end; else it is at walls."""
    goes_on, comes = end in network.onward, any(end == other for other, _, _ in network.onward.values())
    if goes_on != comes:
        raise NoRowsError
    return goes_on or network.arcs[end[0]].closed


def _add_walled(strip: Strip, ends: list[int], seams: Seams) -> None:
    """The points on walls, and on straight ways to the ends of seams beside hooks."""
    half = seams.rows // 2
    for which in ends:
        column = strip.columns[-which]
        middle = strip.arc.vertices[-which]
        ways = []
        for side, spot in enumerate(strip.spots(column)):
            hook = strip.hooks.get((which, side))
            if hook is None:
                ways.append(wall_way(seams.line, seams.points, spot, middle, half))
                continue
            hook.wall = wall_way(seams.line, seams.points, hook.spots[-1], middle, half)
            shares = np.arange(1, half)[:, None] / half
            ways.append([WallPoint(place, -1) for place in spot.place + shares * (seams.points[middle] - spot.place)])
        strip.walled[column] = (ways[0], ways[1])


def _surface_at(solved: list[Solved], strip: Strip) -> Solved:
    place = strip.sides[RIGHT].at(0.5 * strip.sides[RIGHT].length).place
    return min(solved, key=lambda each: each.distance(place))


def _ends_of(network: Network, seams: Seams) -> Ends:
    found = Ends()
    for end, (other, between, segments) in network.onward.items():
        if len(between) == 2:
            come, go = _run(network, end, True), _run(network, other, False)
            found.corners[end] = corner_between(seams.line, come, go, segments[0], seams.spacing)
        else:
            found.around[end] = [Spot(seams.line.places[p], p) for p in between]
            if end != other and len(between) == 3:
                found.corners[end] = found.around.pop(end)[1]
    return found


def _run(network: Network, end: End, arrives: bool) -> list[int]:
    """The points of the line that comes to an arc's end, or leaves it, as the line runs; a few of them."""
    arc, which = end
    side = arriving(which) if arrives else 1 - arriving(which)
    points = network.runs[arc, side].points
    if side == LEFT:
        points = points[::-1]
    return points[-4:] if arrives else points[:4]


def arriving(which: int) -> int:
    """The side on which the line runs to an arc's end."""
    return RIGHT if which == 1 else LEFT


def _strip(network: Network, ends: Ends, number: int, seams: Seams) -> Strip:
    before = {other: end for end, (other, _, _) in network.onward.items()}
    sides = []
    for side in (RIGHT, LEFT):
        corners: list[Spot | None] = []
        for which in (0, 1):
            arrives = arriving(which) == side
            end: End | None = (number, which) if arrives else before.get((number, which))
            corners.append(None if end is None else ends.corners.get(end))
        run = network.runs[number, side]
        sides.append(side_of(seams.line, run, seams.must, (corners[0], corners[1])))
    hooks: dict[tuple[int, int], Hook] = {}
    for which in (0, 1):
        if seams.rows % 4 or continues(network, (number, which)):
            continue
        for side in (RIGHT, LEFT):
            sides[side], hook = without_hook(sides[side], which, seams.width)
            hooks |= {(which, side): hook} if hook else {}
    strip = strip_of(seams.line, network.arcs[number], (sides[0], sides[1]), seams.linked, (seams.width, seams.spacing))
    strip.hooks = hooks
    return strip
