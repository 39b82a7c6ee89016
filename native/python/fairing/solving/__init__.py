"""Patches that are made fair."""
