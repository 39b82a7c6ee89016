"""Fair Region and what fairs in sculpt mode: from selected faces to the engine's answer, operator and script."""
