import bpy

op = bpy.context.active_operator

op.shape = "AUTOMATIC"
op.continuity = "G1"
op.bridge = False
op.run_on = True
op.spacing = 1.0
op.quads = False
op.equal_edges = False
op.subdivide_boundary = False
op.max_vertices = 0
op.limit_total = 0
op.islands = False
op.longest = 30
op.longest_length = 0.0
op.allow_folds = False
