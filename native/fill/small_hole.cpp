#include "fill/small_hole.h"

#include "base/columns.h"
#include "fill/limits.h"
#include "fill/triangulation.h"
#include "geometry/segments.h"
#include "geometry/triangle.h"

namespace fairing {

namespace {

constexpr double split_length = 4.0 / 3.0;  // of the wanted length: longer edges are split, as in every new mesh

bool is_edge_of(const Triangles& triangles, int a, int b) {
    for (const auto corners : triangles.colwise()) {
        if ((corners.array() == a).any() && (corners.array() == b).any()) return true;
    }
    return false;
}

Vector3 area_of(const LoopShape& loop, const std::array<int, 3>& corners) { return area_vector(loop.points, corners); }

bool lies_on_another_edge(const LoopShape& loop, int k, double reach) {
    const int n = loop.size();
    for (int e = (k + 1) % n; e != (k + n - 1) % n; e = (e + 1) % n) {
        if (distance_to_segment(loop.points.col(k), loop.points.col(e), loop.points.col((e + 1) % n)) <= reach)
            return true;
    }
    return false;
}

// Whether all triangles of a fan around the hub face as the loop's normals do, and these one way.
bool is_star(const LoopShape& loop, const Vector3& hub) {
    constexpr double flat_enough = 0.5;  // length of the mean normal: 0 at the end of a tube, where a fan faces nowhere
    const Vector3 normal = loop.normals.rowwise().sum();
    if (!(normal.norm() > flat_enough * loop.size())) return false;
    for (int k = 0; k < loop.size(); ++k) {
        const Vector3 next = loop.points.col((k + 1) % loop.size()) - hub;
        if (!((loop.points.col(k) - hub).cross(next).dot(normal) > 0.0)) return false;
    }
    return true;
}

}  // namespace

bool is_crack(const LoopShape& loop) {
    constexpr double narrow = 0.1;  // of an edge: a mesh within would be of slivers
    const double reach = narrow * loop.perimeter() / loop.size();
    int apart = 0;
    for (int k = 0; k < loop.size() && apart <= 2; ++k) apart += lies_on_another_edge(loop, k, reach) ? 0 : 1;
    return apart <= 2;
}

bool takes_no_vertex(const LoopShape& loop, double spacing) {
    if (loop.size() > 4) return is_crack(loop);
    double longest = 0.0;
    for (int k = 0; k < loop.size(); ++k) longest = std::max(longest, loop.edge(k).norm());
    return !(spacing > 0.0) || longest <= split_length * spacing;
}

std::optional<Triangles> face_over(const BoundaryLoop& loop, const Triangles& around) {
    const Indices& at = loop.vertices;
    const int count = loop.shape.size();
    const Vector3 normal = loop.shape.normals.rowwise().sum();
    const auto facing = [&](const Triangles& cut) {
        double least = std::numeric_limits<double>::infinity();
        for (const auto corners : cut.colwise())
            least = std::min(least, std::cos(radians_between(area_vector(loop.shape.points, corners), normal)));
        return least;
    };
    Triangles face(3, 2);
    Triangles other(3, 2);
    face << 0, 0, 1, 2, 2, 3;
    other << 1, 1, 2, 3, 3, 0;
    if (count != 4) {
        Indices places(at.size());
        std::iota(places.begin(), places.end(), 0);
        face = as_columns(cheapest_triangulation(places, TriangleCost(loop.shape.points)));
    } else if (facing(face) >= facing(other) ? is_edge_of(around, at[0], at[2]) : !is_edge_of(around, at[1], at[3])) {
        face = other;
    }
    for (int k = 0; k < face.size(); ++k) {
        const int a = face(k % 3, k / 3);
        const int b = face((k + 1) % 3, k / 3);
        const bool is_inner = (a + 1) % count != b && (b + 1) % count != a;
        if (is_inner && is_edge_of(around, at[a], at[b])) return std::nullopt;
    }
    return face.unaryExpr([&](int k) { return at[k]; });
}

VectorX angles_of_face(const BoundaryLoop& loop, const Triangles& face) {
    VectorX angles(loop.shape.size());
    for (int k = 0; k < loop.shape.size(); ++k) {
        Vector3 sum = Vector3::Zero();
        for (const auto corners : face.colwise()) {
            if (!(corners.array() == loop.vertices[k]).any()) continue;
            std::array<int, 3> places{};
            for (int c = 0; c < 3; ++c) {
                const auto found = std::find(loop.vertices.begin(), loop.vertices.end(), corners[c]);
                places[c] = static_cast<int>(found - loop.vertices.begin());
            }
            sum += area_of(loop.shape, places);
        }
        angles[k] = degrees_between(sum, loop.shape.normals.col(k));
    }
    return angles;
}

bool takes_hub(const LoopShape& loop, const Vector3& hub) {
    constexpr int fewest = 5;               // below, the hole is one face
    constexpr int most = 8;                 // beyond, a fan's angles fall below 40°
    constexpr double longest_spoke = 1.45;  // of the mean edge: 1.31 in a regular octagon, 1.41 in a square of 8 edges
    if (loop.size() < fewest || loop.size() > most || !is_star(loop, hub)) return false;
    const double mean = loop.perimeter() / loop.size();
    for (int k = 0; k < loop.size(); ++k) {
        const Vector3 spoke = loop.points.col(k) - hub;
        const Vector3 next = loop.points.col((k + 1) % loop.size()) - hub;
        const Vector3 area = spoke.cross(next);
        const double edge = (next - spoke).norm();
        if (!(spoke.norm() <= longest_spoke * mean)) return false;
        const double largest = std::max({spoke.norm() * next.norm(), edge * next.norm(), edge * spoke.norm()});
        if (!(area.norm() >= std::sin(bad_angle * degree) * largest)) return false;
    }
    return true;
}

Triangles fan(const Indices& loop, int hub) {
    Triangles triangles(3, static_cast<Eigen::Index>(loop.size()));
    for (std::size_t k = 0; k < loop.size(); ++k)
        triangles.col(static_cast<Eigen::Index>(k)) = Eigen::Vector3i(loop[k], loop[(k + 1) % loop.size()], hub);
    return triangles;
}

}  // namespace fairing
