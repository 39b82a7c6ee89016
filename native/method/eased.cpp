#include "method/eased.h"

#include "method/on_coarse_proxy.h"
#include "method/on_proxy.h"
#include "method/sizes.h"
#include "outline/eased_outline.h"
#include "placement/follow_outline.h"
#include "placement/untear.h"
#include "problem/surface_state.h"

namespace fairing {

namespace {

constexpr double wave = 16.0;  // vertices; 8 left regions of an ear and a cheek with turned triangles, 32 moved more

OutlineData outline_of(const Problem& problem) { return {problem.fixed_points, problem.fixed_normals}; }

double variation_along(const Problem& problem) { return outline_variation(problem.patch, outline_of(problem)); }

}  // namespace

bool is_jagged(const Problem& problem) {
    // Least variation was found over outlines of pipes up to 6e3 and never from 4e4 on. Regions of scans with noise of
    // a quarter edge have 4e6 to 2e9.
    constexpr double most = 3e4;
    return variation_along(problem) > most;
}

bool is_beyond_reach(const Problem& problem) {
    // Of some 60 regions of scans with 10,000 to 100,000 vertices and noise of up to a quarter of an edge such surfaces
    // met outlines of up to 1.7e9; the 14 above, up to 2.5e10, had none. A rim of 2,048 edges around half a sphere was
    // met at 8e9.
    constexpr double most = 1e10;
    return variation_along(problem) > most;
}

double roughness_left(const Problem& problem) { return variation_along(eased(problem)) / variation_along(problem); }

Problem eased(const Problem& problem) {
    const OutlineData outline = eased_outline(problem.patch, outline_of(problem), wave);
    Problem result = problem;
    result.fixed_points = outline.points;
    result.fixed_normals = outline.normals;
    return result;
}

std::optional<Solution> solve_eased(const Problem& problem, const std::shared_ptr<const ProxyStart>& start,
                                    const Progress& progress) {
    const Problem smooth = eased(problem);
    auto solution =
        is_large(problem) ? place_on_coarse_proxy(smooth, start, progress) : place_on_proxy(smooth, progress);
    if (!solution) return std::nullopt;
    follow_outline(problem.patch, problem.fixed_points - smooth.fixed_points, solution->points);
    solution->points = untorn(problem.patch, std::move(solution->points));
    solution->provenance = Provenance::low_passed;
    return solution;
}

double eased_by(const Problem& problem) { return largest_length(problem.fixed_points - eased(problem).fixed_points); }

}  // namespace fairing
