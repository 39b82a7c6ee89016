"""Intrinsic Fairing: selected faces become the fair surface that continues their surroundings."""

from . import loading

if loading.problem():
    from .loading_panel import register, unregister
else:
    import fairing

    from .denoise.script import denoise_mesh
    from .fair.script import fair_mesh
    from .fill.script import fill_mesh
    from .fillet.script import fillet_mesh
    from .registration import register, unregister
    from .verdict.verdict import NotUsable

__all__ = ["NotUsable", "denoise_mesh", "fair_mesh", "fairing", "fill_mesh", "fillet_mesh", "register", "unregister"]
