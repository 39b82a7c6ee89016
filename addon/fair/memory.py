"""The last few results by their input, so that the redo panel's factor answers at once."""

from __future__ import annotations

import hashlib
from collections import OrderedDict
from collections.abc import Mapping, Sequence
from dataclasses import fields, is_dataclass
from threading import Lock
from typing import Any, Generic, TypeVar

import numpy as np

Value = TypeVar("Value")


class Memory(Generic[Value]):
    """Keeps the `size` values used last."""

    def __init__(self, size: int) -> None:
        self._size = size
        self._values: OrderedDict[str, Value] = OrderedDict()
        self._lock = Lock()  # a cancelled run may end while the next one has begun

    def __contains__(self, key: str) -> bool:
        with self._lock:
            return key in self._values

    def get(self, key: str) -> Value | None:
        with self._lock:
            if key in self._values:
                self._values.move_to_end(key)
            return self._values.get(key)

    def take(self, key: str) -> Value | None:
        """Return the value kept for the key and keep it no longer: it can't be used twice at a time."""
        with self._lock:
            return self._values.pop(key, None)

    def put(self, key: str, value: Value) -> None:
        """Keep a value, and forget the one that was not used for longest."""
        with self._lock:
            self._values[key] = value
            self._values.move_to_end(key)
            while len(self._values) > self._size:
                self._values.popitem(last=False)

    def clear(self) -> None:
        with self._lock:
            self._values.clear()


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
