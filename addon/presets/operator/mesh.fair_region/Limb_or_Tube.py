import bpy

op = bpy.context.active_operator

op.factor = 1.0
op.shape = "LEAST_VARIATION"
op.bulge = 0.0
op.continuity = "G1"
op.boundary_normals = "AUTOMATIC"
op.remesh = False
op.inner_fairness = "AUTOMATIC"
op.spacing = 1.0
op.quads = False
op.equal_edges = False
op.subdivide_boundary = False
op.max_vertices = 0
op.limit_total = 0
op.detail = 0.0
op.detail_size = 0.0
op.falloff = 0.0
op.smooth_boundary = False
op.vertex_group = ""
op.use_mask = False
op.all_keys = False
op.detail_from = ""
op.detail_face_set = 0
op.pin_group = ""
op.pin_radius = 0.1
op.pin_edges = "AUTOMATIC"
op.fair_pinned_edges = True
op.pin_slope = "AUTOMATIC"
op.fair_open_borders = False
op.fallback = True
op.multigrid = False
op.levels = 0
op.tolerance = 1e-06
op.max_iterations = 200
op.allow_folds = False
