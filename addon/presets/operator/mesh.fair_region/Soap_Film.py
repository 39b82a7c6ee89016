import bpy

op = bpy.context.active_operator

op.equation = "MINIMAL"
op.factor = 1.0
