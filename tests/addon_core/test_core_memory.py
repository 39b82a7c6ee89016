"""What is remembered: the values used last, by what they belong to."""

from typing import Any

import numpy as np
import pytest
from addon.fair.memory import Memory, digest
from addon.options.options import FairOptions


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
        (zeros, "None"),
    ]
    assert len({digest(*given) for given in inputs}) == len(inputs)
    assert digest(zeros, FairOptions()) == digest(np.zeros((2, 3)), FairOptions())
    assert digest(zeros[::-1]) == digest(zeros)  # the same values, laid out otherwise


def long_array(change: float) -> np.ndarray[Any, Any]:
    """Return more numbers than numpy prints, with one in their middle that counts."""
    numbers = np.zeros(3000)
    numbers[1500] = change
    return numbers


@pytest.mark.parametrize(
    "wrapped",
    [
        lambda array: {"seam": array},
        lambda array: (array,),
        lambda array: [[array]],
        lambda array: {"seam": ({"more": array},)},
    ],
    ids=["mapping", "tuple", "lists", "nested"],
)
def test_digest_looks_into_mappings_and_sequences(wrapped: Any) -> None:
    assert repr(wrapped(long_array(0.0))) == repr(wrapped(long_array(1.0)))
    assert digest(wrapped(long_array(0.0))) != digest(wrapped(long_array(1.0)))
    assert digest(wrapped(long_array(0.0))) == digest(wrapped(long_array(0.0)))


@pytest.mark.parametrize(
    "odd",
    [object(), {1, 2}, np.array([object()]), FairOptions, len],
    ids=["object", "set", "objects", "class", "function"],
)
def test_digest_refuses_what_it_does_not_know(odd: Any) -> None:
    for given in (odd, (odd,), {"a": odd}):
        with pytest.raises(TypeError, match="no digest"):
            digest(given)
