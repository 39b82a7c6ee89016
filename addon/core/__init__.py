"""Arrays in, arrays out: the patch, its outline, the engine's answer, the report. numpy and `fairing`, no Blender."""
