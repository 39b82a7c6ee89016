"""What people do with the operators: options that differ from the defaults. Plain Python, no bpy."""

from __future__ import annotations

from typing import Any

from .options import FairOptions
from .other_options import FillOptions
from .table import Chosen

Presets = dict[str, dict[str, Any]]  # options by the name of the preset

PRESETS: dict[str, tuple[type[Chosen], Presets]] = {
    "mesh.fair_region": (
        FairOptions,
        {
            "Remove Feature": {},
            "Repair Scan": {"detail": 1.0, "falloff": 0.15},
            "Limb or Tube": {"shape": "LEAST_VARIATION"},
            "Class A": {"shape": "HARMONIC", "continuity": "G2"},
            "Fillet": {"pin_edges": "NONE", "inner_fairness": "UNIFORM"},
            "Soften": {"factor": 0.5, "boundary_normals": "AVERAGE", "inner_fairness": "INVERSE_DISTANCE"},
        },
    ),
    "mesh.fair_fill": (
        FillOptions,
        {
            "Fill Holes": {},
            "Small Holes Only": {"longest": 30},
            "Flat Lid": {"continuity": "G0", "run_on": False},
            "Bridge": {"bridge": True},
            "Class A": {"shape": "HARMONIC", "continuity": "G2"},
        },
    ),
}
