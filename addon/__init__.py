"""Intrinsic Fairing: selected faces become the fair surface that continues their surroundings."""

from . import loading

if loading.problem():
    from .loading_panel import register, unregister
else:
    from .fair_mesh import fair_mesh
    from .registration import register, unregister

__all__ = ["fair_mesh", "register", "unregister"]
