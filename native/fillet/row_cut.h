// A mesh cut along the border of a fillet's quads.
#pragma once

#include "fillet/cut_mesh.h"
#include "fillet/row_mesh.h"

namespace fairing {

// Throws NoRows unless the quads have the border of the pieces within the fillet, but for the dropped points.
void check_border(const SplitMesh& cut, const Indices& dropped, const std::vector<Quad>& quads);

// Takes points out of the line: the pieces outside close up to a point beside each. `vertices`: of the mesh and the
// cut. Throws NoRows where one would turn over.
void drop_points(const Points& vertices, const Indices& dropped, SplitMesh& cut);

// Degrees: the widest angle of a quad; above 180 where it is not convex.
double widest_angle(const Quad& quad, const Points& vertices);

}  // namespace fairing
