#include "start/tube_axis.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/direction.h"

namespace fairing {

namespace {

constexpr int steps = 128;  // chords for the curve

Vector3 mirrored(const Vector3& v, const Vector3& n) { return v - 2.0 * n.dot(v) / n.squaredNorm() * n; }

}  // namespace

TubeAxis::TubeAxis(const TubeEnd& first, const TubeEnd& last) : begin_(first.middle), end_(last.middle) {
    // The speed with which a cubic comes nearest to an arc.
    const double cosine = std::clamp(-first.into.dot(last.into), -1.0, 1.0);
    turn_ = std::acos(cosine);
    const double speed = 2.0 * (end_ - begin_).norm() / (1.0 + std::sqrt(0.5 * (1.0 + cosine)));
    leaving_ = speed * first.into;
    arriving_ = -speed * last.into;
    follow();
}

Vector3 TubeAxis::place(double s) const {
    const double r = 1.0 - s;
    return r * r * (1.0 + 2.0 * s) * begin_ + s * s * (1.0 + 2.0 * r) * end_ + s * r * (r * leaving_ - s * arriving_);
}

Eigen::Matrix3d TubeAxis::frame(double s) const {
    const double along = std::clamp(s, 0.0, 1.0) * steps;
    const auto k = std::min(static_cast<std::size_t>(along), frames_.size() - 2);
    const double rest = along - static_cast<double>(k);
    const Eigen::Matrix3d mean = (1.0 - rest) * frames_[k] + rest * frames_[k + 1];
    Eigen::Matrix3d frame;
    frame.col(2) = direction(mean.col(2));
    frame.col(0) = direction(mean.col(0) - mean.col(0).dot(frame.col(2)) * frame.col(2));
    frame.col(1) = frame.col(2).cross(Vector3(frame.col(0)));
    return frame;
}

double TubeAxis::length() const {
    double sum = 0.0;
    for (int k = 0; k < steps; ++k) sum += (place((k + 1.0) / steps) - place(static_cast<double>(k) / steps)).norm();
    return sum;
}

Vector3 TubeAxis::tangent(double s) const {
    const double r = 1.0 - s;
    return direction(6.0 * s * r * (end_ - begin_) + r * (r - 2.0 * s) * leaving_ + s * (s - 2.0 * r) * arriving_);
}

Vector3 TubeAxis::carried(const Vector3& across, double from, double to) const {
    const Vector3 step = place(to) - place(from);
    if (!(step.squaredNorm() > 0.0)) return across;
    const Vector3 turn = tangent(to) - mirrored(tangent(from), step);
    const Vector3 once = mirrored(across, step);
    return turn.squaredNorm() > 0.0 ? mirrored(once, turn) : once;
}

void TubeAxis::follow() {
    Vector3 across = tangent(0.0).unitOrthogonal();
    for (int k = 0; k <= steps; ++k) {
        const double s = static_cast<double>(k) / steps;
        if (k > 0) across = carried(across, s - 1.0 / steps, s);
        Eigen::Matrix3d& frame = frames_.emplace_back();
        frame.col(0) = across;
        frame.col(2) = tangent(s);
        frame.col(1) = frame.col(2).cross(across);
    }
}

}  // namespace fairing
