#include "paper/collapse_module.h"

namespace fairing {

// An edge between two fixed vertices would be a straight chord through the surface.
bool CollapseModule::joins_fixed(const CollapseInfo& info) {
    SurfaceMesh& mesh = info.mesh;
    if (!mesh.status(info.v1).locked()) return false;
    for (const auto v : mesh.vv_range(info.v0)) {
        if (v != info.v1 && v != info.vl && v != info.vr && mesh.status(v).locked()) return true;
    }
    return false;
}

float CollapseModule::collapse_priority(const CollapseInfo& info) {
    constexpr auto illegal = static_cast<float>(Base::ILLEGAL_COLLAPSE);  // OpenMesh's own number
    if (joins_fixed(info)) return illegal;
    if (fan_vertex_ != info.v0.idx() || fan_made_ != collapses_.size()) look_at(info);
    const double priority = fan_.priority(info.p1);
    return priority < 0.0 ? illegal : static_cast<float>(priority);
}

void CollapseModule::look_at(const CollapseInfo& info) {
    const SurfaceMesh& mesh = info.mesh;
    fan_vertex_ = info.v0.idx();
    fan_made_ = collapses_.size();
    fan_.start(info.p0);
    for (const auto v : mesh.vv_ccw_range(info.v0)) fan_.add(mesh.point(v));
    fan_.close();
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
