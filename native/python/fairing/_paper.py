"""Options that only method "paper" has."""

from __future__ import annotations

from dataclasses import dataclass

from fairing import _arguments, _core

SWEEPS_AS_PUBLISHED = 1


@dataclass(frozen=True)
class PaperOptions:
    """What Schneider & Kobbelt leave open (§6, §7), and what was added to it. ValueError names what is not accepted."""

    damping: float = 0.9
    """s of §7.5, in (0, 1]."""
    cg_steps: int = 60
    """Conjugate gradient steps of a global H-update (§7.1)."""
    sweeps: int = 1
    """Gauss–Seidel sweeps of a local H-update (§7.1)."""
    vertex_sweeps: int | None = None
    """Sweeps over the vertices in each update of the mesh (§7.2). Left out: 2, without acceleration 1."""
    epsilon: float | None = None
    """Stop at max |Δ_B H − f| D³ ≤ ``epsilon`` (|H| D for "soap_film"). None: where the changes still to come,
    estimated from the last ones, are ``tolerance`` × D."""
    acceleration: str = "anderson"
    """Whether each cycle of updates starts from the best combination of the last sixteen ("anderson"), or where the
    last one ended ("none"), as published."""
    virtual_points: str = "everywhere"
    """Which fits of H get virtual points (§6.2) besides valence 3 and 4 and fixed vertices: no others ("sparse"), all
    on the coarse levels ("coarse", as published), all ("everywhere")."""
    start: str = "improved"
    """Fill of the coarsest level: the linear bilaplacian ("linear"), or that made fair by mixed finite elements
    ("improved"). With ``levels=1, max_iterations=1`` it is what comes back."""

    def __post_init__(self) -> None:
        for name in ("acceleration", "virtual_points", "start"):
            _arguments.choice(name, getattr(self, name), _core.WORDS[name])
        if self.vertex_sweeps is None:
            sweeps = SWEEPS_AS_PUBLISHED if self.acceleration == "none" else _core.PaperOptions().vertex_sweeps
            object.__setattr__(self, "vertex_sweeps", sweeps)
        for name in ("cg_steps", "sweeps", "vertex_sweeps"):
            _arguments.whole(name, getattr(self, name), 1)
        if _arguments.positive("damping", self.damping) > 1.0:
            raise ValueError(f"damping: {self.damping} is not accepted; accepted is above 0 and up to 1")
        if self.epsilon is not None:
            _arguments.positive("epsilon", self.epsilon)


_LEFT_OUT = PaperOptions()


def engine_options(method: str, levels: int, given: PaperOptions | None) -> _core.PaperOptions:
    """What the engine takes, checked; ``given`` is None where the caller leaves it out."""
    if given is not None and not isinstance(given, PaperOptions):
        raise ValueError(f"paper: a fairing.PaperOptions is needed, not {given!r}")
    if given is not None and method != "paper":
        raise ValueError(f"paper: holds options of method 'paper'; method {method!r} has none of them")
    result = _core.PaperOptions()
    for name, value in vars(given or _LEFT_OUT).items():
        if value is not None:  # of epsilon: the engine's 0 says the same
            setattr(result, name, value)
    result.levels = _arguments.whole("levels", levels, 0, None if method == "paper" else 1)
    return result
