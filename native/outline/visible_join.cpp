#include "outline/visible_join.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <Eigen/Geometry>

#include "base/direction.h"
#include "outline/dihedral_bands.h"

namespace fairing {

namespace {

Triangles without_collapsed(const Triangles& triangles) {
    std::vector<Eigen::Index> kept;
    for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
        const auto corners = triangles.col(t);
        if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]) kept.push_back(t);
    }
    return triangles(Eigen::all, kept);
}

// An edge with one triangle on each side of the outline: sides (3 t + k) of the two lists.
struct OutlineEdge {
    std::array<int, 2> ends;
    int inside;
    int outside;
};

std::vector<OutlineEdge> shared_edges(const EdgeTable& inside, const EdgeTable& outside) {
    std::map<std::array<int, 2>, int> border;
    for (int e = 0; e < outside.size(); ++e) {
        if (outside.side_count(e) == 1) border[outside.ends[at(e)]] = outside.side(e, 0);
    }
    std::vector<OutlineEdge> shared;
    for (int e = 0; e < inside.size(); ++e) {
        const auto found = border.find(inside.ends[at(e)]);
        if (inside.side_count(e) == 1 && found != border.end()) {
            shared.push_back({inside.ends[at(e)], inside.side(e, 0), found->second});
        }
    }
    return shared;
}

Vector3 normal_of(const Points& points, const Triangles& triangles, int side) {
    const auto corners = triangles.col(side / 3);
    const Vector3 a = points.col(corners[0]);
    return direction((points.col(corners[1]) - a).cross(Vector3(points.col(corners[2]) - a)));
}

double angle_at(const Points& points, const JoinedMesh& mesh, const OutlineEdge& edge) {
    const int opposite = mesh.outside((edge.outside % 3 + 2) % 3, edge.outside / 3);
    return dihedral_angle(normal_of(points, mesh.inside, edge.inside), normal_of(points, mesh.outside, edge.outside),
                          points.col(edge.ends[0]), points.col(opposite));
}

// Length-weighted means at the ends of edges.
class Means {
public:
    explicit Means(Eigen::Index count) : sum_(VectorX::Zero(count)), weight_(VectorX::Zero(count)) {}

    void add(const std::array<int, 2>& ends, double value, double length) {
        for (int v : ends) {
            sum_[v] += value * length;
            weight_[v] += length;
        }
    }

    [[nodiscard]] double operator[](Eigen::Index v) const { return weight_[v] > 0.0 ? sum_[v] / weight_[v] : 0.0; }

private:
    VectorX sum_;
    VectorX weight_;
};

bool is_border(const Patch& patch, const std::array<int, 2>& ends) {
    const RingView ring = patch.ring(ends[0]);
    return !ring.closed() && (ring.vertices.front() == ends[1] || ring.vertices.back() == ends[1]);
}

// All triangles that the bands of border edges depend on: of a large patch few.
Triangles beside_border(const Patch& patch) {
    std::vector<char> near(at(patch.vertex_count()), 0);
    for (int v = patch.free_count; v < patch.vertex_count(); ++v) near[at(v)] = !patch.ring(v).closed();
    const auto is_near = [&](auto triangle) {
        return std::ranges::any_of(triangle, [&](int v) { return near[at(v)]; });
    };
    for (int ring = 0; ring < DihedralBands::rings; ++ring) {
        std::vector<char> wider = near;
        for (const auto triangle : patch.triangles.colwise()) {
            if (!is_near(triangle)) continue;
            for (int v : triangle) wider[at(v)] = 1;
        }
        near = std::move(wider);
    }
    std::vector<Eigen::Index> kept;
    for (Eigen::Index t = 0; t < patch.triangles.cols(); ++t) {
        if (is_near(patch.triangles.col(t))) kept.push_back(t);
    }
    return patch.triangles(Eigen::all, kept);
}

// Twice the angle by which the prescribed normals lean outwards from the triangle at a border side, degrees.
double mirrored_angle(const Triangles& triangles, const Points& points, const Points& prescribed, int side) {
    const int first_fixed = static_cast<int>(points.cols() - prescribed.cols());
    const int a = side_tail(triangles, side);
    const int b = side_head(triangles, side);
    const Vector3 face = normal_of(points, triangles, side);
    const Vector3 outwards = direction((points.col(b) - points.col(a)).cross(face));
    const Vector3 normal = prescribed.col(a - first_fixed) + prescribed.col(b - first_fixed);
    return 2.0 * std::atan2(normal.dot(outwards), normal.dot(face)) * 180.0 / std::numbers::pi;
}

}  // namespace

VectorX visible_join(const JoinedMesh& given, const Indices& outline) {
    const JoinedMesh mesh{given.vertices, without_collapsed(given.inside), without_collapsed(given.outside),
                          given.before};
    DihedralBands inside(mesh.vertices, mesh.inside);
    DihedralBands outside(mesh.vertices, mesh.outside);
    Means means(mesh.vertices.cols());
    for (const OutlineEdge& edge : shared_edges(inside.edges(), outside.edges())) {
        const auto [a, b] = edge.ends;
        AngleRange usual = inside.usual(a, b);
        usual.include(outside.usual(a, b));
        if (mesh.before) usual.include(angle_at(*mesh.before, mesh, edge));
        means.add(edge.ends, usual.excess(angle_at(mesh.vertices, mesh, edge)),
                  (mesh.vertices.col(a) - mesh.vertices.col(b)).norm());
    }
    VectorX join(static_cast<Eigen::Index>(outline.size()));
    for (Eigen::Index k = 0; k < join.size(); ++k) join[k] = means[outline[at(static_cast<int>(k))]];
    return join;
}

VectorX one_sided_join(const Patch& patch, const Points& points, const Points& prescribed) {
    const Triangles triangles = beside_border(patch);
    DihedralBands bands(points, triangles);
    Means means(points.cols());
    const EdgeTable& edges = bands.edges();
    for (int e = 0; e < edges.size(); ++e) {
        if (edges.side_count(e) != 1 || !is_border(patch, edges.ends[at(e)])) continue;
        const auto [a, b] = edges.ends[at(e)];
        const double angle = mirrored_angle(triangles, points, prescribed, edges.side(e, 0));
        means.add(edges.ends[at(e)], bands.usual(a, b).excess(angle), (points.col(a) - points.col(b)).norm());
    }
    VectorX join(prescribed.cols());
    for (Eigen::Index k = 0; k < join.size(); ++k) join[k] = means[patch.free_count + k];
    return join;
}

}  // namespace fairing
