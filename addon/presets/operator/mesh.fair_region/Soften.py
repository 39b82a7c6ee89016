import bpy

op = bpy.context.active_operator

op.factor = 0.5
op.boundary_normals = "AVERAGE"
op.inner_fairness = "INVERSE_DISTANCE"
op.equation = "AUTOMATIC"
