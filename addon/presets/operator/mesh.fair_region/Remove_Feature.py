import bpy

op = bpy.context.active_operator

op.equation = "AUTOMATIC"
op.inner_fairness = "UNIFORM"
op.boundary_normals = "AUTOMATIC"
op.factor = 1.0
