// Surfaces that sink below the lines that run on across them: a ridge, a bevel or a handle that loses its girth.
#pragma once

#include "mesh/patch.h"

namespace fairing {

struct Sunken {
    double depth = 0.0;  // below the lines, of their length, in the median; not above 0 where it lies above them
    Indices deepest;     // vertices where it is as deep as that or deeper
};

// Lines run over the patch from vertex to vertex of its boundary, as cubics that leave both along the tangent planes
// there: only those that go straight on. `normals`: of the surroundings, at the fixed vertices. Of a surface (3 × local
// vertices); nothing where the patch is no disc, has pins, or hardly any such line.
Sunken sunken_of(const Patch& patch, const Points& points, const Points& normals);

}  // namespace fairing
