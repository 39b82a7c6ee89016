#include "placement/folds.h"

#include <Eigen/Geometry>

#include "base/parallel.h"

namespace fairing {

bool is_folded(const Problem& problem, const TargetSurface& target, const Placement& placement, int t) {
    const auto corners = problem.patch.triangles.col(t);
    Vector3 around = Vector3::Zero();
    for (const int v : corners) {
        if (problem.patch.is_free(v)) around += target.face_normal(placement.where[at(v)].triangle);
    }
    const Points& points = placement.points;
    const Vector3 ab = points.col(corners[1]) - points.col(corners[0]);
    const Vector3 ac = points.col(corners[2]) - points.col(corners[0]);
    return ab.cross(ac).dot(around) < 0.0;
}

Indices folded_triangles(const Problem& problem, const TargetSurface& target, const Placement& placement) {
    std::vector<char> folded(at(problem.patch.triangle_count()), 0);
    for_ranges(problem.patch.triangle_count(), coarse_grain, [&](int begin, int end) {
        for (int t = begin; t < end; ++t) folded[at(t)] = is_folded(problem, target, placement, t) ? 1 : 0;
    });
    Indices result;
    for (int t = 0; t < problem.patch.triangle_count(); ++t) {
        if (folded[at(t)]) result.push_back(t);
    }
    return result;
}

}  // namespace fairing
