#include "paper/vertex_update.h"

#include <algorithm>
#include <cmath>

namespace fairing {

namespace {

double spoke_length(const Disk& disk, const Points& points, const Vector3& centre) {
    double sum = 0.0;
    for (int v : disk.ring.vertices) sum += (points.col(v) - centre).squaredNorm();
    return std::sqrt(sum / static_cast<double>(disk.ring.valence()));
}

}  // namespace

Vector3 updated_position(const Disk& disk, const DiskField& field, const VertexTarget& target) {
    const Vector3 present = field.points.col(disk.centre);
    Vector3 start = target.mean - target.normal.dot(target.mean - present) * target.normal;
    const CurvatureLine line = curvature_line(disk, field, target.weights, start, target.normal);
    if (!(std::abs(line.slope) > 0.0)) return start;
    const double limit = spoke_length(disk, field.points, start);
    const double t = std::clamp((target.curvature - line.mean) / line.slope, -limit, limit);
    return std::isfinite(t) ? Vector3(start + target.damping * t * target.normal) : present;
}

}  // namespace fairing
