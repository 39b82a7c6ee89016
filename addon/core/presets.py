"""What people do with the operators: every preset sets every option. Plain Python, no bpy."""

from __future__ import annotations

from typing import Any

from .fair_options import FAIR
from .fill_options import FILL
from .option_table import Table, defaults

Presets = dict[str, dict[str, Any]]  # what differs from the defaults, by the name of the preset

OF_FAIR: Presets = {
    "Remove Feature": {},
    "Repair Scan": {"detail": 1.0, "falloff": 0.15},
    "Limb or Tube": {"shape": "LEAST_VARIATION"},
    "Class A": {"shape": "HARMONIC", "continuity": "G2"},
    "Fillet": {"pin_edges": "NONE", "inner_fairness": "UNIFORM"},
    "Soften": {"factor": 0.5, "boundary_normals": "AVERAGE", "inner_fairness": "INVERSE_DISTANCE"},
}
OF_FILL: Presets = {
    "Fill Holes": {},
    "Small Holes Only": {"longest": 30},
    "Flat Lid": {"continuity": "G0", "run_on": False},
    "Bridge": {"bridge": True},
    "Class A": {"shape": "HARMONIC", "continuity": "G2"},
}
PRESETS: dict[str, tuple[Table, Presets]] = {"mesh.fair_region": (FAIR, OF_FAIR), "mesh.fair_fill": (FILL, OF_FILL)}


def preset(operator: str, name: str) -> dict[str, Any]:
    """Return the options of a preset, all of them."""
    table, presets = PRESETS[operator]
    return {**defaults(table), **presets[name]}
