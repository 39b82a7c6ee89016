"""The quality overlay: what it measures, its shader, its legend."""
