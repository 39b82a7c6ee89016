// Fans: the corners of triangles that hang together around a vertex, across the edges that are not cut.
#pragma once

#include "mesh/twins.h"

namespace fairing {

// One cut vertex for each fan. Corner 3 t + k is corner k of triangle t.
struct Fans {
    Indices of_corner;
    Indices input_vertex;
};

// Joins the two corners at either end of twins, which may run the same way; so a fan is a chain or closed.
Fans join_corners(const Triangles& triangles, const Twins& twins);

// Triangles that share all three fans with another one: a pocket, which no half-edge mesh can hold.
Indices doubled_triangles(const Triangles& triangles, const EdgeTable& edges, const Fans& fans);

}  // namespace fairing
