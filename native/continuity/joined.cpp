#include "continuity/joined.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "accept/accept.h"
#include "base/stopwatch.h"
#include "continuity/curvature_join.h"
#include "geometry/surface_fit.h"

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

// What the tangent join's curvature lacks at the outline, of the largest |H| there or of 1/D.
double relative_size(const KnownCurvature& known, const VectorX& missing) {
    double count = 0.0;
    for (const OutlineCurve& curve : known.curves) count += static_cast<double>(curve.places.size());
    const double scale = std::max(1.0, known.values.cwiseAbs().maxCoeff());
    return missing.norm() / (scale * std::sqrt(count));
}

// Its waves of twelve vertices and more: half as fast as the fastest ones. Of white noise they are a sixth.
VectorX smooth_part(const Problem& problem, const KnownCurvature& known, const VectorX& missing) {
    const OutlineModes modes(known.curves, problem.fixed_points, 2 * fastest_wave);
    return modes.combined(modes.projected(missing));
}

Join kind_of(const KnownCurvature& known) { return known.unknown.empty() ? Join::curvature : Join::partly_curvature; }

// A converged surface with that curvature, without flaws.
std::optional<Solution> acceptable(const Problem& problem, const KnownCurvature& known, const Solution& tangent,
                                   int vertices_per_wave, const Progress& progress) {
    Solution found = join_curvatures(problem, known, tangent.points, vertices_per_wave, progress);
    if (found.termination != Termination::converged) return std::nullopt;
    found.boundary_normals = one_sided_normals(problem.patch, found.points);
    found.flaw = flaw_of(problem, found);
    if (found.flaw != Flaw::absent || varies_wildly(problem, found, tangent)) return std::nullopt;
    return found;
}

// With the fastest waves of H first. On outlines in steps these may not answer to the multipliers, and the iteration
// does not settle: long waves do, and meet what is smooth of H as well.
std::optional<Solution> with_curvature(const Problem& problem, const KnownCurvature& known, const Solution& tangent,
                                       const Progress& progress) {
    // Slower waves where faster ones have no surface.
    constexpr std::array vertices_per_wave{fastest_wave, 2 * fastest_wave, 4 * fastest_wave};
    std::optional<Solution> found;
    for (std::size_t k = 0; k < vertices_per_wave.size() && !found; ++k) {
        const double begin = 1.0 - std::pow(0.5, static_cast<double>(k));
        found = acceptable(problem, known, tangent, vertices_per_wave[k], progress.range(begin, 0.5 * (1.0 + begin)));
    }
    return found;
}

// What holds for the surface that replaces the tangent join.
void inherit(Solution& found, Solution tangent, const KnownCurvature& known) {
    found.initial_residual = tangent.initial_residual;
    found.levels = std::move(tangent.levels);
    found.seconds = std::move(tangent.seconds);
    found.ways = std::move(tangent.ways);
    found.tangent_only = known.unknown;
    found.join = kind_of(known);
    if (tangent.pins != Pins::absent) found.pins = Pins::curvature_met;
}

}  // namespace

Solution joined(const Problem& problem, Solution tangent, const Progress& progress) {
    constexpr double negligible = 0.01;  // root mean square
    if (tangent.flaw != Flaw::absent || tangent.uniform_weights || stands_in(tangent.provenance))
        return with_join(std::move(tangent), Join::no_tangent_join);
    if (!tangent.polished) return with_join(std::move(tangent), Join::other_mesh);
    const KnownCurvature known = known_curvature(problem.patch, tangent.points, problem.fixed_curvatures);
    tangent.tangent_only = known.unknown;
    if (known.curves.empty())
        return with_join(std::move(tangent), known.unknown.empty() ? Join::curvature : Join::curvature_unknown);
    const VectorX missing = known.missing(tangent.mean_curvature.tail(known.values.size()));
    if (relative_size(known, missing) <= negligible) return with_join(std::move(tangent), kind_of(known));
    const VectorX smooth = smooth_part(problem, known, missing);
    tangent.smooth_share = smooth.squaredNorm() / missing.squaredNorm();
    if (tangent.smooth_share < least_smooth_share) {
        const bool is_met = relative_size(known, smooth) <= negligible;
        return with_join(std::move(tangent), is_met ? kind_of(known) : Join::too_rough);
    }
    const Stopwatch watch;
    std::optional<Solution> found = with_curvature(problem, known, tangent, progress);
    const double seconds = watch.seconds();
    tangent.seconds["curvature"] = seconds;
    tangent.ways.push_back({"curvature", seconds});
    if (!found) return with_join(std::move(tangent), Join::not_found);
    inherit(*found, std::move(tangent), known);
    return std::move(*found);
}

}  // namespace fairing
