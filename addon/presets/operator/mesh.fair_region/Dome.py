import bpy

op = bpy.context.active_operator

op.bulge = 0.5
op.equation = "CONSTANT"
op.boundary_normals = "AUTOMATIC"
op.factor = 1.0
