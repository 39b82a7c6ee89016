"""What keeps up with the mesh while it is edited: the look at the selection, and Live."""
