import bpy

op = bpy.context.active_operator

op.inner_fairness = "CONFORMAL"
op.equation = "AUTOMATIC"
op.factor = 1.0
op.boundary_normals = "AUTOMATIC"
