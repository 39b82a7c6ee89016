#include "boundary/fair_curve.h"

#include <stdexcept>

#include <Eigen/Geometry>

namespace fairing {

namespace {

constexpr double straight = 1e-9;  // height of an arc over its chord: a line to rounding
constexpr int steps = 256;         // chords by which the length is measured: exact on arcs, to 1e-5 elsewhere

// The arc from the origin to `end` that leaves along a unit tangent, at a share of its length.
Vector3 on_arc(const Vector3& tangent, const Vector3& end, double share) {
    const double along = end.dot(tangent);
    const Vector3 across = end - along * tangent;
    const double height = across.norm();
    if (!(height > straight * end.norm())) return share * end;
    const double turn = 2.0 * share * std::atan2(height, along);
    const double radius = end.squaredNorm() / (2.0 * height);
    return radius * (std::sin(turn) * tangent + (1.0 - std::cos(turn)) / height * across);
}

}  // namespace

Points fair_curve(const CurveEnd& begin, const CurveEnd& end, const VectorX& shares) {
    const Vector3 chord = end.place - begin.place;
    if (!(chord.norm() > 0.0)) throw std::invalid_argument("a curve needs two different ends");
    const Vector3 along = chord.normalized();
    // The tangent at the beginning of the arc that ends along `direction`.
    const auto mirrored = [&](const Vector3& d) { return Vector3(2.0 * along.dot(d) * along - d); };
    Vector3 first = begin.direction.normalized();
    Vector3 last = mirrored(end.direction.normalized());
    if (first.isZero(0.0)) first = last.isZero(0.0) ? along : last;
    if (last.isZero(0.0)) last = first;
    const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(first, last);
    const auto at = [&](double t) { return on_arc(Eigen::Quaterniond::Identity().slerp(t, turn) * first, chord, t); };
    std::vector<double> lengths{0.0};
    for (int k = 1; k <= steps; ++k)
        lengths.push_back(lengths.back() + (at(double(k) / steps) - at((k - 1.0) / steps)).norm());
    Points result(3, shares.size());
    for (Eigen::Index k = 0; k < shares.size(); ++k) {
        const double wanted = std::clamp(shares[k], 0.0, 1.0) * lengths.back();
        const auto after = std::upper_bound(lengths.begin() + 1, lengths.end() - 1, wanted);
        const double cell = (wanted - *(after - 1)) / (*after - *(after - 1));
        result.col(k) = begin.place + at((double(after - 1 - lengths.begin()) + cell) / steps);
    }
    return result;
}

}  // namespace fairing
