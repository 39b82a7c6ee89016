// Positions of a patch with all quantities measured on them.
#pragma once

#include "geometry/face_geometry.h"
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

// The Willmore energy of mixed finite elements (problem/surface_state), about 4 ∫ H², of a surface (3 × local
// vertices).
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

// c_i = Σ over the two border edges e at i of (e × n_i)/3 + (e × n_other)/6, e in the direction of its triangle, so
// that e × n points out of the patch. 3 × fixed count; zero at pins. `fixed_points`, `normals`: 3 × fixed count.
Points conormals(const Patch& patch, const Points& fixed_points, const Points& normals);

// h_i = −½ (S x)_i + c_i at all vertices: 2 M H n ≈ h, the boundary's tangent planes included.
Points mixed_curvature_vectors(const Patch& patch, const Stiffness& stiffness, const Points& points,
                               const Points& conormals);

// H_i = ⟨h_i, n_i⟩ / 2 M_i.
VectorX mixed_mean_curvature(const Points& curvature_vectors, const Stiffness& stiffness, const Points& normals);

// E = Σ |h_i|² / M_i, about 4 ∫ H² (8 π on a hemisphere).
double willmore_energy(const Points& curvature_vectors, const Stiffness& stiffness);

// ∂E/∂x_i at the free vertices (3 × free count), exact.
Points willmore_gradient(const Patch& patch, const Stiffness& stiffness, const Points& points,
                         const Points& curvature_vectors);

}  // namespace fairing
