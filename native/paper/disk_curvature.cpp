#include "paper/disk_curvature.h"

#include <Eigen/Geometry>

namespace fairing {

namespace {

using Pair = Eigen::Array2d;

struct PairOfPoints {
    Pair x;
    Pair y;
    Pair z;
    PairOfPoints(const Vector3& p, const Vector3& q) : x(p.x(), q.x()), y(p.y(), q.y()), z(p.z(), q.z()) {}
};

Pair dot(const Vector3& a, const PairOfPoints& d) { return a.x() * d.x + a.y() * d.y + a.z() * d.z; }

// The vectors from `centre` to the neighbours, then to the virtual points, two by two. An odd one out is joined by a
// vector of no length.
template <typename Visit>
inline void for_each_pair(const Disk& disk, const DiskField& field, const Vector3& centre, Visit visit) {
    const auto neighbours = disk.ring.vertices;
    const std::size_t count = neighbours.size();
    const auto spoke = [&](std::size_t k) -> Vector3 { return field.points.col(neighbours[k]) - centre; };
    for (std::size_t k = 0; k + 1 < count; k += 2) visit(PairOfPoints(spoke(k), spoke(k + 1)));
    if (count % 2 == 1) visit(PairOfPoints(spoke(count - 1), Vector3::Zero()));
    if (!disk.completed) return;
    const auto rim = disk.ring.rim;
    const auto middle = [&](std::size_t k) -> Vector3 {
        return 0.5 * (spoke(k) + spoke(k + 1 < count ? k + 1 : 0)) + field.arcs.col(rim[k]);
    };
    for (std::size_t k = 0; k + 1 < rim.size(); k += 2) visit(PairOfPoints(middle(k), middle(k + 1)));
    if (rim.size() % 2 == 1) visit(PairOfPoints(middle(rim.size() - 1), Vector3::Zero()));
}

std::size_t padded(std::size_t count) { return count + count % 2; }

double spoke_length(const Disk& disk, const Points& points, const Vector3& centre) {
    double sum = 0.0;
    for (int v : disk.ring.vertices) sum += (points.col(v) - centre).squaredNorm();
    return std::sqrt(sum / static_cast<double>(disk.ring.valence()));
}

}  // namespace

std::size_t weight_count(const Disk& disk) {
    return padded(disk.ring.valence()) + (disk.completed ? padded(disk.ring.rim.size()) : 0);
}

CurvatureFit DiskFit::operator()(const Disk& disk, const DiskField& field, const Vector3& normal) {
    const Frame frame(normal);
    directions_.clear();
    Sums sums;
    for_each_pair(disk, field, field.points.col(disk.centre), [&](const PairOfPoints& d) {
        const Pair x = dot(frame.u, d);
        const Pair y = dot(frame.v, d);
        const Pair z = dot(normal, d);
        const Pair in_plane = x * x + y * y;
        const Pair squared = in_plane + z * z;
        const Pair counted = (in_plane > 1e-24 * squared).select(Pair(1.0, 1.0), Pair(0.0, 0.0));
        const Pair inverse = counted / (in_plane * squared).max(1e-300);
        const Pair cosine = (x * x - y * y) * squared * inverse;
        const Pair sine = 2.0 * x * y * squared * inverse;
        const Pair curvature = 2.0 * z * in_plane * inverse;
        directions_.push_back({counted, cosine, sine});
        sums.count += counted;
        sums.cosines += cosine;
        sums.sines += sine;
        sums.squares += cosine * cosine;
        sums.products += cosine * sine;
        sums.curvatures += curvature;
        sums.with_cosines += curvature * cosine;
        sums.with_sines += curvature * sine;
    });
    return solve(sums);
}

CurvatureFit DiskFit::solve(const Sums& sums) {
    const double n = sums.count.sum();
    const double c = sums.cosines.sum();
    const double s = sums.sines.sum();
    const double cs = sums.products.sum();
    const double squares = sums.squares.sum();
    // fit_curvature adds 1e-9 of its trace to each of its own unknowns x0 = H + a, x1 = 2 b, x2 = H − a.
    const double slight = 1e-9 * (n - 0.25 * (n - squares)) + 1e-300;
    const double nn = n + 2.0 * slight;
    const double cc = squares + 2.0 * slight;
    const double ss = n - squares + 4.0 * slight;
    // The inverse by cofactors, as the paper suggests (eq. 11).
    row_ = Vector3(cc * ss - cs * cs, cs * s - c * ss, c * cs - cc * s);
    const double scale = 1.0 / (nn * row_[0] + c * row_[1] + s * row_[2]);
    const Vector3 second = scale * Vector3(row_[1], nn * ss - s * s, c * s - nn * cs);
    const Vector3 third = scale * Vector3(row_[2], c * s - nn * cs, nn * cc - c * c);
    row_ *= scale;
    const Vector3 rhs(sums.curvatures.sum(), sums.with_cosines.sum(), sums.with_sines.sum());
    const double H = row_.dot(rhs);
    const double a = second.dot(rhs);
    return {H + a, 2.0 * third.dot(rhs), H - a};
}

void DiskFit::weights(std::span<double> weights) const {
    for (std::size_t k = 0; k < directions_.size(); ++k) {
        const Direction& at = directions_[k];
        const Pair pair = at.counted * (row_[0] + row_[1] * at.cosine + row_[2] * at.sine);
        weights[2 * k] = pair[0];
        weights[2 * k + 1] = pair[1];
    }
}

CurvatureLine curvature_line(const Disk& disk, const DiskField& field, std::span<const double> weights,
                             const Vector3& centre, const Vector3& normal) {
    Pair mean(0.0, 0.0);
    Pair slope(0.0, 0.0);
    const double* weight = weights.data();
    for_each_pair(disk, field, centre, [&](const PairOfPoints& d) {
        const Pair squared = d.x * d.x + d.y * d.y + d.z * d.z;
        const Pair steepness = Pair(weight[0], weight[1]) * 2.0 / squared.max(1e-300);
        mean += steepness * dot(normal, d);
        slope -= steepness;
        weight += 2;
    });
    return {mean.sum(), slope.sum()};
}

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
