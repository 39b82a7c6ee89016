#include "paper/collapse_fan.h"

#include <Eigen/Geometry>

#include "geometry/limits.h"

namespace fairing {

namespace {

// Inner radius over longest edge, relative to that of an equilateral triangle, which is 1/(2 √3), of a triangle with
// twice this area and these sides: 1 equilateral, 0 degenerate.
double roundness(double twice_area, double a, double b, double c) {
    return 2.0 * std::numbers::sqrt3 * twice_area /
           std::max((a + b + c) * std::max({a, b, c}), std::numeric_limits<double>::min());
}

}  // namespace

void CollapseFan::start(const Vector3& centre) {
    centre_ = centre;
    worst_ = 1.0;
    best_ = std::numeric_limits<double>::infinity();
    points_.clear();
    rim_.clear();
    normals_.clear();
}

void CollapseFan::close() {
    const std::size_t m = points_.size();
    from_target_.resize(m);
    for (std::size_t k = 0; k < m; ++k) {
        const Vector3 a = points_[k] - centre_;
        const Vector3 b = points_[k + 1 < m ? k + 1 : 0] - centre_;
        const Vector3 cross = a.cross(b);
        const double twice_area = cross.norm();
        rim_.push_back((b - a).norm());
        normals_.emplace_back(cross / std::max(twice_area, std::numeric_limits<double>::min()));
        worst_ = std::min(worst_, roundness(twice_area, a.norm(), b.norm(), rim_.back()));
    }
}

double CollapseFan::priority(const Vector3& target) {
    const double length = (target - centre_).norm();
    const double worst = worst_after(target, length);
    if (worst < 0.0) return -1.0;
    best_ = length * (1.5 - worst);
    return best_;
}

double CollapseFan::worst_after(const Vector3& target, double length) {
    const std::size_t m = points_.size();
    for (std::size_t k = 0; k < m; ++k) from_target_[k] = (points_[k] - target).norm();
    double worst = 1.0;
    for (std::size_t k = 0; k < m; ++k) {
        const std::size_t next = k + 1 < m ? k + 1 : 0;
        // The two triangles at the target vanish.
        if (from_target_[k] == 0.0 || from_target_[next] == 0.0) continue;
        const Vector3 cross = (points_[k] - target).cross(points_[next] - target);
        const double twice_area = cross.norm();
        if (normals_[k].dot(cross) < cos_of_widest_turn * twice_area) return -1.0;
        worst = std::min(worst, roundness(twice_area, from_target_[k], from_target_[next], rim_[k]));
        // Where triangles are bad already, the collapse need only not make them worse.
        if (worst < std::min(poor_shape, worst_) || length * (1.5 - worst) >= best_) return -1.0;
    }
    return worst;
}

}  // namespace fairing
