#include "accept/accept.h"

#include "base/columns.h"
#include "base/parallel.h"
#include "geometry/face_geometry.h"
#include "geometry/flips.h"
#include "geometry/limits.h"
#include "geometry/neighbourhood.h"
#include "geometry/self_intersection.h"
#include "geometry/vertex_normal.h"
#include "mesh/loops.h"
#include "pins/spread_pins.h"
#include "placement/tears.h"
#include "problem/surface_state.h"
#include "shape/limits.h"

namespace fairing {

namespace {

// More than a line has that is as broad as the iteration is accurate, both sides of it covered twice: folds do so.
bool has_area(const Problem& problem, const Points& points) {
    // Looser tolerances than the default are no reason to refuse narrow patches.
    const double least_area = 4.0 * std::min(problem.options.tolerance, SolverOptions{}.tolerance);  // D²
    return total_area(points, problem.patch.triangles) > std::max(least_area, 1e-9);
}

// Met from the other side at most of the boundary's vertices: a bulge that has turned inside out.
bool is_behind(const Problem& problem, const Solution& solution) {
    if (problem.options.equation == Equation::soap_film) return false;
    const VectorX angles = boundary_angles(problem.patch, solution.boundary_normals, problem.fixed_normals);
    return 2 * (angles.array() > turned_back).count() > (angles.array() > 0.0).count();
}

// The triangles without fixed corners: a low-passed boundary lies off the surface.
Indices inside(const Patch& patch, Indices triangles) {
    std::erase_if(triangles, [&](int t) { return patch.triangles.col(t).maxCoeff() >= patch.free_count; });
    return triangles;
}

// Whether flaws of the shape before may stay.
bool keeps_shape(const Problem& problem, const Solution& solution) {
    return solution.provenance == Provenance::old_shape && problem.before->cols() == problem.patch.vertex_count();
}

// Crossings of the triangles inside among each other.
Indices crossings_inside(const Patch& patch, const Points& points) {
    Indices all(patch.triangle_count());
    std::iota(all.begin(), all.end(), 0);
    const Indices kept = inside(patch, std::move(all));
    Indices crossing = crossing_triangles(patch.triangles(Eigen::all, kept), points);
    for (int& t : crossing) t = kept[t];
    return crossing;
}

// That count against a solution. Projected vertices were compared with the surface that they lie on.
Indices flips_of(const Problem& problem, Solution& solution) {
    if (!solution.polished) return {};
    solution.flipped = flipped_triangles(problem.patch, solution.points);
    Indices flipped = with_free_corner(problem.patch, *solution.flipped);
    if (solution.provenance == Provenance::low_passed) flipped = inside(problem.patch, std::move(flipped));
    if (keeps_shape(problem, solution)) flipped = without(flipped, flipped_by_solution(problem.patch, *problem.before));
    return flipped;
}

// Likewise. What the equation's own surface does is no fault of its vertices; what stands in for it has no reason to.
Indices crossings_of(const Problem& problem, Solution& solution) {
    if (solution.crosses && !stands_in(solution.provenance)) return {};
    const Triangles& triangles = problem.patch.triangles;
    if (!solution.crossings) solution.crossings = crossing_triangles(triangles, solution.points);
    // Beside low-passed loops crossings at the boundary are those of its own noise.
    if (solution.provenance == Provenance::low_passed && !solution.crossings->empty())
        return crossings_inside(problem.patch, solution.points);
    if (!keeps_shape(problem, solution)) return *solution.crossings;
    return without(*solution.crossings, crossing_triangles(triangles, *problem.before));
}

// Where the next vertices were tried everywhere beside a low-passed boundary, single triangles have no room: those
// folds are the boundary's own. Of 12 regions that kept any 10 kept less than 1 % of the boundary's vertices, the
// worst 1.8 %.
Indices torn_beside(const Problem& problem, const Solution& solution) {
    constexpr double most_forced = 0.02;  // of the boundary's vertices
    if (solution.provenance != Provenance::low_passed) return {};
    Indices torn = torn_triangles(problem.patch, solution.points);
    const bool forced =
        static_cast<double>(torn.size()) <= most_forced * static_cast<double>(problem.fixed_points.cols());
    return forced ? Indices{} : torn;
}

// Far pins with a radius have spurious surfaces, too: a spike on one ring of triangles, whatever the radius.
bool is_sharp(const Problem& problem, const Solution& solution) {
    return solution.pins == Pins::spread && !sharp_pins(problem.patch, solution.points).empty();
}

// Whether the edges of a mesh are shorter than this everywhere, which their mean tells of even meshes only: pipes and
// catenoids graded by 40 : 1 have 2.7 to 3.1 means at the 99th percentile, regions of scans 1.2 to 2.2.
bool is_finer(const Patch& patch, const Points& points, double edge) {
    constexpr double most_of_even = 2.5;  // times the mean at the 99th percentile
    std::vector<double> lengths;
    lengths.reserve(patch.edge_ends.size());
    for (const auto& [a, b] : patch.edge_ends) lengths.push_back((points.col(a) - points.col(b)).norm());
    const auto high = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() * 99 / 100);
    std::nth_element(lengths.begin(), high, lengths.end());
    const double mean = mean_edge(patch, points);
    return *high < edge || (mean < edge && *high <= most_of_even * mean);
}

struct Difference {
    double distance = 0.0;
    double curvature = 0.0;
};

// The largest ones at the free vertices, between each and the nearest point of the surface.
Difference difference_from(const SolvedSurface& surface, const Solution& own) {
    Difference result;
    for (std::size_t v = 0; v < surface.where.size(); ++v) {
        const int column = static_cast<int>(v);
        const SurfacePoint nearest = surface.target.project(own.points.col(column), surface.where[v].triangle);
        const double distance = (surface.target.position(nearest) - own.points.col(column)).norm();
        const double curvature =
            std::abs(surface.target.interpolate(surface.mean_curvature, nearest) - own.mean_curvature[column]);
        result.distance = std::max(result.distance, distance);
        result.curvature = std::max(result.curvature, curvature);
    }
    return result;
}

}  // namespace

double share_of_poor_triangles(const Patch& patch, const Points& points) {
    const double poor = sum_over_ranges(patch.triangle_count(), coarse_grain, [&](int begin, int end) {
        int count = 0;
        for (int t = begin; t < end; ++t) {
            const auto corners = patch.triangles.col(t);
            if (triangle_shape(points.col(corners[0]), points.col(corners[1]), points.col(corners[2])) < poor_shape)
                ++count;
        }
        return count;
    });
    return poor / patch.triangle_count();
}

bool has_poor_triangles(const Patch& patch, const Points& points) {
    return share_of_poor_triangles(patch, points) > 0.1;
}

Flaw flaw_of(const Problem& problem, Solution& solution) {
    solution.flipped.reset();
    const bool folded_on_proxy = solution.termination == Termination::folded;
    if (solution.termination != Termination::converged && !folded_on_proxy) return Flaw::not_converged;
    if (!has_area(problem, solution.points)) return Flaw::collapsed;
    if (folded_on_proxy) return Flaw::folded;
    if (is_behind(problem, solution)) return Flaw::behind;
    if (Indices flipped = flips_of(problem, solution); flipped.size() > problem.tolerated_folds) {
        solution.bad_triangles = std::move(flipped);
        return Flaw::folded;
    }
    solution.bad_triangles = crossings_of(problem, solution);
    if (!solution.bad_triangles.empty()) return Flaw::crossing;
    solution.bad_triangles = torn_beside(problem, solution);
    if (!solution.bad_triangles.empty()) return Flaw::folded;
    if (is_sharp(problem, solution)) return Flaw::poor_triangles;
    if (!solution.polished || solution.from_surface) return Flaw::absent;
    if (has_poor_triangles(problem.patch, solution.points)) return Flaw::poor_triangles;
    return solution.iterations > nearby.steps ? Flaw::many_iterations : Flaw::absent;
}

Termination end_of(const Solution& solution) {
    if (solution.flaw == Flaw::collapsed) return Termination::stalled;  // folded or not
    if (solution.termination != Termination::converged) return solution.termination;
    switch (solution.flaw) {
        case Flaw::folded:
        case Flaw::crossing: return Termination::folded;
        case Flaw::behind: return Termination::stalled;
        default: return Termination::converged;
    }
}

bool is_final(const Problem& problem, const Solution& solution) {
    if (solution.flaw == Flaw::absent) return true;
    // The mesh carries the equation, but not with the whole load: other meshes wouldn't either.
    return solution.reached_load > 0.0 && !has_poor_triangles(problem.patch, solution.points);
}

bool agree(const Problem& problem, const Solution& own, const SolvedSurface& surface) {
    constexpr double farthest = 2e-4;        // units of D
    constexpr double curvature_share = 0.1;  // of the largest |H|, or of 1/D where that is less
    const Difference found = difference_from(surface, own);
    if (found.distance <= surface.edge && is_finer(problem.patch, own.points, surface.edge)) return true;
    if (found.distance > farthest) return false;
    return found.curvature < curvature_share * std::max(1.0, surface.mean_curvature.cwiseAbs().maxCoeff());
}

}  // namespace fairing
