#include "paper/collapse_module.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

namespace fairing {

namespace {

// Inner radius over longest edge, relative to that of an equilateral triangle, which is 1/(2 √3).
constexpr double worst_shape = 0.25;
// Cosine between the normals of a triangle before and after.
constexpr double widest_turn = 0.3;

// Of a triangle with twice this area and these sides: 1 equilateral, 0 degenerate.
double roundness(double twice_area, double a, double b, double c) {
    constexpr double smallest = std::numeric_limits<double>::min();
    return 2.0 * std::numbers::sqrt3 * twice_area / std::max((a + b + c) * std::max({a, b, c}), smallest);
}

}  // namespace

bool keeps_topology(const DecimationInfo& info) {
    const SurfaceMesh& mesh = info.mesh;
    if (mesh.status(info.v0).locked() || mesh.status(info.v0v1).deleted()) return false;
    if (info.vl == info.vr || !info.vl.is_valid() || !info.vr.is_valid()) return false;
    for (const auto a : mesh.vv_range(info.v0)) {
        if (a == info.v1 || a == info.vl || a == info.vr) continue;
        for (const auto b : mesh.vv_range(info.v1)) {
            if (a == b) return false;
        }
    }
    return true;
}

// An edge between two fixed vertices would be a straight chord through the surface.
bool CollapseModule::joins_fixed(const CollapseInfo& info) {
    SurfaceMesh& mesh = info.mesh;
    if (!mesh.status(info.v1).locked()) return false;
    for (const auto v : mesh.vv_range(info.v0)) {
        if (v != info.v1 && v != info.vl && v != info.vr && mesh.status(v).locked()) return true;
    }
    return false;
}

void CollapseModule::look_at(const CollapseInfo& info) {
    if (fan_.vertex == info.v0.idx() && fan_.made == collapses_.size()) return;
    const SurfaceMesh& mesh = info.mesh;
    fan_.vertex = info.v0.idx();
    fan_.made = collapses_.size();
    fan_.worst = 1.0;
    fan_.best_priority = std::numeric_limits<double>::infinity();
    fan_.points.clear();
    fan_.rim.clear();
    fan_.normals.clear();
    for (const auto v : mesh.vv_ccw_range(info.v0)) fan_.points.push_back(mesh.point(v));
    const std::size_t m = fan_.points.size();
    fan_.from_target.resize(m);
    for (std::size_t k = 0; k < m; ++k) {
        const Vector3 a = fan_.points[k] - info.p0;
        const Vector3 b = fan_.points[k + 1 < m ? k + 1 : 0] - info.p0;
        const Vector3 cross = a.cross(b);
        const double twice_area = cross.norm();
        fan_.rim.push_back((b - a).norm());
        fan_.normals.emplace_back(cross / std::max(twice_area, std::numeric_limits<double>::min()));
        fan_.worst = std::min(fan_.worst, roundness(twice_area, a.norm(), b.norm(), fan_.rim.back()));
    }
}

double CollapseModule::worst_after(const Vector3& target, double length) {
    const std::size_t m = fan_.points.size();
    for (std::size_t k = 0; k < m; ++k) fan_.from_target[k] = (fan_.points[k] - target).norm();
    double worst = 1.0;
    for (std::size_t k = 0; k < m; ++k) {
        const std::size_t next = k + 1 < m ? k + 1 : 0;
        // The two triangles at the target vanish.
        if (fan_.from_target[k] == 0.0 || fan_.from_target[next] == 0.0) continue;
        const Vector3 cross = (fan_.points[k] - target).cross(fan_.points[next] - target);
        const double twice_area = cross.norm();
        if (fan_.normals[k].dot(cross) < widest_turn * twice_area) return -1.0;
        worst = std::min(worst, roundness(twice_area, fan_.from_target[k], fan_.from_target[next], fan_.rim[k]));
        // Where triangles are bad already, the collapse need only not make them worse.
        if (worst < std::min(worst_shape, fan_.worst) || length * (1.5 - worst) >= fan_.best_priority) return -1.0;
    }
    return worst;
}

float CollapseModule::collapse_priority(const CollapseInfo& info) {
    constexpr auto illegal = static_cast<float>(Base::ILLEGAL_COLLAPSE);
    if (joins_fixed(info)) return illegal;
    look_at(info);
    const double length = (info.p1 - info.p0).norm();
    const double worst = worst_after(info.p1, length);
    if (worst < 0.0) return illegal;
    fan_.best_priority = length * (1.5 - worst);
    return static_cast<float>(fan_.best_priority);
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
