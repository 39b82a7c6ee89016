#include "paper/collapse_module.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace fairing {

namespace {

// Inner radius over longest edge of an equilateral triangle is 1/(2 √3); shapes are told relative to it.
constexpr double worst_shape = 0.25;
// Cosine between the normals of a triangle before and after.
constexpr double widest_turn = 0.3;

struct Shape {
    double roundness;  // 1 equilateral, 0 degenerate
    Vector3 normal;    // not normalised
};

Shape shape_of(const Vector3& a, const Vector3& b, const Vector3& c) {
    const Vector3 normal = (b - a).cross(c - a);
    const double ab = (b - a).norm();
    const double bc = (c - b).norm();
    const double ca = (a - c).norm();
    const double radius = normal.norm() / std::max(ab + bc + ca, std::numeric_limits<double>::min());
    const double longest = std::max({ab, bc, ca, std::numeric_limits<double>::min()});
    return {2.0 * std::sqrt(3.0) * radius / longest, normal};
}

bool turns_over(const Vector3& before, const Vector3& after) {
    return before.dot(after) < widest_turn * before.norm() * after.norm();
}

}  // namespace

// An edge between two fixed vertices would be a straight chord through the surface.
bool CollapseModule::joins_fixed(const CollapseInfo& info) const {
    SurfaceMesh& mesh = info.mesh;
    if (!mesh.status(info.v1).locked()) return false;
    for (const auto v : mesh.vv_range(info.v0)) {
        if (v != info.v1 && v != info.vl && v != info.vr && mesh.status(v).locked()) return true;
    }
    return false;
}

float CollapseModule::collapse_priority(const CollapseInfo& info) {
    if (joins_fixed(info)) return float(Base::ILLEGAL_COLLAPSE);
    SurfaceMesh& mesh = info.mesh;
    double worst_before = 1.0;
    double worst_after = 1.0;
    for (const auto h : mesh.voh_range(info.v0)) {
        if (mesh.is_boundary(h)) continue;
        const auto a = mesh.to_vertex_handle(h);
        const auto b = mesh.to_vertex_handle(mesh.next_halfedge_handle(h));
        const Shape before = shape_of(info.p0, mesh.point(a), mesh.point(b));
        worst_before = std::min(worst_before, before.roundness);
        if (a == info.v1 || b == info.v1) continue;
        const Shape after = shape_of(info.p1, mesh.point(a), mesh.point(b));
        if (turns_over(before.normal, after.normal)) return float(Base::ILLEGAL_COLLAPSE);
        worst_after = std::min(worst_after, after.roundness);
    }
    // Where triangles are bad already, the collapse need only not make them worse.
    if (worst_after < std::min(worst_shape, worst_before)) return float(Base::ILLEGAL_COLLAPSE);
    return static_cast<float>((info.p1 - info.p0).norm() * (1.5 - worst_after));
}

void CollapseModule::preprocess_collapse(const CollapseInfo& info) {
    if (levels_.size() < counts_.size() && collapses_.size() == counts_[levels_.size()]) note_level();
    collapses_.push_back({info.v0.idx(), info.v1.idx(), info.vl.idx(), info.vr.idx()});
}

void CollapseModule::note_level() {
    const SurfaceMesh& mesh = Base::mesh();
    NotedLevel level{collapses_.size(), {}};
    std::vector<int> corners;
    for (const auto f : mesh.faces()) {  // skips deleted ones
        for (const auto v : mesh.fv_range(f)) corners.push_back(v.idx());
    }
    level.triangles = Eigen::Map<const Triangles>(corners.data(), 3, static_cast<Eigen::Index>(corners.size() / 3));
    levels_.push_back(std::move(level));
}

}  // namespace fairing
