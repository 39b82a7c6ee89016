#include "shape/stump.h"

#include <Eigen/Geometry>

#include "base/columns.h"
#include "geometry/triangle.h"
#include "mesh/edges.h"
#include "shape/limits.h"

namespace fairing {

namespace {

// Distances from the boundary, in radii of the surface: neither the join nor the top.
constexpr double band_begin = 0.1;
constexpr double band_end = 0.5;
// Triangles on either side and edges of the boundary that are enough.
constexpr Eigen::Index most_triangles = 3000;
constexpr std::size_t most_edges = 300;

// Edges between a surface and what is outside.
struct Frames {
    std::vector<std::array<int, 2>> ends;
    Points middles;
    Points normals;
    Points outward;  // unit
};

std::vector<std::array<int, 2>> boundary_edges(const Triangles& inside, const Triangles& outside, Eigen::Index count) {
    const EdgeTable own = make_edges(inside, static_cast<int>(count));
    const EdgeTable others = make_edges(outside, static_cast<int>(count));
    std::vector<std::array<int, 2>> found;
    for (int e = 0; e < own.size(); ++e) {
        if (own.side_count(e) != 1 || !std::binary_search(others.ends.begin(), others.ends.end(), own.ends[e]))
            continue;
        found.push_back({side_tail(inside, own.side(e, 0)), side_head(inside, own.side(e, 0))});
    }
    const std::size_t stride = found.size() / most_edges + 1;
    for (std::size_t k = 0; k * stride < found.size(); ++k) found[k] = found[k * stride];
    found.resize((found.size() + stride - 1) / stride);
    return found;
}

Frames frames_of(const Points& points, const Triangles& inside, const Triangles& outside) {
    Points sums = Points::Zero(3, points.cols());
    for (const Triangles* part : {&inside, &outside}) {
        for (const auto corners : part->colwise()) {
            const Vector3 area = area_vector(points, corners);
            for (const int v : corners) sums.col(v) += area;
        }
    }
    Frames frames{boundary_edges(inside, outside, points.cols()), {}, {}, {}};
    const auto count = static_cast<Eigen::Index>(frames.ends.size());
    for (Points* each : {&frames.middles, &frames.normals, &frames.outward}) each->resize(3, count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const auto [a, b] = frames.ends[static_cast<std::size_t>(k)];
        const Vector3 normal = direction(direction(sums.col(a)) + direction(sums.col(b)));
        frames.middles.col(k) = 0.5 * (points.col(a) + points.col(b));
        frames.normals.col(k) = normal;
        frames.outward.col(k) = direction(Vector3(points.col(b) - points.col(a)).cross(normal));
    }
    return frames;
}

// Mean degrees by which the triangles within the band lean away from each edge, as a dome does on both sides; NaN at
// edges that are the nearest to none. `side`: 1 outside, −1 inside.
VectorX leans(const Frames& frames, const Points& points, const Triangles& triangles, double side, double radius) {
    VectorX sums = VectorX::Zero(frames.middles.cols());
    VectorX areas = VectorX::Zero(frames.middles.cols());
    for (Eigen::Index t = 0; t < triangles.cols(); t += triangles.cols() / most_triangles + 1) {
        const Eigen::Vector3i corners = triangles.col(t);
        const Vector3 centre = (points.col(corners[0]) + points.col(corners[1]) + points.col(corners[2])) / 3.0;
        Eigen::Index at = 0;
        const double away = std::sqrt((frames.middles.colwise() - centre).colwise().squaredNorm().minCoeff(&at));
        if (away <= band_begin * radius || away >= band_end * radius) continue;
        const Vector3 area = area_vector(points, corners);
        const double ahead = side * area.dot(frames.outward.col(at));
        sums[at] += area.norm() * std::atan2(ahead, area.dot(frames.normals.col(at))) / degree;
        areas[at] += area.norm();
    }
    return sums.cwiseQuotient(areas);
}

double radius_of(const Points& points, const Triangles& triangles) {
    double doubled = 0.0;
    for (const auto corners : triangles.colwise()) doubled += area_vector(points, corners).norm();
    return std::sqrt(0.5 * doubled / std::numbers::pi);
}

}  // namespace

Stump stump_of(const Points& points, const Triangles& inside, const Triangles& outside) {
    Stump found;
    const Frames frames = frames_of(points, inside, outside);
    if (frames.ends.empty()) return found;
    const double radius = radius_of(points, inside);
    const VectorX within = leans(frames, points, inside, -1.0, radius);
    const VectorX beyond = leans(frames, points, outside, 1.0, radius);
    double whole = 0.0;
    for (Eigen::Index k = 0; k < within.size(); ++k) {
        const double both = within[k] * beyond[k];
        if (std::isnan(both)) continue;
        const auto [a, b] = frames.ends[static_cast<std::size_t>(k)];
        const double length = (points.col(a) - points.col(b)).norm();
        const double bend = both < 0.0 ? std::min(std::abs(within[k]), std::abs(beyond[k])) : 0.0;
        found.degrees += length * bend;
        whole += length;
        if (bend > stump) found.vertices.insert(found.vertices.end(), {a, b});
    }
    found.degrees /= std::max(whole, std::numeric_limits<double>::min());
    std::sort(found.vertices.begin(), found.vertices.end());
    found.vertices.erase(std::unique(found.vertices.begin(), found.vertices.end()), found.vertices.end());
    return found;
}

}  // namespace fairing
