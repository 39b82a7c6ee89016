"""One surface turns into another over some frames, so that no jump shows. Plain numpy, no bpy."""

from __future__ import annotations

from ..arrays.types import Floats
from .carrier import Carrier


class Blend:
    """What is shown of a surface that follows its boundary and may be replaced by another kind of surface.

    The difference at the moment of the change fades away, while the new surface goes on following.
    """

    def __init__(self, seconds: float) -> None:
        """Let a change take so many seconds; 0: none shows anything but the new surface."""
        self.seconds = seconds
        self._kind = ""
        self._target: Floats | None = None
        self._shown: Floats | None = None
        self._still: Floats | None = None
        self._offset: Floats | None = None  # at the moment of the change; None: nothing fades
        self._begun = 0.0

    @property
    def goes_on(self) -> bool:
        """Whether something else than the surface itself is shown."""
        return self._offset is not None

    def towards(self, target: Floats, still: Floats, kind: str, now: float) -> Floats:
        """Take the surface (k, 3) over these boundary vertices (b, 3), and return what to show of it at this time.

        What was shown is carried along by the boundary first: a drag's own move is no jump.
        """
        if self._shown is not None and self._still is not None and kind != self._kind and self.seconds > 0.0:
            self._offset = Carrier(self._still, self._shown).carried(still) - target
            self._begun = now
        self._kind, self._target, self._still = kind, target, still
        return self.shown(now)

    def shown(self, now: float) -> Floats:
        """Return what to show at this time; only after `towards`."""
        assert self._target is not None
        left = 0.0 if self._offset is None else 1.0 - (now - self._begun) / self.seconds
        if left <= 0.0 or self._offset is None:
            self._offset = None
            self._shown = self._target
        else:
            weight = left * left * (3.0 - 2.0 * left)  # begins and ends without a jerk
            self._shown = self._target + weight * self._offset
        return self._shown
