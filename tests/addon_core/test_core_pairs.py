"""Keys of pairs."""

import numpy as np
from addon.arrays.places import edge_keys, pair_keys, places_of

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
