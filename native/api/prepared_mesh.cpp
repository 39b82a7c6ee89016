#include "api/prepared_mesh.h"

#include <algorithm>

#include "base/background_task.h"
#include "base/errors.h"
#include "base/text.h"
#include "mesh/pieces.h"

namespace fairing {

namespace {

// Leaves out components without fixed vertices; refuses when nothing is left.
std::vector<Patch> solvable_patches(const CheckedMesh& mesh, Diagnostics& warnings) {
    std::vector<Patch> patches = make_patches(mesh.cut, mesh.roles);
    if (patches.empty()) {
        throw MeshError(
            {Code::no_free_vertices, "there is no vertex that may move: all are fixed or on the border", {}, {}, {}});
    }
    Indices closed;
    std::erase_if(patches, [&](const Patch& patch) {
        if (patch.free_count < patch.vertex_count()) return false;
        closed.insert(closed.end(), patch.to_input.begin(), patch.to_input.end());
        return true;
    });
    if (closed.empty()) return patches;
    const std::string text = "a closed component has no fixed vertices to hold it: fix some of them";
    if (patches.empty()) {
        throw MeshError(about(Code::no_boundary, text, closed, ElementKind::vertex, "closed"));
    }
    warnings.push_back(
        about(Code::no_boundary, text + "; it was left alone", closed, ElementKind::vertex, "left_alone"));
    return patches;
}

}  // namespace

std::unique_ptr<PreparedMesh> prepare(const MeshInput& input, const FairOptions& options) {
    auto prepared = std::make_unique<PreparedMesh>();
    prepared->mesh = {check_topology(input), {}, {}, {}};
    // Neither looks at what the other makes. Coordinates are complained about first.
    BackgroundTask patching([&] { prepared->patches = solvable_patches(prepared->mesh, prepared->closed_components); });
    check_geometry(input, prepared->mesh);
    prepared->finite = input.vertices.allFinite();
    patching.finish();
    prepared->mesh.cut.twins = {};  // the patches have their own rings now
    Eigen::Index triangles = 0;
    for (const Patch& patch : prepared->patches) triangles += patch.triangle_count();
    prepared->is_all_patches = triangles == prepared->mesh.cut.triangles.cols();
    prepared->solvers.reserve(prepared->patches.size());
    for (const Patch& patch : prepared->patches) prepared->solvers.emplace_back(patch, options);
    return prepared;
}

}  // namespace fairing
