"""Threads change no bit, whatever is called."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import fairing
import holes
import shapes
import test_detail
import test_joins
import tubes
from rough_sphere import rough_sphere
from solving import fair_patch

# Made once: made again, Qhull may cut the same points into other triangles.
BALL, CAP, CATENOID, LARGE = rough_sphere(4_000), shapes.cap(4000), shapes.catenoid(300), shapes.catenoid(12000)
PIPE = tubes.pipe(4.0, 5.0, seed=3)
TORUS = test_joins.joined("torus", 1000)[0]
CALLS: dict[str, Callable[..., Any]] = {
    "fair": lambda **n: fair_patch(CATENOID, **n),
    "fair a large patch": lambda **n: fair_patch(LARGE, **n),
    "least variation": lambda **n: PIPE.faired(**n),
    "curvature": lambda **n: test_joins.with_curvature(TORUS, TORUS.mean_curvature[TORUS.fixed], **n),
    "detail": lambda **n: test_detail.fair(CAP, test_detail.rough(CAP), detail=1.0, **n),
    "fill": lambda **n: fairing.fill(*holes.bowl(48), spacing=0.8 * np.sin(np.pi / 48), **n),
    "denoise": lambda **n: fairing.denoise(BALL.skin, np.concatenate([BALL.inside, BALL.outside]), **n),
}


@pytest.mark.parametrize("name", CALLS)
def test_the_same_bits_for_any_number_of_threads(name: str) -> None:
    def bits(threads: int) -> list[bytes]:
        found = CALLS[name](threads=threads)
        parts = (getattr(found, part, ()) for part in ("vertices", "triangles", "boundary_angle"))
        return [np.asarray(part).tobytes() for part in ((found,) if name == "denoise" else parts)]

    one = bits(1)
    assert all(bits(threads) == one for threads in (1, 2, 3, 0))
