// Whether a fillet stays on its side of the shape that it rounds.
#pragma once

#include "fillet/seam_mesh.h"

namespace fairing {

struct FilletPlaces {
    Points before;  // of its vertices on the old surface,
    Points after;   // and on the fillet
};

// Those of the fillet's vertices that lie outside a solid although no concave edge is within two widths, or inside
// although no convex one is, by more than an eighth of the width; and those that are further than it from the solid's
// surface. Triangles are counter-clockwise from outside. `edges`: seams and walls.
Indices on_wrong_side(const Points& points, const Triangles& triangles, const std::vector<VertexPair>& edges,
                      double width, const FilletPlaces& places);

}  // namespace fairing
