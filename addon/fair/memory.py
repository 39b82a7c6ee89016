"""What was found for the meshes read lately, so that the redo panel answers at once. One for the whole add-on."""

from __future__ import annotations

import hashlib
import io
import pickle
from collections import OrderedDict
from collections.abc import Mapping
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
    """Return one hash of arrays, numbers, strings, None, and of dataclasses, mappings and sequences of these."""
    found = io.BytesIO()
    pickler = pickle.Pickler(found, protocol=5)
    pickler.fast = True  # or it would count which of them are the same objects
    for each in inputs:
        pickler.dump(np.ascontiguousarray(each) if isinstance(each, np.ndarray) else each)
    return hashlib.blake2b(found.getbuffer(), digest_size=20).hexdigest()
