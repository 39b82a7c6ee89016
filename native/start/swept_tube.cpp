#include "start/swept_tube.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "base/direction.h"
#include "start/outline_creases.h"

namespace fairing {

namespace {

constexpr double least_agreement = 0.5;  // of the directions into the gap; 0 around a flat ring, 1 at a tube
constexpr double least_share = 1e-12;

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

// Nothing where two outlines don't face each other along one tube.
std::optional<TwoRims> two_rims(const std::vector<Indices>& loops, const Points& points, const Points& normals) {
    if (loops.size() != 2 || loops[0].size() + loops[1].size() != static_cast<std::size_t>(points.cols()))
        return std::nullopt;
    const auto first = rim_at(loops[0], points, normals);
    const auto last = rim_at(loops[1], points, normals);
    if (!first || !last || !(first->outward * last->outward > 0.0)) return std::nullopt;
    return TwoRims{*first, *last};
}

// Into the gap along both tangent planes of each crease.
Vector3 along_creases(const Indices& loop, const Indices& creases, const Points& normals, const Vector3& into) {
    const auto size = static_cast<int>(loop.size());
    Vector3 sum = Vector3::Zero();
    for (const int k : creases) {
        const Vector3 before = normals.col(loop[at((k + size - 1) % size)]);
        const Vector3 way = before.cross(Vector3(normals.col(loop[at((k + 1) % size)])));
        sum += way.dot(into) < 0.0 ? Vector3(-way) : way;
    }
    return sum.norm() > 0.0 ? direction(sum) : into;
}

// Which crease of the other outline continues the first one of this: the places of all lie nearest then.
std::size_t best_partner(const std::vector<Vector3>& here, const std::vector<Vector3>& there) {
    double least = std::numeric_limits<double>::infinity();
    std::size_t best = 0;
    for (std::size_t first = 0; first < there.size(); ++first) {
        double sum = 0.0;
        for (std::size_t k = 0; k < here.size(); ++k)
            sum += (here[k] - there[(first + k) % there.size()]).squaredNorm();
        if (sum >= least) continue;
        least = sum;
        best = first;
    }
    return best;
}

// Of creases (places in a loop), in the frame of the axis.
std::vector<Vector3> places_of(const Indices& creases, const Indices& loop, const Points& points, const TubeAxis& axis,
                               double s) {
    std::vector<Vector3> places;
    for (const int k : creases)
        places.emplace_back(axis.frame(s).transpose() * (points.col(loop[at(k)]) - axis.place(s)));
    return places;
}

// Of creases in the order around from the one at which the section begins.
std::vector<double> shares_of(const Indices& creases, std::size_t first, const TubeSection& section) {
    const auto size = static_cast<int>(section.vertices().size());
    std::vector<double> shares;
    for (std::size_t k = 0; k < creases.size(); ++k) {
        const int along = creases[(first + k) % creases.size()] - creases[first];
        shares.push_back(section.share(at((along + size) % size)));
    }
    return shares;
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
    constexpr int samples = 32;
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

std::optional<TubeEnd> tube_end(const Indices& loop, const Points& points, const Points& normals) {
    const auto rim = rim_at(loop, points, normals);
    return rim ? std::optional(rim->end) : std::nullopt;
}

std::optional<double> tube_length(const std::vector<Indices>& loops, const Points& points, const Points& normals) {
    const auto rims = two_rims(loops, points, normals);
    if (!rims) return std::nullopt;
    const double radii = radius_of_area(area_within(loops[0], points)) + radius_of_area(area_within(loops[1], points));
    return 2.0 * TubeAxis(rims->first.end, rims->last.end).length() / radii;
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
    const double part = (u - shares_[k - 1]) / std::max(shares_[k] - shares_[k - 1], least_share);
    return (1.0 - part) * locals_[k - 1] + part * locals_[k];
}

void TubeSection::stretch(const std::vector<double>& from, const std::vector<double>& to) {
    for (double& share : shares_) {
        const auto after = std::upper_bound(from.begin(), from.end(), share);
        const auto k = static_cast<std::size_t>(after - from.begin());
        const double begin = from[k - 1];
        const double end = k < from.size() ? from[k] : 1.0;
        const double wanted = k < to.size() ? to[k] : 1.0;
        share = to[k - 1] + (share - begin) / std::max(end - begin, least_share) * (wanted - to[k - 1]);
    }
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

std::optional<SweptTube> SweptTube::creased(const std::vector<Indices>& loops, const Points& points,
                                            const Points& normals) {
    auto rims = two_rims(loops, points, normals);
    if (!rims) return std::nullopt;
    const Indices turned(loops[1].rbegin(), loops[1].rend());  // around the axis as the first one
    Indices here = outline_creases(loops[0], normals);
    Indices there = outline_creases(turned, normals);
    const std::size_t count = std::min(here.size(), there.size());
    if (count == 0) return std::nullopt;
    for (Indices* creases : {&here, &there}) {
        creases->resize(count);
        std::sort(creases->begin(), creases->end());
    }
    rims->first.end.into = along_creases(loops[0], here, normals, rims->first.end.into);
    rims->last.end.into = along_creases(turned, there, normals, rims->last.end.into);
    TubeAxis axis(rims->first.end, rims->last.end);
    const std::size_t partner =
        best_partner(places_of(here, loops[0], points, axis, 0.0), places_of(there, turned, points, axis, 1.0));
    TubeSection below(loops[0], at(here[0]), points, axis, 0.0);
    TubeSection above(turned, at(there[partner]), points, axis, 1.0);
    above.stretch(shares_of(there, partner, above), shares_of(here, 0, below));
    std::vector<double> creases = shares_of(here, 0, below);
    SweptTube tube(std::move(axis), std::move(below), std::move(above));
    tube.creases_ = std::move(creases);
    return tube;
}

SweptTube::SweptTube(TubeAxis axis, TubeSection first, TubeSection last)
    : axis_(std::move(axis)), first_(std::move(first)), last_(std::move(last)) {}

Vector3 SweptTube::place(double s, double u) const {
    return axis_.place(s) + axis_.frame(s) * ((1.0 - s) * first_.at_share(u) + s * last_.at_share(u));
}

}  // namespace fairing
