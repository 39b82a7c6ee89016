"""Surfaces over holes and wires."""
