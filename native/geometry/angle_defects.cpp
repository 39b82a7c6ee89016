#include "geometry/angle_defects.h"

#include <algorithm>
#include <numbers>

#include "geometry/angle.h"

namespace fairing {

VectorX angle_defects(const Patch& patch, const Points& points) {
    VectorX defects = VectorX::Zero(patch.vertex_count());
    defects.head(patch.free_count).setConstant(2.0 * std::numbers::pi);
    for (const auto corners : patch.triangles.colwise()) {
        for (int k = 0; k < 3; ++k) {
            const int v = corners[k];
            if (!patch.is_free(v)) continue;
            const Vector3 here = points.col(v);
            defects[v] -=
                radians_between(points.col(corners[(k + 1) % 3]) - here, points.col(corners[(k + 2) % 3]) - here);
        }
    }
    return defects;
}

double bent_both_ways(const Patch& patch, const Points& points) {
    const VectorX defects = angle_defects(patch, points);
    const double balls = defects.cwiseMax(0.0).sum();
    const double saddles = -defects.cwiseMin(0.0).sum();
    return std::min(balls, saddles) / (2.0 * std::numbers::pi);
}

}  // namespace fairing
