#include "paper/hierarchy.h"

#include "mesh/pieces.h"
#include "mesh/surface_mesh.h"
#include "paper/collapse_module.h"

namespace fairing {

namespace {

constexpr int smallest_base = 40;  // free vertices
constexpr double growth = 4.0;     // of vertices from level to level

// A copy of the patch's half-edge mesh with positions, status flags, and the fixed vertices locked.
SurfaceMesh decimation_mesh(const Patch& patch, const Points& positions) {
    SurfaceMesh mesh = surface_mesh(patch);
    mesh.request_vertex_status();
    mesh.request_halfedge_status();
    mesh.request_edge_status();
    mesh.request_face_status();
    for (const auto v : mesh.vertices()) {
        mesh.set_point(v, positions.col(v.idx()));
        mesh.status(v).set_locked(!patch.is_free(v.idx()));
    }
    return mesh;
}

// The level's connectivity as a patch whose input vertices are those of the fine one.
Patch level_patch(const Patch& fine, const Triangles& triangles) {
    const auto count = fine.vertex_count();
    CutMesh cut;
    cut.triangles = triangles;
    cut.input_vertex.resize(count);
    std::iota(cut.input_vertex.begin(), cut.input_vertex.end(), 0);
    cut.input_triangle.resize(static_cast<int>(triangles.cols()));
    std::iota(cut.input_triangle.begin(), cut.input_triangle.end(), 0);
    cut.piece.assign(cut.input_triangle.size(), 0);
    cut.piece_count = 1;
    VertexRoles roles;
    roles.pin = fine.pin;
    roles.fixed.assign(count, 1);
    std::fill_n(roles.fixed.begin(), fine.free_count, 0);
    return Pieces(cut, roles).patch(0);
}

}  // namespace

Indices level_sizes(int free_count, int fixed_count, int levels) {
    const int base = std::min(free_count, std::max(smallest_base, fixed_count));
    const double ratio = static_cast<double>(free_count) / base;
    if (levels == 0) levels = 1 + static_cast<int>(std::lround(std::log(ratio) / std::log(growth)));
    if (ratio < 1.5) levels = 1;
    Indices sizes;
    for (int k = 0; k < levels; ++k) {
        const double share = levels == 1 ? 1.0 : static_cast<double>(k) / (levels - 1);
        sizes.push_back(static_cast<int>(std::lround(base * std::pow(ratio, share))));
    }
    return sizes;
}

Hierarchy build_hierarchy(const Patch& patch, const Points& positions, int levels) {
    const Indices sizes = level_sizes(patch.free_count, patch.vertex_count() - patch.free_count, levels);
    Hierarchy hierarchy;
    hierarchy.collapsed.push_back(0);
    if (sizes.size() < 2) return hierarchy;

    SurfaceMesh mesh = decimation_mesh(patch, positions);
    OpenMesh::Decimater::DecimaterT<SurfaceMesh> decimater(mesh);
    CollapseModule::Handle handle;
    decimater.add(handle);
    CollapseModule& module = decimater.module(handle);
    std::vector<std::size_t> counts;
    for (std::size_t k = sizes.size() - 1; k-- > 0;) counts.push_back(patch.free_count - sizes[k]);
    const std::size_t most = counts.back();
    module.note_at(std::move(counts));
    decimater.initialize();
    const std::size_t made = decimater.decimate(most);
    // The last level is noted at the end: also where vetoes have stopped the collapses before their time.
    if (made > 0 && (module.levels().empty() || module.levels().back().collapsed < made)) module.note_level();
    hierarchy.collapses = module.take_collapses();
    for (const auto& level : module.levels()) {
        hierarchy.patches.insert(hierarchy.patches.begin(), level_patch(patch, level.triangles));
        hierarchy.collapsed.insert(hierarchy.collapsed.begin(), level.collapsed);
    }
    return hierarchy;
}

}  // namespace fairing
