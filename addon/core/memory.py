"""The last few results by their input, so that the redo panel's factor answers at once."""

from __future__ import annotations

import hashlib
from collections import OrderedDict
from dataclasses import fields
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
        """Tell whether something is kept for the key."""
        with self._lock:
            return key in self._values

    def get(self, key: str) -> Value | None:
        """Return the value kept for the key, or None."""
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
        """Forget all."""
        with self._lock:
            self._values.clear()


def digest(*inputs: Any) -> str:
    """Return one hash of arrays, of dataclasses of arrays, and of values with a repr of their own."""
    state = hashlib.blake2b(digest_size=20)
    for given in inputs:
        _feed(state, given)
    return state.hexdigest()


def _feed(state: Any, given: Any) -> None:
    if isinstance(given, np.ndarray):
        state.update(f"{given.dtype}{given.shape}".encode())
        state.update(np.ascontiguousarray(given).reshape(-1).view(np.uint8))
    elif hasattr(given, "__dataclass_fields__"):
        for field in fields(given):
            state.update(field.name.encode())
            _feed(state, getattr(given, field.name))
    else:
        state.update(f"{given!r};".encode())
