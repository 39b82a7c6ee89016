// Boundary vertices whose surroundings say little about the surface.
#pragma once

#include "boundary/surrounding_fit.h"

namespace fairing {

// Places in the list of vertices, ascending. A vertex is bad if its fit's standard error is above .15 rad and four
// times the median, or if it lies farther from its fit than .3 edges and four times the median. Noise everywhere makes
// none bad. Where more than 15 % of the boundary is bad, the worst of it. Vertices without triangles don't count.
Indices bad_vertices(const SurroundingFit& fit);

}  // namespace fairing
