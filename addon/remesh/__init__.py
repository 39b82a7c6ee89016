"""A patch on a new mesh: its faces, UVs, shape keys, and where their values come from."""
