#include "paper/vertex_update.h"

#include <algorithm>
#include <cmath>

namespace fairing {

namespace {

double mean_spoke(const Disk& disk, const Points& points, const Vector3& centre) {
    double sum = 0.0;
    for (int v : disk.neighbours) sum += (points.col(v) - centre).norm();
    return sum / static_cast<double>(disk.valence());
}

}  // namespace

Vector3 updated_position(const Disk& disk, const Points& points, const Vector3& normal, const VertexTarget& target,
                         DiskCurvature& curvature) {
    const Vector3 present = points.col(disk.centre);
    const Vector3 start = target.mean - normal.dot(target.mean - present) * normal;
    const CurvatureLine line = curvature(disk, start, normal, target.completed);
    const double slope = line.slope.mean();
    if (!(std::abs(slope) > 0.0)) return start;
    const double limit = mean_spoke(disk, points, start);
    const double t = std::clamp((target.curvature - line.at.mean()) / slope, -limit, limit);
    return std::isfinite(t) ? Vector3(start + target.damping * t * normal) : present;
}

}  // namespace fairing
