"""How many new vertices a call may make: what is out of proportion is refused before it is made."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from fairing import _arguments
from fairing._holes import PROPORTION
from fairing._types import Diagnostic, IntArray, MeshError

_ALWAYS = 50_000  # new vertices, which take some two seconds: never refused
_NEVER = 4_000_000  # new vertices: a slip in the spacing, rather than a wish


@dataclass(frozen=True)
class Limit:
    """Of the new vertices of a call."""

    flat: float
    """About how many there would be over flat surfaces, or over the old one."""
    most: float

    @classmethod
    def of(cls, flat: float, max_vertices: Any) -> Limit:
        """``max_vertices``: the caller's; 0: twenty times as many as over flat surfaces, within bounds."""
        given = _arguments.whole("max_vertices", max_vertices, 0)
        return cls(flat, float(given) if given else min(max(_ALWAYS, PROPORTION * flat), _NEVER))

    def check(self, count: float, elements: IntArray, hint: str = "") -> None:
        """MeshError (OUT_OF_PROPORTION) where so many vertices would be too many; ``elements``: vertices around."""
        if count <= self.most:
            return
        text = f"the surface would take about {count:.2g} new vertices, and {self.most:.2g} are accepted"
        text += f"{hint}: raise `spacing`, or allow more by `max_vertices`"
        figures = {"count": float(count), "limit": self.most, "flat": self.flat}
        where = np.unique(elements).astype(np.int32)
        raise MeshError(Diagnostic("OUT_OF_PROPORTION", text, where, "vertex", figures))
