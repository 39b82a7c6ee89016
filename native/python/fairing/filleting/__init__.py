"""Edges that are rounded or made fair."""
