"""Small parts: memory, keys of pairs, diagonals, names of faces, means of values, tunnels."""

from typing import Any

import numpy as np
import pytest
from addon.arrays.harmonic import blended, columns, limited_like
from addon.arrays.places import as_indices, edge_keys, pair_keys, places_of
from addon.arrays.triangulation import split_quads, zigzag
from addon.arrays.types import Ints
from addon.fair.memory import Memory, digest
from addon.options.options import FairOptions
from addon.selection.selection import tunnels

from polygon_mesh import grid_quads


def test_memory_keeps_what_was_used_last_of_each_kind() -> None:
    memory = Memory({"few": 2, "others": 2})
    memory.put("others", "a", 0)
    memory.put("few", "a", 1)
    memory.put("few", "b", 2)
    assert memory.get("few", "a") == 1  # now "b" is the one not used for longest
    memory.put("few", "c", 3)
    assert [memory.get("few", key) for key in "abc"] == [1, None, 3]
    assert memory.get("others", "a") == 0
    memory.clear()
    assert memory.get("few", "a") is None
    assert not memory.has("others", "a")


def test_what_is_taken_is_gone() -> None:
    memory = Memory({"one": 2})
    memory.put("one", "a", 1)
    assert memory.take("one", "a") == 1
    assert memory.take("one", "a") is None
    assert not memory.has("one", "a")
    memory.put("one", "a", None)  # nothing is something to remember
    assert memory.has("one", "a")


def test_digest_tells_inputs_apart() -> None:
    zeros, ones = np.zeros((2, 3)), np.ones((2, 3))
    inputs: list[tuple[Any, ...]] = [
        (zeros,),
        (ones,),
        (zeros.reshape(3, 2),),
        (zeros.astype(np.float32),),
        (zeros, zeros),
        (zeros, FairOptions()),
        (zeros, FairOptions(factor=0.5)),
        (zeros, "a"),
        (zeros, "a", "b"),
        (zeros, ("a", "b")),
        (zeros, (("a",), "b")),
        (zeros, {"a": "b"}),
        (zeros, 1),
        (zeros, 1.0),
        (zeros, True),
        (zeros, None),
    ]
    assert len({digest(*given) for given in inputs}) == len(inputs)
    assert digest(zeros, FairOptions()) == digest(np.zeros((2, 3)), FairOptions())
    assert digest(zeros[::-1]) == digest(zeros)  # the same values, laid out otherwise


def test_digest_looks_into_mappings_and_sequences() -> None:
    """Also beyond what numpy prints of an array, and whether or not equal values are the same objects."""
    array, other, same = np.zeros(3000), np.zeros(3000), np.zeros(3000)
    other[1500] = 1.0
    given, changed, again = ({"seam": ({"more": each}, [each])} for each in (array, other, same))
    assert repr(given) == repr(changed)
    assert digest(given) != digest(changed)
    assert digest(given) == digest(again) == digest({"seam": ({"more": array}, [same])})


# Keys of pairs.
MANY = np.array([0, 1, 70_000, 2**31 - 1])


def test_keys_are_exact_and_in_order_where_products_pass_32_bits() -> None:
    """In 32 bits, as Windows' NumPy counts before 2, 70,000 faces of 70,000 vertices come back to the same keys."""
    first, second = (grid.ravel().astype(np.int32) for grid in np.meshgrid(MANY, MANY, indexing="ij"))
    keys = pair_keys(first, second)
    assert keys.dtype == np.int64
    assert keys.tolist() == [2**32 * int(a) + int(b) for a, b in zip(first, second, strict=True)]
    assert (np.diff(keys) > 0).all()


def test_an_edge_has_one_key_from_either_end() -> None:
    edges = np.array([[70_000, 3], [3, 70_001]], dtype=np.int32)
    np.testing.assert_array_equal(edge_keys(edges), edge_keys(edges[:, ::-1]))
    assert len(np.unique(edge_keys(edges))) == 2


def test_places_are_those_of_the_keys() -> None:
    keys = np.array([8, 3, 5, 13])
    np.testing.assert_array_equal(places_of(np.array([5, 5, 13, 8]), keys), [2, 2, 3, 0])


# Diagonals: wound as the faces, by connectivity alone, regular where that is possible.
@pytest.mark.parametrize("size", [5, 6, 9])
def test_zigzag_covers_a_convex_polygon_once(size: int) -> None:
    angles = 2.0 * np.pi * np.arange(size) / size
    corners = np.column_stack([np.cos(angles), np.sin(angles)])
    triangles = zigzag(np.arange(size)[None])
    assert len(triangles) == size - 2
    a, b, c = (corners[column] for column in triangles.T)
    doubled = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    assert doubled.min() > 0.0  # wound as the polygon
    assert doubled.sum() == pytest.approx(size * np.sin(2.0 * np.pi / size))  # its area, twice


def edges_of(faces: np.ndarray) -> np.ndarray:
    sides = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    return np.unique(sides, axis=0)


def test_a_diagonal_between_fixed_vertices_is_turned_away() -> None:
    """One quad with two free corners, beside which the cost of a fixed diagonal decides."""
    quads = np.array([[0, 1, 2, 3]])
    for fixed in ([0, 2], [1, 3]):
        free = np.ones(4, dtype=bool)
        free[fixed] = False
        triangles = split_quads(quads, edges_of(quads), free)
        shared = [v for v in range(4) if (triangles == v).any(axis=1).all()]
        assert shared == sorted(set(range(4)) - set(fixed))


# How scripts name faces and vertices.
@pytest.mark.parametrize(
    ("given", "meant"),
    [
        ([3, 1], [3, 1]),
        (range(2), [0, 1]),
        (np.array([2], dtype=np.uint8), [2]),
        ([], []),
        (np.array([False, True, False, True]), [1, 3]),
        ([True, False, False, False], [0]),
    ],
)
def test_numbers_and_masks_are_understood(given: Any, meant: list[int]) -> None:
    assert as_indices("faces", given, 4).tolist() == meant


@pytest.mark.parametrize(
    ("given", "error", "reported"),
    [
        ([1.0, 2.0], TypeError, "faces: expected numbers of faces, or a mask, got float64"),
        (["a"], TypeError, "faces: expected numbers"),
        ([True, False], ValueError, "faces: expected a mask of 4, or numbers, got 2 truth values"),
        ([4], IndexError, "faces: expected indices below 4"),
        ([-1], IndexError, "faces: expected indices below 4"),
    ],
)
def test_anything_else_is_refused_by_name(given: Any, error: type[Exception], reported: str) -> None:
    with pytest.raises(error, match=reported):
        as_indices("faces", given, 4)


# Means of turns, which keep their lengths, and how many vertex groups a new vertex is in.
HALF = np.array([[0.5, 0.5]])


def matrix(angle: float, scale: float, place: float) -> np.ndarray:  # type: ignore[type-arg]
    """Return a turn about z as Blender keeps it, column after column."""
    c, s = np.cos(angle), np.sin(angle)
    axes = scale * np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    return np.vstack([np.hstack([axes, np.zeros((3, 1))]), [[place, 0.0, 0.0, 1.0]]]).ravel()


def test_a_mean_of_turns_is_a_turn_whichever_sign_they_have() -> None:
    quarter = np.array([np.cos(np.pi / 4), 0.0, 0.0, np.sin(np.pi / 4)])
    turns = np.stack([np.array([1.0, 0.0, 0.0, 0.0]), -quarter])
    mean = blended("QUATERNION", HALF @ columns("QUATERNION", turns))
    np.testing.assert_allclose(mean[0], [np.cos(np.pi / 8), 0.0, 0.0, np.sin(np.pi / 8)], atol=1e-12)


def test_a_mean_of_matrices_does_not_shrink() -> None:
    both = np.stack([matrix(0.0, 2.0, 0.0), matrix(1.0, 4.0, 6.0)])
    mean = blended("FLOAT4X4", HALF @ columns("FLOAT4X4", both))[0].reshape(4, 4)
    np.testing.assert_allclose(np.linalg.norm(mean[:3, :3], axis=1), 3.0, rtol=1e-12)
    np.testing.assert_allclose(mean[3], [3.0, 0.0, 0.0, 1.0], atol=1e-12)


def test_no_vertex_is_in_more_groups_than_one_around_and_the_sum_stays() -> None:
    sources = np.array([[0.5, 0.5, 0.0, 0.0], [0.0, 0.0, 0.75, 0.25]])
    mean = HALF @ sources
    every = np.ones(4, dtype=bool)
    found = limited_like(mean, sources, every)
    np.testing.assert_allclose(found, [[0.4, 0.0, 0.6, 0.0]])  # .25 and .375 of 1, the first of two equal ones
    np.testing.assert_allclose(limited_like(mean, np.eye(4), every), [[0.0, 0.0, 1.0, 0.0]])
    assert np.array_equal(limited_like(mean, mean, every), mean)


def test_groups_that_are_of_no_bone_are_not_counted() -> None:
    sources = np.array([[1.0, 0.0, 0.9], [0.0, 1.0, 0.0]])
    bones = np.array([True, True, False])
    found = limited_like(HALF @ sources, sources, bones)
    np.testing.assert_allclose(found, [[1.0, 0.0, 0.45]])


# Tunnels in a selection: the genus of its pieces, and the sentence on it where a result is not good.
AROUND, ACROSS = 12, 8


def split(quads: Ints) -> Ints:
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def torus_quads() -> Ints:
    i, j = (part.ravel() for part in np.mgrid[:AROUND, :ACROSS])
    right, up = (i + 1) % AROUND, (j + 1) % ACROSS
    return np.stack([i * ACROSS + j, right * ACROSS + j, right * ACROSS + up, i * ACROSS + up], axis=1)


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
