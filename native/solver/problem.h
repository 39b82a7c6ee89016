// What a solver is given for one component, and what it gives back.
#pragma once

#include <map>
#include <string>

#include "base/progress.h"
#include "fairness/row_weights.h"
#include "geometry/vertex_normal.h"

namespace fairing {

enum class Equation {
    harmonic,         // Δ_B H = 0 with G1 boundary data
    constant,         // Δ_B H = load
    minimal_energy,   // Δ_B H = −2 H (H² − K): least ∫ κ₁² + κ₂²
    minimal,          // H = 0 with G0 boundary data
    least_variation,  // least variation of the normal curvatures with G1 boundary data (variation/least_variation.h)
};

enum class Termination { converged, iteration_limit, stalled };

struct SolverOptions {
    Equation equation = Equation::harmonic;
    double load = 0.0;  // of the constant equation, in units of D⁻³
    NormalKind normals = NormalKind::fitted;
    double tolerance = 1e-6;  // of the largest move in an iteration, in units of D
    int max_iterations = 200;
    bool nested = true;  // large patches begin on coarser levels
    int patience = 40;   // iterations without progress after which the solve is given up
};

// One component in units of D: translated and scaled so that D = 1.
struct Problem {
    const Patch& patch;
    Points fixed_points;   // 3 × fixed count
    Points fixed_normals;  // 3 × fixed count, unit; ignored at pins
    Lambda weights;
    SolverOptions options;
    // Of least_variation: the outline's normals cost Σ w_i |n_i − n̂_i|²; fixed count. ∞: met exactly, 0: the slope is
    // free. Empty: ∞. Pins count as 0.
    VectorX normal_weights = {};
};

struct Solution {
    Points points;  // 3 × local vertices
    VectorX mean_curvature;
    Points boundary_normals;  // of the surface at the fixed vertices, fitted to the side of the patch; 3 × fixed count
    Termination termination = Termination::stalled;
    bool polished = true;  // the equation holds on the patch's own connectivity
    int iterations = 0;
    double residual = 0.0;          // largest |Δ_B H| (|H| for minimal) at free vertices
    double initial_residual = 0.0;  // of the fill
    double reached_load = 0.0;      // share of the load for which `points` solve the equation, where not the whole
    std::vector<int> levels;        // vertex counts, coarse to fine; empty: only the patch itself
    std::map<std::string, double> seconds;
};

}  // namespace fairing
