"""One call for a whole mesh, be it arrays or an object of trimesh, pyvista, meshio or Open3D."""

from fairing.objects.calls import fair_faces, fill_holes, fillet_edges

__all__ = ["fair_faces", "fill_holes", "fillet_edges"]
