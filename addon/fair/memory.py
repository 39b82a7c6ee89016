"""What was found for the meshes read lately, so that the redo panel answers at once. One for the whole add-on."""

from __future__ import annotations

import hashlib
from collections import OrderedDict
from collections.abc import Mapping, Sequence
from dataclasses import fields, is_dataclass
from threading import Lock
from typing import Any

import numpy as np

# How many of each kind are kept: enough for the objects of one redo panel. Solvers hold factorisations.
ANSWER, SOLVER, EDGES = "answer", "solver", "hard edges"
MOST = {ANSWER: 4, SOLVER: 2, EDGES: 4}


class Memory:
    """Keeps the values of each kind that were used last, by the digest of what they were found for."""

    def __init__(self, most: Mapping[str, int]) -> None:
        self._most = most
        self._values: dict[str, OrderedDict[str, Any]] = {kind: OrderedDict() for kind in most}
        self._lock = Lock()  # a cancelled run may end while the next one has begun

    def has(self, kind: str, key: str) -> bool:
        with self._lock:
            return key in self._values[kind]

    def get(self, kind: str, key: str) -> Any:
        """Return the value kept for the key, or None."""
        with self._lock:
            if key in self._values[kind]:
                self._values[kind].move_to_end(key)
            return self._values[kind].get(key)

    def take(self, kind: str, key: str) -> Any:
        """Return the value kept for the key and keep it no longer: it can't be used twice at a time."""
        with self._lock:
            return self._values[kind].pop(key, None)

    def put(self, kind: str, key: str, value: Any) -> None:
        """Keep a value, and forget the one of its kind that was not used for longest."""
        with self._lock:
            values = self._values[kind]
            values[key] = value
            values.move_to_end(key)
            while len(values) > self._most[kind]:
                values.popitem(last=False)

    def clear(self, *kinds: str) -> None:
        """Forget what is kept of these kinds; of all where none is named."""
        with self._lock:
            for kind in kinds or self._values:
                self._values[kind].clear()


memory = Memory(MOST)


def digest(*inputs: Any) -> str:
    """Return one hash of arrays, numbers, strings, None, and of dataclasses, mappings and sequences of these.

    Raises TypeError for anything else: what looks the same when printed may differ.
    """
    state = hashlib.blake2b(digest_size=20)
    _feed(state, inputs)
    return state.hexdigest()


def _feed(state: Any, given: Any) -> None:
    """Feed a value after its kind and size, so that no two values feed the same bytes."""
    if isinstance(given, np.ndarray) and not given.dtype.hasobject:
        state.update(f"array {given.dtype}{given.shape};".encode())
        state.update(np.ascontiguousarray(given).reshape(-1).view(np.uint8))
    elif is_dataclass(given) and not isinstance(given, type):
        state.update(f"{type(given).__qualname__};".encode())
        _feed(state, {field.name: getattr(given, field.name) for field in fields(given)})
    elif isinstance(given, Mapping):
        _feed_all(state, "mapping", [part for pair in given.items() for part in pair])
    elif isinstance(given, (tuple, list)):
        _feed_all(state, "sequence", given)
    elif given is None or isinstance(given, (bool, int, float, str)):
        text = repr(given)
        state.update(f"{type(given).__name__} {len(text)} {text};".encode())
    else:
        raise TypeError(f"{type(given).__name__} has no digest")


def _feed_all(state: Any, kind: str, parts: Sequence[Any]) -> None:
    state.update(f"{kind} {len(parts)};".encode())
    for part in parts:
        _feed(state, part)
