// A noisy boundary, fitted: moved onto the surface that its surroundings suggest.
#pragma once

#include "boundary/surrounding_fit.h"

namespace fairing {

struct FittedBoundary {
    Points vertices;             // those of the input, bit for bit, but for the moved ones
    Indices moved;               // ascending
    Indices held;                // ascending: a move would fold triangles outside
    double noise = 0.0;          // median distance of the points from the fits, in edges
    SurroundingNormals normals;  // at the boundary
};

// Moves each vertex of `boundary` onto the fit of `triangles` (those outside it). The two rings of vertices outside
// move by ⅔ and ⅓ of the distance to their fits. None moves by more than a quarter of its edges' mean length. Nothing
// moves where the noise is less than a fiftieth of an edge: heights there are the fit's error, not the mesh's. Vertices
// whose move would turn a triangle over are held.
FittedBoundary fitted_boundary(const Points& points, const Triangles& triangles, const Indices& boundary);

// Places in the list of vertices, ascending. A vertex is bad if its fit's standard error is above .15 rad and four
// times the median, or if it lies farther from its fit than .3 edges and four times the median. Noise everywhere makes
// none bad. At most 15 % of the boundary are bad: the worst. Vertices without triangles don't count.
Indices bad_vertices(const SurroundingFit& fit);

}  // namespace fairing
