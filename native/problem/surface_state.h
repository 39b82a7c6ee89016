// Positions of a patch with all quantities measured on them.
#pragma once

#include "geometry/mean_curvature.h"
#include "problem/problem.h"

namespace fairing {

struct SurfaceState {
    Points points;
    FaceGeometry faces;
    Stiffness stiffness;
    Points normals;
    PatchCurvature curvature;

    // Faces and stiffness of the present points.
    void measure_faces(const Patch& patch);
    // Fitted (or averaged) normals and the curvature (paper §6) on top of them. The faces are released afterwards.
    void measure_curvature(const Problem& problem);
    // Moves of the first vertices (3 × n): within the surface by `within`, along its curvature for long moves, and by
    // `heights` (n) along the normals.
    [[nodiscard]] Points moves(Points within, const VectorX& heights) const;
};

// Where the first vertices are once they have moved by small `heights` along their normals, and their normals there,
// n − ∇u to first order.
struct Raised {
    Points points;   // 3 × local vertices
    Points normals;  // 3 × heights, unit
};
Raised raised(const Patch& patch, const SurfaceState& state, const VectorX& heights);

// A surface with all of the above measured.
SurfaceState measured_surface(const Problem& problem, const Points& points);

// The Willmore energy of mixed finite elements (problem/willmore), about 4 ∫ H², of a surface (3 × local vertices).
double willmore_energy(const Problem& problem, const Points& points);

// About ∫ |∇H|² + |∇√(H² − K)|²: how much the principal curvatures vary over a surface (3 × local vertices). Zero on
// spheres and round pipes alone; H is constant on bulging pipes too.
double curvature_variation(const Problem& problem, const Points& points);

// Largest length of a column.
double largest_length(const Points& field);

// (S w H)_i at the free vertices, minus 2 M_i (Δ_B w H)_i.
VectorX harmonic_residual(const Problem& problem, const SurfaceState& state);

// r_i of the outer equation at the free vertices: 2 M_i (f − Δ_B H)_i with f = 0, the load, or −2 H (H² − K); 4 M_i H_i
// for minimal surfaces.
VectorX outer_residual(const Problem& problem, const SurfaceState& state);

// Largest |Δ_B H − f| = |r_i| / 2 M_i (eq. 5), or |H| = |r_i| / 4 M_i.
double largest_residual(const Problem& problem, const SurfaceState& state, const VectorX& residual);

}  // namespace fairing
