#include "detail/disc.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fairing {

namespace {

constexpr double vertices_per_box = 2.0;  // in the mean

}  // namespace

Points tangent_offsets(const Points& points, const Vector3& normal, const Indices& vertices) {
    Points offsets = points(Eigen::all, vertices).colwise() - Vector3(points.col(vertices.front()));
    for (auto offset : offsets.colwise()) {
        const double length = offset.norm();
        offset -= normal * normal.dot(offset);
        const double within = offset.norm();
        if (within > 0.0) offset *= length / within;
    }
    return offsets;
}

Discs::Discs(const Points& points, const Points& normals, const Triangles& triangles)
    : points_(points),
      normals_(normals),
      triangles_(triangles),
      around_(triangles, static_cast<int>(points.cols())),
      walk_(around_, points),
      triangles_at_(static_cast<int>(points.cols())),
      places_(2, points.cols()),
      cut_(static_cast<int>(points.cols()), none) {
    for (int t = 0; t < static_cast<int>(triangles.cols()); ++t) {
        for (int v : triangles.col(t)) triangles_at_[v].push_back(t);
    }
}

void Discs::cut(int centre, double radius) {
    ++stamp_;
    frame_ = Frame(normals_.col(centre));
    radius_ = radius;
    const Indices& reached = walk_.gather(centre, radius);
    const Points offsets = tangent_offsets(points_, normals_.col(centre), reached);
    boxes_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(reached.size()) / vertices_per_box)));
    in_box_.assign(boxes_ * boxes_, {});
    for (std::size_t k = 0; k < reached.size(); ++k) {
        const Plane place = flat(offsets.col(static_cast<Eigen::Index>(k)));
        places_.col(reached[k]) = place;
        cut_[reached[k]] = stamp_;
        in_box_[box(box_of(place, 0), box_of(place, 1))].push_back(reached[k]);
    }
}

int Discs::box_of(const Plane& place, int axis) const {
    const double share = (place[axis] + radius_) / (2.0 * radius_);
    return std::clamp(static_cast<int>(share * boxes_), 0, boxes_ - 1);
}

// Rings of boxes, until none that is left can hold a nearer vertex.
int Discs::nearest(const Vector3& offset) const {
    const Plane place = flat(offset);
    const int x = box_of(place, 0);
    const int y = box_of(place, 1);
    const double size = 2.0 * radius_ / boxes_;
    double least = std::numeric_limits<double>::infinity();
    int best = none;
    for (int ring = 0; ring < boxes_; ++ring) {
        if (best != none && std::sqrt(least) <= (ring - 1) * size) break;
        for (int j = std::max(y - ring, 0); j <= std::min(y + ring, boxes_ - 1); ++j) {
            for (int i = std::max(x - ring, 0); i <= std::min(x + ring, boxes_ - 1); ++i) {
                if (std::max(std::abs(i - x), std::abs(j - y)) != ring) continue;
                for (int v : in_box_[box(i, j)]) {
                    const double apart = (places_.col(v) - place).squaredNorm();
                    if (apart < least) {
                        least = apart;
                        best = v;
                    }
                }
            }
        }
    }
    return best;
}

// Barycentric; NaN where the triangle has no area in the plane.
Vector3 Discs::corner_weights(int triangle, const Plane& place) const {
    const auto corners = triangles_.col(triangle);
    const Plane a = places_.col(corners[0]);
    const Plane ab = places_.col(corners[1]) - a;
    const Plane ac = places_.col(corners[2]) - a;
    const Plane ap = place - a;
    const double area = ab.x() * ac.y() - ab.y() * ac.x();
    const double second = (ap.x() * ac.y() - ap.y() * ac.x()) / area;
    const double third = (ab.x() * ap.y() - ab.y() * ap.x()) / area;
    return {1.0 - second - third, second, third};
}

double Discs::value(const VectorX& field, const Vector3& offset) const {
    const int vertex = nearest(offset);
    const Plane place = flat(offset);
    double inside = -std::numeric_limits<double>::infinity();
    double result = field[vertex];
    for (int t : triangles_at_[vertex]) {
        const auto corners = triangles_.col(t);
        if (std::any_of(corners.begin(), corners.end(), [&](int v) { return cut_[v] != stamp_; })) continue;
        const Vector3 weights = corner_weights(t, place);
        if (!(weights.minCoeff() > inside)) continue;
        inside = weights.minCoeff();
        const Vector3 within = weights.cwiseMax(0.0) / weights.cwiseMax(0.0).sum();
        result = within.dot(Vector3(field[corners[0]], field[corners[1]], field[corners[2]]));
    }
    return result;
}

}  // namespace fairing
