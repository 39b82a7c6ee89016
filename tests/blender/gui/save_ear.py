"""Saves Suzanne with a vertex group "Ear", for the command line."""

import os
from pathlib import Path

import bpy

for obj in list(bpy.data.objects):
    bpy.data.objects.remove(obj)
bpy.ops.mesh.primitive_monkey_add()
monkey = bpy.context.object
monkey.modifiers.new("Subdivision", "SUBSURF").levels = 2
bpy.ops.object.modifier_apply(modifier="Subdivision")
ear = [v for p in monkey.data.polygons if p.center.x > 0.76 for v in p.vertices]
monkey.vertex_groups.new(name="Ear").add(sorted(set(ear)), 1.0, "REPLACE")
bpy.ops.wm.save_as_mainfile(filepath=str(Path(os.environ["FAIRING_GUI_OUT"]) / "ear.blend"))
