// What a solver gives back for one component.
#pragma once

#include <map>

#include "base/types.h"
#include "problem/problem.h"

namespace fairing {

// `folded`: the surface was found, the vertices don't lie on it without folds.
enum class Termination { converged, iteration_limit, stalled, folded };

// What is wrong with a solution, from the least to the worst (accept/accept).
enum class Flaw {
    absent,
    many_iterations,  // converged, but so slowly that it may be another solution than the surface's
    poor_triangles,   // converged on triangles that can't carry the equation
    crossing,         // triangles pass through each other, and the surface does not
    folded,           // triangles are turned over
    behind,           // most of the boundary is met from the other side
    collapsed,        // no area is left
    not_converged,
};

// How a surface meets its boundary. The last four: tangent, although a curvature was asked for.
enum class Join {
    tangent,            // nothing else was asked for
    curvature,          // with the curvature prescribed
    partly_curvature,   // not where it isn't known
    curvature_unknown,  // nearly nowhere is it known
    too_rough,          // what the tangent join's curvature lacks looks like noise
    no_tangent_join,    // the tangent join, from which it begins, was not found either
    other_mesh,         // the tangent join was solved on a mesh of the engine's own only
    not_found,          // no surface, or none that is accepted
};

// Whether pins have a radius (method/direct). The last five: not, although it was asked for.
enum class Pins { absent, spread, no_surface, no_boundary, too_close, not_found, curvature_met };

// Where a surface comes from. Whoever makes a surface sets it, and nothing changes it afterwards. All but the first two
// stand in for a surface that the problem's equation does not have (method/solve).
enum class Provenance {
    equation,         // the problem's equation, between the boundary loops as they are
    low_passed,       // the same between loops without their short waves, beside which the real ones lie
                      // (method/proxy_surface)
    least_variation,  // the surface of least variation, where another equation was asked for
    loft,
    least_bent,     // where the descent of the bending energy ended (start/globalisation)
    swept_tube,     // cross-sections swept along a bend (start/swept_start)
    old_shape,      // the shape before, as smooth as it can be (stand_in/stand_in)
    first_surface,  // what every run can begin with (method/nested)
};

// Whether another surface than the equation's was taken.
constexpr bool stands_in(Provenance provenance) { return provenance > Provenance::low_passed; }

// Whether the loops are joined without an equation (stand_in/stand_in).
constexpr bool is_loft(Provenance provenance) {
    return provenance == Provenance::loft || provenance == Provenance::least_bent ||
           provenance == Provenance::swept_tube;
}

// A strategy that was tried (method/solve), and how long it took.
struct StrategyTried {
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
    double residual = 0.0;          // largest |Δ_B H| (|H| for soap films) at free vertices
    double initial_residual = 0.0;  // of the fill
    double reached_load = 0.0;      // share of the load for which `points` solve the equation, where not the whole
    std::vector<int> levels;        // vertex counts, coarse to fine; empty: only the patch itself
    std::map<std::string, double> seconds;
    std::vector<StrategyTried> strategies;  // a log for people: no code decides by it
    Flaw flaw = Flaw::absent;
    Indices bad_triangles;             // of the patch: folded or crossing ones, for those flaws
    std::optional<Indices> crossings;  // triangles of the patch that pass through others, where they were looked for
    std::optional<Indices> flipped;    // likewise: turned over
    bool from_surface = false;         // its iteration began on the solved surface of a proxy
    bool crosses = false;              // the surface passes through itself, whatever the mesh
    double first_step = 0.0;           // largest moves of the first and the last iteration, units of D
    double last_step = 0.0;
    double least_step = 0.0;  // of all iterations
    Provenance provenance = Provenance::equation;
    bool uniform_weights = false;  // uniform weights were taken instead of the problem's
    Join join = Join::tangent;
    Pins pins = Pins::absent;
    Indices tangent_only;       // of partly_curvature: fixed vertices, counted from the first one
    double smooth_share = 0.0;  // of too_rough: how much of what is lacking long waves explain, 0 … 1
};

// Steps from which on a surface is near, units of D. Fine proxies were found from coarse ones that ended with 2e-5 to
// 3e-4.
inline constexpr double near_step = 2e-3;

// Whether no step of an iteration was short, nor half the first one.
inline bool stays_far(const Solution& solution) {
    return solution.least_step > near_step && solution.least_step > 0.5 * solution.first_step;
}

// The surface at `points` (3 × local vertices) as a converged solution with its boundary normals; not judged (`flaw`
// stays absent), and its mean curvature is left open.
Solution solution_at(const Problem& problem, const Points& points, Provenance provenance);

}  // namespace fairing
