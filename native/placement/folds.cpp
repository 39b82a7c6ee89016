#include "placement/folds.h"

#include <Eigen/Geometry>

#include "base/parallel.h"
#include "geometry/area_vector.h"
#include "geometry/flips.h"

namespace fairing {

namespace {

Indices numbers(const std::vector<char>& mask) {
    Indices result;
    for (std::size_t t = 0; t < mask.size(); ++t) {
        if (mask[t]) result.push_back(static_cast<int>(t));
    }
    return result;
}

}  // namespace

bool is_folded(const Problem& problem, const TargetSurface& target, const Placement& placement, int t) {
    const auto corners = problem.patch.triangles.col(t);
    Vector3 around = Vector3::Zero();
    for (const int v : corners) {
        if (problem.patch.is_free(v)) around += target.face_normal(placement.where[v].triangle);
    }
    return area_vector(placement.points, corners).dot(around) < 0.0;
}

std::vector<char> folded_mask(const Problem& problem, const TargetSurface& target, const Placement& placement) {
    std::vector<char> folded(problem.patch.triangle_count(), 0);
    for_ranges(problem.patch.triangle_count(), coarse_grain, [&](int begin, int end) {
        for (int t = begin; t < end; ++t) folded[t] = is_folded(problem, target, placement, t) ? 1 : 0;
    });
    return folded;
}

Indices folded_triangles(const Problem& problem, const TargetSurface& target, const Placement& placement) {
    std::vector<char> folded = folded_mask(problem, target, placement);
    for (const int t : flipped_by_solution(problem.patch, placement.points)) folded[t] = 1;
    return numbers(folded);
}

Indices folds_of_placement(const Problem& problem, const TargetSurface& target, const Placement& placement) {
    std::vector<char> folded = folded_mask(problem, target, placement);
    for (const int t : flipped_by_solution(problem.patch, placement.points)) {
        const bool at_outline = problem.patch.triangles.col(t).maxCoeff() >= problem.patch.free_count;
        if (!at_outline) folded[t] = 1;
    }
    return numbers(folded);
}

}  // namespace fairing
