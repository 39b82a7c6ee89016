#include "api/fair_solver.h"

#include <cstdint>

#include "base/background_task.h"
#include "base/errors.h"
#include "mesh/pieces.h"

namespace fairing {

namespace {

// The number of vertices named, if they are numbered without great gaps; each would take memory.
std::optional<int> vertex_count(const MeshInput& input) {
    constexpr std::int64_t widest_gap = 100;  // numbers for each that is named
    std::int64_t last = input.triangles.size() > 0 ? input.triangles.maxCoeff() : -1;
    std::int64_t named = input.triangles.size();
    if (input.fixed && !input.fixed->empty()) {
        last = std::max<std::int64_t>(last, *std::max_element(input.fixed->begin(), input.fixed->end()));
        named += static_cast<std::int64_t>(input.fixed->size());
    }
    if (last >= widest_gap * (named + 1)) return std::nullopt;
    return static_cast<int>(last + 1);
}

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
    const std::string text = "a closed component has no vertices to hold it: put some in `fixed`";
    if (patches.empty()) {
        throw MeshError(about(Code::no_boundary, text, closed, ElementKind::vertex, "closed"));
    }
    warnings.push_back(
        about(Code::no_boundary, text + "; it was left alone", closed, ElementKind::vertex, "left_alone"));
    return patches;
}

}  // namespace

FairSolver::FairSolver(Triangles triangles, std::optional<Indices> fixed, HeldInside held, FairOptions options)
    : input_{vertices_, std::move(triangles), std::move(fixed), {}, {}, Triangles(3, 0), std::move(held)},
      options_(std::move(options)) {
    options_.repeated = true;
    const auto count = vertex_count(input_);
    if (!count) return;
    vertices_ = Points::Zero(3, *count);  // connectivity is the same for any
    input_.vertices = vertices_;
    prepared_ = prepare(input_, options_);
}

FairSolver::~FairSolver() = default;

void FairSolver::change(FairOptions options) {
    options_ = std::move(options);
    options_.repeated = true;
    if (!prepared_) return;
    for (ComponentSolver& solver : prepared_->solvers) solver.options_changed();
}

FairResult FairSolver::solve(Points vertices, std::optional<Points> fixed_normals,
                             std::optional<VectorX> fixed_curvatures, const std::optional<View<Points>>& reference,
                             const ProgressCallback& progress, const Preview& preview) {
    vertices_ = std::move(vertices);
    input_.vertices = vertices_;
    input_.fixed_normals = std::move(fixed_normals);
    input_.fixed_curvatures = std::move(fixed_curvatures);
    return run_call(input_, reference, options_, prepared_, progress, preview);
}

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
