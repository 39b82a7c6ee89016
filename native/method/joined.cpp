#include "method/joined.h"

#include "base/stopwatch.h"
#include "continuity/curvature_join.h"
#include "geometry/surface_fit.h"
#include "method/accept.h"

namespace fairing {

namespace {

Solution refused(Solution tangent, Join why) {
    tangent.join = why;
    return tangent;
}

// Where the surface meets the outline with another sign of the curvature than the surroundings it may wind itself up.
bool varies_wildly(const Problem& problem, const Solution& joined, const Solution& tangent) {
    constexpr double most = 10.0;  // times the largest |H| given or there before
    const double given = problem.fixed_curvatures.array().isFinite().select(problem.fixed_curvatures, 0.0).cwiseAbs().maxCoeff();
    const double before = tangent.mean_curvature.cwiseAbs().maxCoeff();
    return !(joined.mean_curvature.cwiseAbs().maxCoeff() <= most * std::max(given, before));
}

}  // namespace

Solution joined(const Problem& problem, Solution tangent, const Progress& progress) {
    if (tangent.flaw != Flaw::absent || tangent.even_weights) return refused(std::move(tangent), Join::no_tangent_join);
    if (!tangent.polished) return refused(std::move(tangent), Join::other_mesh);
    const KnownCurvature known = known_curvature(problem.patch, problem.fixed_curvatures);
    tangent.tangent_only = known.unknown;
    if (known.curves.empty()) return refused(std::move(tangent), Join::curvature_unknown);
    const Stopwatch watch;
    Solution found = join_curvatures(problem, known, tangent.points, progress);
    const double seconds = watch.seconds();
    tangent.seconds["curvature"] = seconds;
    tangent.ways.push_back({"curvature", seconds});
    if (found.termination != Termination::converged) return refused(std::move(tangent), Join::not_found);
    found.boundary_normals = one_sided_normals(problem.patch, found.points);
    found.flaw = flaw_of(problem, found);
    if (found.flaw != Flaw::absent || varies_wildly(problem, found, tangent))
        return refused(std::move(tangent), Join::not_found);
    found.initial_residual = tangent.initial_residual;
    found.levels = tangent.levels;
    found.seconds = tangent.seconds;
    found.ways = tangent.ways;
    found.tangent_only = known.unknown;
    found.join = known.unknown.empty() ? Join::curvature : Join::partly_curvature;
    return found;
}

}  // namespace fairing
