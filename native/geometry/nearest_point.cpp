#include "geometry/nearest_point.h"

#include <map>

#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>

#include "base/columns.h"
#include "geometry/triangle.h"

namespace fairing {

namespace {

using Box = Eigen::AlignedBox3d;
using Tree = Eigen::KdBVH<double, 3, int>;

// Nearest point of a segment, as the barycentric weight of its end.
double segment_weight(const Vector3& p, const Vector3& a, const Vector3& b) {
    const double squared = (b - a).squaredNorm();
    return squared > 0.0 ? std::clamp((p - a).dot(b - a) / squared, 0.0, 1.0) : 0.0;
}

Vector3 area_of(const Corners& corners) { return area_vector(corners[0], corners[1], corners[2]); }

// The query for Eigen's tree search: the nearest triangle to a point.
class Nearest {
public:
    using Scalar = double;

    Nearest(const Vector3& p, const Points& points, const Triangles& triangles)
        : p_(p), points_(points), triangles_(triangles) {}

    // NOLINTBEGIN(readability-identifier-naming): Eigen calls them
    [[nodiscard]] double minimumOnVolume(const Box& box) const { return box.squaredExteriorDistance(p_); }
    double minimumOnObject(int triangle) {
        const Corners corners = corners_of(triangle);
        const Vector3 weights = nearest_weights(p_, corners);
        const Vector3 foot = weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
        const double squared = (p_ - foot).squaredNorm();
        if (squared < least_) {
            least_ = squared;
            triangle_ = triangle;
            weights_ = weights;
            foot_ = foot;
        }
        return squared;
    }
    // NOLINTEND(readability-identifier-naming)

    [[nodiscard]] Corners corners_of(int triangle) const {
        const auto corners = triangles_.col(triangle);
        return {points_.col(corners[0]), points_.col(corners[1]), points_.col(corners[2])};
    }
    [[nodiscard]] int triangle() const { return triangle_; }
    [[nodiscard]] const Vector3& weights() const { return weights_; }
    [[nodiscard]] const Vector3& foot() const { return foot_; }

private:
    Vector3 p_;
    const Points& points_;
    const Triangles& triangles_;
    double least_ = std::numeric_limits<double>::infinity();
    int triangle_ = 0;
    Vector3 weights_ = Vector3::Zero();
    Vector3 foot_ = Vector3::Zero();
};

// Normals, not normalised, that decide on which side of an edge or a corner a point lies.
struct SideNormals {
    SideNormals(const Points& points, const Triangles& triangles) : corners(Points::Zero(3, points.cols())) {
        for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
            const auto at = triangles.col(t);
            const Corners three{points.col(at[0]), points.col(at[1]), points.col(at[2])};
            const Vector3 normal = direction(area_of(three));
            for (int k = 0; k < 3; ++k) {
                const int next = (k + 1) % 3;
                const Vector3 ahead = three[next] - three[k];
                const Vector3 back = three[(k + 2) % 3] - three[k];
                corners.col(at[k]) += std::atan2(ahead.cross(back).norm(), ahead.dot(back)) * normal;
                const auto [least, most] = std::minmax({at[k], at[next]});
                edges.try_emplace({least, most}, Vector3::Zero()).first->second += normal;
            }
        }
    }

    // At a point of a triangle.
    [[nodiscard]] Vector3 at(const Eigen::Vector3i& triangle, const Vector3& weights, const Vector3& face) const {
        const auto zeros = (weights.array() == 0.0).count();
        if (zeros == 0) return face;
        Eigen::Index last = 0;
        if (zeros == 2) {
            weights.maxCoeff(&last);
            return corners.col(triangle[last]);
        }
        weights.minCoeff(&last);
        const auto [least, most] = std::minmax({triangle[(last + 1) % 3], triangle[(last + 2) % 3]});
        return edges.at({least, most});
    }

    Points corners;
    std::map<std::pair<int, int>, Vector3> edges;
};

}  // namespace

Vector3 plane_weights(const Vector3& p, const Corners& corners) {
    const auto& [a, b, c] = corners;
    const Vector3 n = area_of(corners);
    const double squared = n.squaredNorm();
    if (!(squared > 0.0)) return Vector3::Constant(1.0 / 3.0);
    const double u = n.dot((c - b).cross(p - b)) / squared;
    const double v = n.dot((a - c).cross(p - c)) / squared;
    return {u, v, 1.0 - u - v};
}

Vector3 border_weights(const Vector3& p, const Corners& corners) {
    Vector3 best(1.0, 0.0, 0.0);
    double least = (p - corners[0]).squaredNorm();
    for (int k = 0; k < 3; ++k) {
        const int l = (k + 1) % 3;
        const double s = segment_weight(p, corners[k], corners[l]);
        const double distance = (p - (1.0 - s) * corners[k] - s * corners[l]).squaredNorm();
        if (distance >= least) continue;
        least = distance;
        best.setZero();
        best[k] = 1.0 - s;
        best[l] = s;
    }
    return best;
}

Vector3 nearest_weights(const Vector3& p, const Corners& corners) {
    const Vector3 weights = plane_weights(p, corners);
    const bool has_area = area_of(corners).squaredNorm() > 0.0;
    return has_area && weights.minCoeff() >= 0.0 ? weights : border_weights(p, corners);
}

struct NearestTriangles::Boxes {
    Boxes(const Points& points, const Triangles& triangles, const Indices& chosen) {
        std::vector<Box> boxes;
        for (const int t : chosen) {
            Box box;
            for (const int v : triangles.col(t)) box.extend(Vector3(points.col(v)));
            boxes.push_back(box);
        }
        tree.init(chosen.begin(), chosen.end(), boxes.begin(), boxes.end());
    }
    Tree tree;
};

NearestTriangles::NearestTriangles(const Points& points, const Triangles& triangles, const Indices& chosen)
    : points_(points), triangles_(triangles), boxes_(std::make_unique<const Boxes>(points, triangles, chosen)) {}

NearestTriangles::~NearestTriangles() = default;

NearestPlace NearestTriangles::to(const Vector3& p) const {
    Nearest nearest(p, points_, triangles_);
    Eigen::BVMinimize(boxes_->tree, nearest);
    return {nearest.triangle(), nearest.weights(), nearest.foot()};
}

VectorX signed_distances(const Points& at, const Points& points, const Triangles& triangles) {
    Indices all(static_cast<std::size_t>(triangles.cols()));
    std::iota(all.begin(), all.end(), 0);
    const NearestTriangles nearest(points, triangles, all);
    const SideNormals sides(points, triangles);
    VectorX result(at.cols());
    for (Eigen::Index k = 0; k < at.cols(); ++k) {
        const NearestPlace found = nearest.to(at.col(k));
        const auto corners = triangles.col(found.triangle);
        const Vector3 face = area_of({points.col(corners[0]), points.col(corners[1]), points.col(corners[2])});
        const Vector3 offset = at.col(k) - found.foot;
        result[k] = std::copysign(offset.norm(), offset.dot(sides.at(corners, found.weights, face)));
    }
    return result;
}

}  // namespace fairing
