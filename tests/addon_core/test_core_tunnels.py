"""Tunnels in a selection: the genus of its pieces, and the sentence on it where a result is not good."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import core.outcome
from core.arrays import Ints
from core.options import FairOptions
from core.region import MeshArrays, make_patch
from core.solve import solve
from core.tunnels import tunnel_hint, tunnels
from core.verdict import GOOD, LOOK, UNUSABLE, Verdict
from polygon_mesh import grid, grid_quads, on_sphere, polygon_mesh

AROUND, ACROSS = 12, 8


def split(quads: Ints) -> Ints:
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def torus_quads() -> Ints:
    i, j = (part.ravel() for part in np.mgrid[:AROUND, :ACROSS])
    right, up = (i + 1) % AROUND, (j + 1) % ACROSS
    return np.stack([i * ACROSS + j, right * ACROSS + j, right * ACROSS + up, i * ACROSS + up], axis=1)


def torus(left_out: int) -> MeshArrays:
    """A torus with all but a few faces beside each other selected."""
    u, v = (part.ravel() for part in np.mgrid[:AROUND, :ACROSS])
    u, v = 2 * np.pi * u / AROUND, 2 * np.pi * v / ACROSS
    width = 2.0 + 0.7 * np.cos(v)
    points = np.stack([width * np.cos(u), width * np.sin(u), 0.7 * np.sin(v)], axis=1)
    quads = torus_quads()
    block = (quads[:, 0] // ACROSS < left_out) & (quads[:, 0] % ACROSS < left_out)
    return polygon_mesh(points, quads.tolist(), ~block)


def grid_without(*faces: int) -> Ints:
    quads = np.array(grid_quads(6))
    return split(np.delete(quads, faces, axis=0))


@pytest.mark.parametrize(
    ("triangles", "count"),
    [
        (grid_without(), 0),
        (grid_without(14), 0),  # a ring
        (grid_without(14, 21), 0),  # two holes that touch in a vertex
        (grid_without(14, 9), 0),
        (grid_without(0, 5), 0),
        (split(torus_quads()), 1),
        (split(np.delete(torus_quads(), [0], axis=0)), 1),
        (split(np.delete(torus_quads(), [0, 50], axis=0)), 1),
        (split(torus_quads()[: 7 * ACROSS]), 0),  # a tube
    ],
)
def test_tunnels_are_counted(triangles: Ints, count: int) -> None:
    assert tunnels(triangles) == count


@pytest.mark.parametrize(("grade", "told"), [(GOOD, False), (LOOK, True), (UNUSABLE, True)])
def test_only_a_bad_result_is_told_what_its_selection_holds(
    grade: str, told: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    mesh, options = grid(8, 0.5, on_sphere), FairOptions()
    monkeypatch.setattr(core.outcome, "judge", lambda *_: Verdict(grade))
    monkeypatch.setattr(core.outcome, "tunnel_hint", lambda patch: (f"{len(patch.free)} free",))
    found = core.outcome.outcome(mesh, np.eye(4), options, solve(mesh, np.eye(4), options))
    hint = f"{found.free_count} free"
    assert (hint in (*found.warnings, found.verdict.reason)) == told
    assert found.verdict.reason == (hint if grade == UNUSABLE else "")
    assert hint not in found.warnings or grade == LOOK


def test_tunnels_of_all_pieces_are_counted_together() -> None:
    one = torus(4)
    quads = torus_quads()
    two = np.concatenate([quads, quads + AROUND * ACROSS])
    chosen = np.tile(one.in_patch, 2)
    places = np.concatenate([one.positions, one.positions + np.array([10.0, 0.0, 0.0])])
    (hint,) = tunnel_hint(make_patch(polygon_mesh(places, two.tolist(), chosen)))
    assert "2 tunnels or handles" in hint


def test_what_has_no_tunnel_is_told_nothing() -> None:
    mesh = torus(4)
    ring = replace(mesh, in_patch=np.arange(len(mesh.in_patch)) // ACROSS < 6)
    assert tunnel_hint(make_patch(ring)) == ()
