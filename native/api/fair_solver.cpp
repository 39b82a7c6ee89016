#include "api/fair_solver.h"

#include <algorithm>
#include <cstdint>

#include "api/prepared_mesh.h"

namespace fairing {

namespace {

// Of the vertices that are named, if they are numbered without great gaps; each would take memory.
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

}  // namespace fairing
