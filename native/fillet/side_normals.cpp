#include "fillet/side_normals.h"

#include <Eigen/Geometry>

#include "boundary/low_passed_boundary.h"
#include "boundary/surrounding_fit.h"
#include "geometry/triangle.h"
#include "mesh/edges.h"

namespace fairing {

namespace {

constexpr double plane_angle = 1e-6;  // radians: triangles of one plane, but for roundoff in single precision

}  // namespace

SideNormals::SideNormals(const SeamMesh& mesh, const std::vector<VertexPair>& parted) : mesh_(mesh) {
    const BrokenSurface broken = broken_along(mesh.triangles, static_cast<int>(mesh.points.cols()), parted);
    copies_ = broken.triangles;
    const auto count = static_cast<Eigen::Index>(broken.input_vertex.size());
    points_ = mesh.points(Eigen::all, broken.input_vertex);
    normals_ = Points::Zero(3, count);
    curvatures_ = VectorX::Constant(count, std::numeric_limits<double>::quiet_NaN());
    known_.assign(count, 0);
    fits_.assign(count, 0);
    average();
    mark_inner();
}

Vector3 SideNormals::face_normal(int triangle) const {
    const Vector3 across = area_vector(points_, copies_.col(triangle));
    const double size = across.norm();
    return size > 0.0 ? Vector3(across / size) : Vector3::Zero();
}

// By the triangles' angles, so that diagonals of quads do not matter; and which vertices are flat.
void SideNormals::average() {
    for (int h = 0; h < mesh_.half_edge_count(); ++h)
        normals_.col(copies_(h % 3, h / 3)) += mesh_.opening[h] * face_normal(h / 3);
    for (auto normal : normals_.colwise()) normal.stableNormalize();
    std::vector<char> bent(known_.size(), 0);
    for (Eigen::Index t = 0; t < copies_.cols(); ++t) {
        const Vector3 normal = face_normal(static_cast<int>(t));
        for (const int copy : copies_.col(t)) {
            if (radians_between(normal, normals_.col(copy)) > plane_angle) bent[copy] = 1;
        }
    }
    for (std::size_t v = 0; v < bent.size(); ++v) {
        known_[v] = bent[v] == 0 ? 1 : 0;
        if (known_[v] != 0) curvatures_[static_cast<Eigen::Index>(v)] = 0.0;
    }
}

void SideNormals::mark_inner() {
    const EdgeTable edges = make_edges(copies_, static_cast<int>(known_.size()));
    std::vector<char> at_end(known_.size(), 0);
    for (int e = 0; e < edges.size(); ++e) {
        if (edges.side_count(e) == 2) continue;
        for (const int v : edges.ends[e]) at_end[v] = 1;
    }
    for (Eigen::Index t = 0; t < copies_.cols(); ++t) {
        const auto corners = copies_.col(t);
        if (at_end[corners[0]] != 0 && at_end[corners[1]] != 0 && at_end[corners[2]] != 0) continue;
        for (const int copy : corners) fits_[copy] = 1;
    }
}

void SideNormals::find_at(const Indices& triangles) {
    Indices wanted;
    for (const int t : triangles) {
        for (const int copy : copies_.col(t)) {
            if (known_[copy] != 0) continue;
            known_[copy] = 1;
            if (fits_[copy] != 0) wanted.push_back(copy);
        }
    }
    if (wanted.empty()) return;
    const SurroundingNormals fitted = surrounding_normals(points_, copies_, wanted);
    for (std::size_t k = 0; k < wanted.size(); ++k) {
        if (fitted.fitted[k] == 0) continue;
        normals_.col(wanted[k]) = fitted.normals.col(static_cast<Eigen::Index>(k));
        curvatures_[wanted[k]] = fitted.curvatures[static_cast<Eigen::Index>(k)];
    }
}

Vector3 SideNormals::normal(int triangle, const Vector3& weights) const {
    Vector3 sum = Vector3::Zero();
    for (int k = 0; k < 3; ++k) sum += weights[k] * normals_.col(copies_(k, triangle));
    const double size = sum.norm();
    return size > 0.0 ? Vector3(sum / size) : Vector3::Zero();
}

double SideNormals::curvature(int triangle, const Vector3& weights) const {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        if (weights[k] != 0.0) sum += weights[k] * curvatures_[copies_(k, triangle)];
    }
    return std::isfinite(sum) ? sum : -0.5 * divergence(triangle);
}

// The derivative of the normals interpolated over a triangle: gradients of its hat functions times them.
double SideNormals::divergence(int triangle) const {
    const Vector3 normal = face_normal(triangle);
    double sum = 0.0;
    double twice_area = 0.0;
    for (int k = 0; k < 3; ++k) {
        const Vector3 from = points_.col(copies_((k + 1) % 3, triangle));
        const Vector3 to = points_.col(copies_((k + 2) % 3, triangle));
        const Vector3 own = points_.col(copies_(k, triangle));
        twice_area = (to - from).cross(own - from).norm();
        sum += normal.cross(to - from).dot(normals_.col(copies_(k, triangle)));
    }
    return sum / twice_area;
}

}  // namespace fairing
