"""One call for a whole mesh, be it arrays or an object of trimesh, pyvista, meshio or Open3D."""
