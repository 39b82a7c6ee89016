"""Blender's meshes as arrays, and positions back: the only room that touches bmesh."""
