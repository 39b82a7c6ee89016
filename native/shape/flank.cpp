#include "shape/flank.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>

#include "base/direction.h"
#include "shape/knobs.h"
#include "shape/limits.h"

namespace fairing {

namespace {

// Distances from the boundary, in radii of the patch, of the surroundings that are asked what they are as a whole.
constexpr double ring_begin = 0.5;
constexpr double ring_end = 1.5;
constexpr double end_step = 0.2;             // how finely a feature's end is looked for
constexpr double same_way = 0.6;             // length of the mean normal of what may be seen as one surface
constexpr double widest_gap = 90.0;          // degrees around the patch without any of them
constexpr double top = 0.1;                  // the share of the patch that stands off most
constexpr Eigen::Index most_samples = 3000;  // triangles and vertices that are enough
constexpr std::size_t most_places = 300;     // of the boundary
constexpr std::size_t fewest = 12;
constexpr int terms = 6;  // of a quadric

// A place around the patch.
struct Sample {
    Vector3 place;
    Vector3 normal;
    double away;  // from the boundary
};

Indices spread(const Indices& from, std::size_t most) {
    Indices found;
    for (std::size_t k = 0; k < from.size(); k += from.size() / most + 1) found.push_back(from[k]);
    return found;
}

std::vector<Sample> samples_of(const Around& around, const Points& boundary) {
    std::vector<Sample> samples;
    for (Eigen::Index t = 0; t < around.triangles.cols(); t += around.triangles.cols() / most_samples + 1) {
        const auto corners = around.triangles.col(t);
        const Vector3 a = around.points.col(corners[0]);
        const Vector3 b = around.points.col(corners[1]);
        const Vector3 c = around.points.col(corners[2]);
        const Vector3 centre = (a + b + c) / 3.0;
        const double squared = (boundary.colwise() - centre).colwise().squaredNorm().minCoeff();
        samples.push_back({centre, direction((b - a).cross(Vector3(c - a))), std::sqrt(squared)});
    }
    return samples;
}

double radius_of(const Points& points, const Triangles& triangles) {
    double doubled = 0.0;
    for (const auto corners : triangles.colwise()) {
        const Vector3 a = points.col(corners[0]);
        doubled += (points.col(corners[1]) - a).cross(Vector3(points.col(corners[2]) - a)).norm();
    }
    return std::sqrt(0.5 * doubled / std::numbers::pi);
}

// The quadric over a plane that fits some places best. Lengths are in radii of the patch.
class Quadric {
public:
    Quadric(const Vector3& centre, const Vector3& up, double radius) : centre_(centre), up_(up), radius_(radius) {
        x_ = up.unitOrthogonal();
        y_ = up.cross(x_);
    }

    // Root of the mean squared distance that is left.
    double fit(const std::vector<Sample>& samples) {
        Eigen::MatrixXd rows(static_cast<Eigen::Index>(samples.size()), terms);
        VectorX heights(rows.rows());
        for (Eigen::Index k = 0; k < rows.rows(); ++k) {
            rows.row(k) = row(samples[static_cast<std::size_t>(k)].place);
            heights[k] = height(samples[static_cast<std::size_t>(k)].place);
        }
        coefficients_ = rows.colPivHouseholderQr().solve(heights);
        return (heights - rows * coefficients_).norm() / std::sqrt(static_cast<double>(samples.size()));
    }

    [[nodiscard]] double above(const Vector3& place) const { return height(place) - row(place).dot(coefficients_); }
    // Around the centre.
    [[nodiscard]] double angle(const Vector3& place) const {
        return std::atan2(y_.dot(place - centre_), x_.dot(place - centre_));
    }

private:
    [[nodiscard]] double height(const Vector3& place) const { return up_.dot(place - centre_) / radius_; }
    [[nodiscard]] Eigen::RowVectorXd row(const Vector3& place) const {
        const double x = x_.dot(place - centre_) / radius_;
        const double y = y_.dot(place - centre_) / radius_;
        Eigen::RowVectorXd found(terms);
        found << 1.0, x, y, x * x, x * y, y * y;
        return found;
    }

    Vector3 centre_;
    Vector3 up_;
    Vector3 x_;
    Vector3 y_;
    double radius_;
    VectorX coefficients_ = VectorX::Zero(terms);
};

// Degrees of the widest gap between the places, seen from the quadric's centre.
double gap_around(const Quadric& quadric, const std::vector<Sample>& samples) {
    std::vector<double> angles;
    for (const Sample& sample : samples) angles.push_back(quadric.angle(sample.place));
    std::sort(angles.begin(), angles.end());
    double widest = angles.front() + 2.0 * std::numbers::pi - angles.back();
    for (std::size_t k = 1; k < angles.size(); ++k) widest = std::max(widest, angles[k] - angles[k - 1]);
    return widest * 180.0 / std::numbers::pi;
}

// How far the tenth of the patch that stands off most does, in the mean: above 0 where it stands out.
double stands_out(const Quadric& quadric, const Points& points) {
    std::vector<double> heights;
    for (Eigen::Index v = 0; v < points.cols(); v += points.cols() / most_samples + 1) {
        heights.push_back(quadric.above(points.col(v)));
    }
    std::sort(heights.begin(), heights.end(), [](double a, double b) { return std::abs(a) > std::abs(b); });
    const auto count = std::max<std::size_t>(1, static_cast<std::size_t>(top * static_cast<double>(heights.size())));
    double size = 0.0;
    double sum = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
        size += std::abs(heights[k]);
        sum += heights[k];
    }
    return std::copysign(size / static_cast<double>(count), sum);
}

// How far out, in radii, what stands off comes down to the quadric.
double end_of_flank(const Quadric& quadric, const std::vector<Sample>& samples, double radius, double rest) {
    const auto count = static_cast<Eigen::Index>(std::lround(ring_end / end_step));
    VectorX sums = VectorX::Zero(count);
    VectorX counts = VectorX::Zero(count);
    for (const Sample& sample : samples) {
        const auto step = static_cast<Eigen::Index>(sample.away / radius / end_step);
        if (step >= count) continue;
        sums[step] += std::abs(quadric.above(sample.place));
        counts[step] += 1.0;
    }
    Eigen::Index step = 0;
    while (step + 1 < count && sums[step] > 2.0 * rest * counts[step]) ++step;
    return static_cast<double>(step + 1) * end_step;
}

}  // namespace

std::optional<Flank> flank_of(const Patch& patch, const Points& points, const Around& around) {
    const double radius = radius_of(points, patch.triangles);
    if (!is_plain_disc(patch) || !(radius > 0.0)) return std::nullopt;
    const Indices loop = patch.loops().front();
    const Points boundary = points(Eigen::all, spread(loop, most_places));
    std::vector<Sample> samples = samples_of(around, boundary);
    std::vector<Sample> ring;
    Vector3 sum = Vector3::Zero();
    for (const Sample& sample : samples) {
        if (sample.away < ring_begin * radius || sample.away > ring_end * radius) continue;
        ring.push_back(sample);
        sum += sample.normal;
    }
    if (ring.size() < fewest || sum.norm() < same_way * static_cast<double>(ring.size())) return std::nullopt;
    const Vector3 up = direction(sum);
    const auto turned_away = [&](const Sample& sample) { return sample.normal.dot(up) <= 0.0; };
    std::erase_if(ring, turned_away);
    std::erase_if(samples, turned_away);
    Quadric quadric(boundary.rowwise().mean(), up, radius);
    if (ring.size() < fewest || gap_around(quadric, ring) > widest_gap) return std::nullopt;
    const double rest = std::max(quadric.fit(ring), least_rest);
    const double height = stands_out(quadric, points);
    if (std::abs(height) <= stands_off * rest) return std::nullopt;
    return Flank{loop, height > 0.0, end_of_flank(quadric, samples, radius, rest) * radius};
}

}  // namespace fairing
