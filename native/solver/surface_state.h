// Positions of a patch with everything that is measured on them.
#pragma once

#include "solver/problem.h"

namespace fairing {

struct SurfaceState {
    Points points;
    FaceGeometry faces;
    Stiffness stiffness;
    Points normals;
    VectorX mean_curvature;

    // Faces and stiffness of the present points.
    void measure_faces(const Patch& patch);
    // Fitted (or averaged) normals and the curvature of METHOD §6 on top of them.
    void measure_curvature(const Problem& problem);
};

// Largest length of a column.
double largest_length(const Points& field);

// r_i of the outer equation at the free vertices: (S H)_i, or 4 M_i H_i for minimal surfaces.
VectorX outer_residual(const Problem& problem, const SurfaceState& state);

// Largest |Δ_B H_i| = |r_i| / 2 M_i (eq. 5), or |H_i| = |r_i| / 4 M_i.
double largest_residual(const Problem& problem, const SurfaceState& state, const VectorX& residual);

}  // namespace fairing
