"""Arrays in, arrays out: the patch, its boundary, the engine's answer, the report. numpy and `fairing`, no Blender."""
