#include "method/first_surface.h"

#include "method/levels.h"
#include "method/traits.h"
#include "start/quick_surface.h"
#include "start/several_outlines.h"

namespace fairing {

namespace {

// Free vertices of the level that the surface is made on, and up to which none is made. Between several loops coarse
// levels lose the shape before: limbs of a few hundred vertices turn over on them.
struct Fineness {
    int level;
    int largest_direct;
};
constexpr Fineness usual{coarsest_size, 900};  // one loop
constexpr Fineness with_limbs{1500, 2500};     // several

Problem with_shape_before(const Problem& level, const Points& before) {
    Problem result = level;
    if (before.cols() > 0) result.before = Points(before(Eigen::all, level.patch.to_input));
    return result;
}

std::optional<Points> by_levels(const Problem& given, int size, const Progress& progress) {
    Problem problem = given;
    problem.weights = uniform_weights(given.patch);
    const Traits traits(problem);
    const Levels levels = levels_of(problem, traits, size);
    std::size_t k = levels.coarsest();
    if (k == 0) return std::nullopt;
    auto points = quick_surface(with_shape_before(levels.problem(k), *problem.before), progress);
    while (points && k-- > 0) points = levels.interpolated(k, *points, levels.laplacian(k)).points;
    return points;
}

Points as_before(const Problem& problem) {
    const Patch& patch = problem.patch;
    Points points = with_fixed(patch, problem.fixed_points);
    if (problem.before->cols() == points.cols())
        points.leftCols(patch.free_count) = problem.before->leftCols(patch.free_count);
    return points;
}

}  // namespace

Points first_surface(const Problem& problem, const Progress& progress) {
    std::optional<Points> points;
    const Fineness fineness = joins_outlines(problem) ? with_limbs : usual;
    if (problem.patch.free_count > fineness.largest_direct) points = by_levels(problem, fineness.level, progress);
    if (!points) points = quick_surface(problem, progress);
    return points && points->allFinite() ? *points : as_before(problem);
}

}  // namespace fairing
