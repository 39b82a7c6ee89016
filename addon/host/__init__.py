"""Blender around the meshes: its context, events and timers, what operators need, status bar. No engine, no arrays."""
