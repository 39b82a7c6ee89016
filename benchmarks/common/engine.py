"""`fairing.fair` in a process of its own with a time limit: what came out, or why nothing did."""

from __future__ import annotations

import multiprocessing
import time
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
LIMIT = 60.0  # seconds of wall-clock time for one call


@dataclass(frozen=True)
class Outcome:
    """vertices (n, 3), mean_curvature (n,), boundary_angle (k',) degrees; cpu in seconds.

    `refused` holds the text of an error, or "timeout"; the arrays are then empty.
    """

    vertices: FloatArray = field(default_factory=lambda: np.empty((0, 3)))
    mean_curvature: FloatArray = field(default_factory=lambda: np.empty(0))
    boundary_angle: FloatArray = field(default_factory=lambda: np.empty(0))
    converged: bool = False
    polished: bool = False
    termination: str = ""
    iterations: int = 0
    residual: float = np.nan
    codes: tuple[str, ...] = ()
    way: tuple[str, ...] = ()
    cpu: float = np.nan
    refused: str = ""
    equation: str = ""

    @property
    def state(self) -> str:
        """One or two words for the tables."""
        if self.refused:
            return "timeout" if self.refused == "timeout" else "refused"
        return self.termination + ("" if self.polished or not self.converged else ", placed")


def _measured(vertices: FloatArray, triangles: NDArray[np.int64], options: dict[str, Any]) -> Outcome:
    import fairing

    start = time.process_time()
    try:
        result = fairing.fair(vertices, triangles, **options)
    except (ValueError, RuntimeError) as error:
        return Outcome(refused=f"{type(error).__name__}: {error}", cpu=time.process_time() - start)
    cpu = time.process_time() - start
    return Outcome(
        np.array(result.vertices), np.array(result.mean_curvature), np.array(result.boundary_angle),
        result.converged, result.polished, result.termination, result.iterations, result.residual,
        tuple(warning.code for warning in result.warnings), tuple(name for name, _ in result.way), cpu,
        equation=result.equation,
    )  # fmt: skip


def _serve(pipe: Connection) -> None:
    while True:
        try:
            request = pipe.recv()
        except EOFError:
            return
        pipe.send(_measured(*request))


class Engine:
    """One worker process, started again after a timeout or a crash."""

    def __init__(self, limit: float = LIMIT) -> None:
        self.limit = limit
        self._context = multiprocessing.get_context("spawn")
        self._process: Any = None
        self._pipe: Any = None

    def fair(self, vertices: FloatArray, triangles: NDArray[np.int64], **options: Any) -> Outcome:
        """The outcome of `fairing.fair` with these arguments, on one thread unless they say otherwise."""
        if self._process is None:
            self._start()
        try:
            self._pipe.send((vertices, triangles, {"threads": 1, **options}))
            if self._pipe.poll(self.limit):
                return self._received()
        except (EOFError, BrokenPipeError):
            self.close()
            return Outcome(refused="the process died")
        self.close()
        return Outcome(refused="timeout", cpu=self.limit)

    def _received(self) -> Outcome:
        outcome = self._pipe.recv()
        assert isinstance(outcome, Outcome)
        return outcome

    def _start(self) -> None:
        self._pipe, other = self._context.Pipe()
        self._process = self._context.Process(target=_serve, args=(other,), daemon=True)
        self._process.start()
        other.close()

    def close(self) -> None:
        """End the worker."""
        if self._process is not None:
            self._process.kill()
            self._process.join()
            self._pipe.close()
            self._process = None
