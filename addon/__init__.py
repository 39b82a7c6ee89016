"""Intrinsic Fairing: selected faces become the fair surface that continues their surroundings."""

from . import loading

if loading.problem():
    from .loading_panel import register, unregister
else:
    import fairing

    from .core.verdict import NotUsable
    from .registration import register, unregister
    from .run.denoise_mesh import denoise_mesh
    from .run.fair_mesh import fair_mesh
    from .run.fill_mesh import fill_mesh
    from .run.fillet_mesh import fillet_mesh

__all__ = ["NotUsable", "denoise_mesh", "fair_mesh", "fairing", "fill_mesh", "fillet_mesh", "register", "unregister"]
