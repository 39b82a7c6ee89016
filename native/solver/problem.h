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

// `folded`: the surface was found, the vertices don't lie on it without folds.
enum class Termination { converged, iteration_limit, stalled, folded };

// What is wrong with a solution, from the least to the worst (method/accept).
enum class Flaw {
    absent,
    many_iterations,  // converged, but so slowly that it may be another solution than the surface's
    poor_triangles,   // converged on triangles that can't carry the equation
    crossing,         // triangles pass through each other, and the surface does not
    folded,           // triangles are turned over
    behind,           // most of the outline is met from the other side
    collapsed,        // no area is left
    not_converged,
};

// How a surface meets its outline. The last four: tangent, although a curvature was asked for.
enum class Join {
    tangent,            // nothing else was asked for
    curvature,          // with the curvature prescribed
    partly_curvature,   // not where it isn't known
    curvature_unknown,  // nearly nowhere is it known
    no_tangent_join,    // the tangent join, from which it begins, was not found either
    other_mesh,         // the tangent join was solved on a mesh of the engine's own only
    not_found,          // no surface, or none that is accepted
};

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
    std::size_t tolerated_folds = 0;  // as many triangles are turned over where the weights come from
    // Of least_variation: the outline's normals cost Σ w_i |n_i − n̂_i|²; fixed count. ∞: met exactly, 0: the slope is
    // free. Empty: ∞. Pins count as 0.
    VectorX normal_weights = {};
    // H at the fixed vertices, in units of D⁻¹, NaN where it is not known; for Δ_B² H = 0. Empty: a tangent join.
    VectorX fixed_curvatures = {};
};

// A way that was tried (method/ways), and how long it took.
struct WayTaken {
    std::string name;
    double seconds;
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
    std::vector<WayTaken> ways;
    Flaw flaw = Flaw::absent;
    Indices bad_triangles;      // of the patch: folded or crossing ones, for those flaws
    bool from_surface = false;  // its iteration began on the solved surface of a proxy
    bool crosses = false;       // the surface passes through itself, whatever the mesh
    double first_step = 0.0;    // largest moves of the first and the last iteration, units of D
    double last_step = 0.0;
    bool even_weights = false;  // uniform weights were taken instead of the problem's
    Join join = Join::tangent;
    Indices tangent_only;  // of partly_curvature: fixed vertices, counted from the first one
};

}  // namespace fairing
