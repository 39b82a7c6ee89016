#include "start/swept_tube.h"

#include <Eigen/Geometry>

#include "base/columns.h"

namespace fairing {

namespace {

constexpr int steps = 128;  // chords for the curve

Vector3 mirrored(const Vector3& v, const Vector3& n) { return v - 2.0 * n.dot(v) / n.squaredNorm() * n; }

constexpr double least_agreement = 0.5;  // of the directions into the gap; 0 around a flat ring, 1 at a tube

struct Rim {
    TubeEnd end;
    double outward;  // of the normals: above 0 where they point away from the axis
};

struct TwoRims {
    Rim first;
    Rim last;
};

std::optional<Rim> rim_at(const Indices& loop, const Points& points, const Points& normals) {
    Rim rim{{Vector3::Zero(), Vector3::Zero()}, 0.0};
    for (const int v : loop) rim.end.middle += points.col(v) / static_cast<double>(loop.size());
    double total = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const int a = loop[k];
        const int b = loop[(k + 1) % loop.size()];
        const Vector3 normal = normals.col(a) + normals.col(b);
        const Vector3 into = normal.cross(Vector3(points.col(b) - points.col(a)));
        rim.end.into += into;
        total += into.norm();
        rim.outward += normals.col(a).dot(points.col(a) - rim.end.middle);
    }
    if (!(rim.end.into.norm() > least_agreement * total)) return std::nullopt;
    rim.end.into = direction(rim.end.into);
    return rim;
}

// Nothing where two boundaries don't face each other along one tube.
std::optional<TwoRims> two_rims(const std::vector<Indices>& loops, const Points& points, const Points& normals) {
    if (loops.size() != 2 || loops[0].size() + loops[1].size() != static_cast<std::size_t>(points.cols()))
        return std::nullopt;
    const auto first = rim_at(loops[0], points, normals);
    const auto last = rim_at(loops[1], points, normals);
    if (!first || !last || !(first->outward * last->outward > 0.0)) return std::nullopt;
    return TwoRims{*first, *last};
}

double distance(const TubeSection& a, const TubeSection& b, int samples) {
    double sum = 0.0;
    for (int k = 0; k < samples; ++k) {
        const double u = static_cast<double>(k) / samples;
        sum += (a.at_share(u) - b.at_share(u)).squaredNorm();
    }
    return sum;
}

// Begun where it lies best before the other one.
std::size_t best_beginning(const Indices& loop, const Points& points, const TubeAxis& axis, const TubeSection& other) {
    constexpr int samples = 32;  // places of a section that are compared
    double least = std::numeric_limits<double>::infinity();
    std::size_t best = 0;
    for (std::size_t first = 0; first < loop.size(); ++first) {
        const double here = distance(other, TubeSection(loop, first, points, axis, 1.0), samples);
        if (here >= least) continue;
        least = here;
        best = first;
    }
    return best;
}

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

std::optional<TubeEnd> tube_end(const Indices& loop, const Points& points, const Points& normals) {
    const auto rim = rim_at(loop, points, normals);
    return rim ? std::optional(rim->end) : std::nullopt;
}

double area_within(const Indices& loop, const Points& points) {
    Vector3 area = Vector3::Zero();
    for (std::size_t k = 0; k < loop.size(); ++k)
        area += 0.5 * points.col(loop[k]).cross(points.col(loop[(k + 1) % loop.size()]));
    return area.norm();
}

double radius_of_area(double area) { return std::sqrt(area / std::numbers::pi); }

TubeSection::TubeSection(const Indices& loop, std::size_t first, const Points& points, const TubeAxis& axis, double s) {
    const Eigen::Matrix3d frame = axis.frame(s);
    for (std::size_t k = 0; k <= loop.size(); ++k) {
        const int v = loop[(first + k) % loop.size()];
        if (k < loop.size()) vertices_.push_back(v);
        locals_.emplace_back(frame.transpose() * (points.col(v) - axis.place(s)));
        const double step = k == 0 ? 0.0 : (locals_[k] - locals_[k - 1]).norm();
        shares_.push_back(k == 0 ? 0.0 : shares_.back() + step);
    }
    girth_ = shares_.back();
    for (double& share : shares_) share /= girth_;
}

Vector3 TubeSection::at_share(double u) const {
    const auto after = std::upper_bound(shares_.begin() + 1, shares_.end() - 1, u);
    const auto k = static_cast<std::size_t>(after - shares_.begin());
    const double width = shares_[k] - shares_[k - 1];
    const double part = width > 0.0 ? (u - shares_[k - 1]) / width : 0.0;
    return (1.0 - part) * locals_[k - 1] + part * locals_[k];
}

std::optional<SweptTube> SweptTube::between(const std::vector<Indices>& loops, const Points& points,
                                            const Points& normals) {
    const auto rims = two_rims(loops, points, normals);
    if (!rims) return std::nullopt;
    TubeAxis axis(rims->first.end, rims->last.end);
    TubeSection below(loops[0], 0, points, axis, 0.0);
    Indices turned = loops[1];
    std::reverse(turned.begin(), turned.end());  // around the axis as the first one
    TubeSection above(turned, best_beginning(turned, points, axis, below), points, axis, 1.0);
    return SweptTube(std::move(axis), std::move(below), std::move(above));
}

SweptTube::SweptTube(TubeAxis axis, TubeSection first, TubeSection last)
    : axis_(std::move(axis)), first_(std::move(first)), last_(std::move(last)) {}

Vector3 SweptTube::place(double s, double u) const {
    return axis_.place(s) + axis_.frame(s) * ((1.0 - s) * first_.at_share(u) + s * last_.at_share(u));
}

}  // namespace fairing
