// Triangles paired into quads.
#pragma once

#include "base/types.h"

namespace fairing {

struct PairedQuads {
    Eigen::Matrix4Xi quads;  // vertices, wound like the triangles
    std::vector<std::array<int, 2>>
        pairs;     // the triangles of each quad: corner 0 is of the first alone, 2 of the second
    Indices rest;  // triangles without a partner, ascending
};

// Pairs of best shape first, then as many more as augmenting paths find; each triangle is used once. A pair is convex
// and bent by less than 40° along its diagonal. No edge of `kept` (ends, in either order) becomes a diagonal, nor does
// a border edge, or one that is non-manifold or inconsistently wound. Angles alone decide: scale doesn't matter.
// Preconditions: those of make_edges; finite points.
PairedQuads paired_quads(const Points& points, const Triangles& triangles, const std::vector<std::array<int, 2>>& kept);

}  // namespace fairing
