"""Mirror modifiers and X mirror: what ends at a plane is solved with its image, and the half is kept."""
