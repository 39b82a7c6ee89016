#include "method/joined.h"

#include <algorithm>
#include <cmath>

#include "base/stopwatch.h"
#include "continuity/curvature_join.h"
#include "geometry/surface_fit.h"
#include "method/accept.h"

namespace fairing {

namespace {

Solution with_join(Solution tangent, Join join) {
    tangent.join = join;
    return tangent;
}

// A curvature that contradicts positions and slopes winds the surface up.
bool varies_wildly(const Problem& problem, const Solution& joined, const Solution& tangent) {
    constexpr double most = 10.0;  // times the largest |H| given or there before
    const double given =
        problem.fixed_curvatures.array().isFinite().select(problem.fixed_curvatures, 0.0).cwiseAbs().maxCoeff();
    const double before = tangent.mean_curvature.cwiseAbs().maxCoeff();
    return !(joined.mean_curvature.cwiseAbs().maxCoeff() <= most * std::max(given, before));
}

enum class Difference { negligible, smooth, rough };

// What the tangent join's curvature lacks at the outline. Where it is rough, it comes from noise in the outline or its
// surroundings, and a surface that followed it would only be wavier: on surfaces with noise of 0.02 edges and more,
// errors grew by a half. Rough is what waves of twelve vertices and more explain less than half of; of white noise they
// explain a sixth.
Difference difference_of(const Problem& problem, const KnownCurvature& known, const Solution& tangent) {
    constexpr double negligible = 0.01;  // root mean square, of the largest |H| on the outline or of 1/D
    constexpr int vertices_per_wave = 12;
    const VectorX missing = known.missing(tangent.mean_curvature.tail(known.values.size()));
    double count = 0.0;
    for (const OutlineCurve& curve : known.curves) count += static_cast<double>(curve.places.size());
    const double scale = std::max(1.0, known.values.cwiseAbs().maxCoeff());
    if (missing.norm() <= negligible * scale * std::sqrt(count)) return Difference::negligible;
    const OutlineModes modes(known.curves, problem.fixed_points, vertices_per_wave);
    const double smooth = modes.combined(modes.projected(missing)).squaredNorm();
    return smooth < 0.5 * missing.squaredNorm() ? Difference::rough : Difference::smooth;
}

Join kind_of(const KnownCurvature& known) { return known.unknown.empty() ? Join::curvature : Join::partly_curvature; }

}  // namespace

Solution joined(const Problem& problem, Solution tangent, const Progress& progress) {
    if (tangent.flaw != Flaw::absent || tangent.even_weights || tangent.instead != Instead::nothing)
        return with_join(std::move(tangent), Join::no_tangent_join);
    if (!tangent.polished) return with_join(std::move(tangent), Join::other_mesh);
    const KnownCurvature known = known_curvature(problem.patch, tangent.points, problem.fixed_curvatures);
    tangent.tangent_only = known.unknown;
    if (known.curves.empty()) return with_join(std::move(tangent), Join::curvature_unknown);
    const Difference difference = difference_of(problem, known, tangent);
    if (difference == Difference::negligible) return with_join(std::move(tangent), kind_of(known));
    if (difference == Difference::rough) return with_join(std::move(tangent), Join::curvature_unknown);
    const Stopwatch watch;
    Solution found = join_curvatures(problem, known, tangent.points, progress);
    const double seconds = watch.seconds();
    tangent.seconds["curvature"] = seconds;
    tangent.ways.push_back({"curvature", seconds});
    if (found.termination != Termination::converged) return with_join(std::move(tangent), Join::not_found);
    found.boundary_normals = one_sided_normals(problem.patch, found.points);
    found.flaw = flaw_of(problem, found);
    if (found.flaw != Flaw::absent || varies_wildly(problem, found, tangent))
        return with_join(std::move(tangent), Join::not_found);
    found.initial_residual = tangent.initial_residual;
    found.levels = tangent.levels;
    found.seconds = tangent.seconds;
    found.ways = tangent.ways;
    found.tangent_only = known.unknown;
    found.join = kind_of(known);
    if (tangent.pins != Pins::absent) found.pins = Pins::curvature_met;
    return found;
}

}  // namespace fairing
