"""Blender's meshes as arrays, and positions back: all that touches bmesh."""
