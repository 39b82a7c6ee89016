"""New meshes for surfaces."""
