#include "placement/disc_placement.h"

#include <cmath>
#include <numbers>

#include "placement/first_placement.h"
#include "tangential/tangential_step.h"

namespace fairing {

namespace {

// V − E + F = 1 with the whole outline as its only fixed vertices.
bool is_disc(const Patch& patch) {
    const std::vector<Indices> loops = patch.loops();
    const int fixed = patch.vertex_count() - patch.free_count;
    return loops.size() == 1 && static_cast<int>(loops.front().size()) == fixed &&
           patch.vertex_count() - patch.edge_count() + patch.triangle_count() == 1;
}

// The outline on the unit circle, as far apart as its vertices are: 3 × fixed count, z = 0.
Points on_circle(const Problem& problem) {
    const Patch& patch = problem.patch;
    const Indices loop = patch.loops().front();
    const auto place = [&](std::size_t k) {
        return problem.fixed_points.col(loop[k % loop.size()] - patch.free_count);
    };
    VectorX reached(static_cast<Eigen::Index>(loop.size()) + 1);
    reached[0] = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const auto column = static_cast<Eigen::Index>(k);
        reached[column + 1] = reached[column] + (place(k + 1) - place(k)).norm();
    }
    Points circle = Points::Zero(3, problem.fixed_points.cols());
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const double angle =
            2.0 * std::numbers::pi * reached[static_cast<Eigen::Index>(k)] / reached[reached.size() - 1];
        circle.col(loop[k] - patch.free_count) << std::cos(angle), std::sin(angle), 0.0;
    }
    return circle;
}

Points upright(Eigen::Index count) { return Vector3(0.0, 0.0, 1.0).replicate(1, count); }

Points laid_out(const Patch& patch, const Points& circle) {
    Points result(3, patch.vertex_count());
    result << make_tangential_step(patch, uniform_weights(patch), circle, {})->harmonic_positions(), circle;
    return result;
}

}  // namespace

std::optional<Placement> by_disc(const Problem& problem, const Patch& proxy, const TargetSurface& target) {
    if (!is_disc(problem.patch) || !is_disc(proxy)) return std::nullopt;
    const Points circle = on_circle(problem);
    const Points surface = laid_out(proxy, circle);
    const Points normals = upright(surface.cols());
    const TargetSurface disc(proxy, surface, normals);
    const Problem flat{problem.patch, circle, upright(circle.cols()), uniform_weights(problem.patch), problem.options};
    return placed_at(problem, target, by_surface(flat, laid_out(problem.patch, circle), proxy, disc).where);
}

}  // namespace fairing
