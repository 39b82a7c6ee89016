#include "method/lofted.h"

#include "base/stopwatch.h"
#include "geometry/surface_fit.h"
#include "method/accept.h"
#include "problem/surface_state.h"
#include "start/loft.h"

namespace fairing {

namespace {

constexpr double largest_growth = 2.0;  // of the area, by the bulge: beyond, it is a balloon or a horn

double area_of(const Patch& patch, const Points& points) {
    FaceGeometry faces;
    faces.update(points, patch.triangles);
    return faces.areas.sum();
}

Solution solution_at(const Problem& problem, const Points& points) {
    Solution solution;
    solution.points = points;
    solution.termination = Termination::converged;
    solution.mean_curvature = measured_surface(problem, points).curvature.mean;
    solution.boundary_normals = one_sided_normals(problem.patch, points);
    solution.iterations = 1;
    solution.instead = Instead::loft;
    solution.flaw = flaw_of(problem, solution);
    return solution;
}

// The free vertices of a share of the bulge; nothing where it is no answer.
std::optional<Solution> accepted(const Problem& problem, const Fill& fill, double share) {
    Points points(3, problem.patch.vertex_count());
    points.rightCols(problem.fixed_points.cols()) = problem.fixed_points;
    points.leftCols(problem.patch.free_count) = fill.flat;
    const double least_area = area_of(problem.patch, points);
    points.leftCols(problem.patch.free_count) += share * fill.bulge;
    if (area_of(problem.patch, points) > largest_growth * least_area) return std::nullopt;
    Solution solution = solution_at(problem, points);
    if (end_of(solution) != Termination::converged) return std::nullopt;
    return solution;
}

// The most bulge that is accepted, the least waist first.
std::optional<Solution> best_of(const Problem& problem, const Progress& progress) {
    std::vector<Fill> fills;
    for (const double roundness : {0.6, 1.5}) {
        if (auto fill = loft(problem, roundness, progress)) fills.push_back(std::move(*fill));
    }
    for (const double share : {1.0, 0.75, 0.5, 0.25, 0.0}) {
        for (const Fill& fill : fills) {
            if (auto solution = accepted(problem, fill, share)) return solution;
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<Solution> lofted(const Problem& problem, const Solution& first, const Progress& progress) {
    const Stopwatch watch;
    auto solution = best_of(problem, progress);
    if (!solution) return std::nullopt;
    solution->ways = first.ways;
    solution->ways.push_back({"loft", watch.seconds()});
    return solution;
}

}  // namespace fairing
