"""How many new vertices a call may make: what is out of proportion is refused before it is made."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from fairing import _arguments
from fairing._types import Diagnostic, IntArray, MeshError

PROPORTION = 20.0  # times as many as over flat surfaces, or over the old one: more are refused
_ALWAYS = 50_000  # new vertices, which take some two seconds: never refused
_SMALL = 1000  # new vertices that are solved in any case
_NEVER = 4_000_000  # new vertices: a slip in the spacing, rather than a wish


@dataclass(frozen=True)
class Limit:
    """Of the new vertices of a call."""

    flat: float
    """About how many there would be over flat surfaces, or over the old one."""
    most: float
    chosen: bool
    """By the caller."""

    @classmethod
    def of(cls, flat: float, max_vertices: Any) -> Limit:
        """``max_vertices``: the caller's; 0: twenty times as many as over flat surfaces, within bounds."""
        given = _arguments.whole("max_vertices", max_vertices, 0)
        return cls(flat, float(given or min(max(_ALWAYS, PROPORTION * flat), _NEVER)), given > 0)

    def check(self, count: float, elements: IntArray, found: bool = True) -> None:
        """MeshError (OUT_OF_PROPORTION) where so many vertices would be too many; ``elements``: vertices around.

        ``found``: whether a first small surface was. What is left of a search in vain deserves no large mesh, however
        large it is: nothing is always accepted then.
        """
        most = self.most if found or self.chosen else min(self.most, max(_SMALL, PROPORTION * self.flat))
        if count <= most:
            return
        text = f"the surface would take about {count:.2g} new vertices, and {most:.2g} are accepted"
        text += ": raise `spacing`, or allow more by `max_vertices`"
        if not found:
            text = f"no surface was found on a small mesh, and {text}"
        figures = {"count": float(count), "limit": most, "flat": self.flat}
        where = np.unique(elements).astype(np.int32)
        raise MeshError(Diagnostic("OUT_OF_PROPORTION", text, where, "vertex", figures))
