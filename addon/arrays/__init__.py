"""Meshes as arrays: patches, boundary loops, triangles of polygons. numpy and `fairing`, nothing of Blender."""
