// What a solver is given for one component.
#pragma once

#include "base/shared.h"
#include "fairness/inner_weights.h"
#include "geometry/vertex_normal.h"

namespace fairing {

enum class Equation {
    harmonic,         // Δ_B H = 0 with G1 boundary data
    constant,         // Δ_B H = load
    minimal_energy,   // Δ_B H = −2 H (H² − K): least ∫ κ₁² + κ₂²
    soap_film,        // H = 0 with G0 boundary data
    least_variation,  // least variation of the normal curvatures with G1 boundary data (variation/least_variation.h)
    automatic,        // of a call only: what keeps a tube's girth, harmonic elsewhere (solve_automatically)
};

// What is taken where the equation has no surface that is accepted (method/solve).
enum class Otherwise { least_variation, stop };

struct SolverOptions {
    Equation equation = Equation::harmonic;
    Otherwise otherwise = Otherwise::least_variation;
    double load = 0.0;  // of the constant equation, in units of D⁻³
    NormalKind normals = NormalKind::fitted;
    double tolerance = 1e-6;  // of the largest move in an iteration, in units of D
    int max_iterations = 200;
    bool nested = true;  // large patches begin on coarser levels
};

// How long an iteration goes on before it ends stalled.
struct StepLimits {
    int steps;
    int in_vain;  // steps without progress
};
// From anywhere. What a caller allows (max_iterations) counts where that is less.
inline constexpr StepLimits patient{200, 40};
// From an initial surface made from the boundary, where other strategies come next: those that converged near clusters
// of valence 3 had up to 7 steps in vain.
inline constexpr StepLimits brisk{60, 12};
// From a surface nearby, which takes 3 to 8 steps. On graded meshes the discrete equation may have solutions that are
// none of the surface's: 1e-3 D off a sphere after 100 steps, 2e-3 D off a cylinder after 29.
inline constexpr StepLimits nearby{20, 6};

// Free vertices from which on a patch is large: coarser levels pay, and the proxy mesh resolves it best.
inline constexpr int smallest_large = 1500;
// Free vertices of the coarsest level of a large one, which has the surface from its boundary alone wherever there is
// one; up to so many all patience pays.
inline constexpr int coarsest_size = 600;
// Tolerance of a surface that another solve begins with, units of D.
inline constexpr double start_tolerance = 1e-4;

// How a strategy has the equation iterated; no caller sets it.
struct Conduct {
    StepLimits limits = patient;
    bool contracts = false;    // ends stalled where the steps shrink slower than near a surface
    int nears_within = 0;      // steps after which it ends stalled where it stays far from a surface; 0: never
    bool begins_near = false;  // the start is a coarser level's surface: few steps are left, each worth more work
    bool start_only = false;   // the surface is a start for another one: the last step is taken and not measured
};

// One component in units of D: translated and scaled so that D = 1.
struct Problem {
    const Patch& patch;
    Points fixed_points;   // 3 × fixed count
    Points fixed_normals;  // 3 × fixed count, unit; ignored at pins
    Shared<Lambda> weights;
    SolverOptions options;
    std::size_t tolerated_folds = 0;  // as many triangles are turned over where the weights come from
    // For least_variation: the boundary's normals cost Σ w_i |n_i − n̂_i|²; fixed count. ∞: met exactly, 0: the slope is
    // free. Empty: ∞. Pins count as 0.
    VectorX normal_weights = {};
    // Fixed vertices on an edge that is free to rise along its normals, for least variation. Empty: none is.
    std::vector<char> free_edge = {};
    // H at the fixed vertices, in units of D⁻¹, NaN where it is not known, infinite where a tangent join is asked for;
    // for Δ_B² H = 0. Empty: a tangent join.
    VectorX fixed_curvatures = {};
    // The shape before (3 × local vertices), taken where no surface is found (stand_in/stand_in). Empty: none.
    Deferred<Points> before = {};
    Conduct conduct = {};
};

}  // namespace fairing
