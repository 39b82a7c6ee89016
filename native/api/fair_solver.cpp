#include "api/fair_solver.h"

#include "api/prepared_mesh.h"

namespace fairing {

FairSolver::FairSolver(Triangles triangles, std::optional<Indices> fixed, FairOptions options)
    : input_{{}, std::move(triangles), std::move(fixed), {}},
      options_(std::make_unique<CallOptions>(std::move(options), true)) {}

FairSolver::~FairSolver() = default;

void FairSolver::change(FairOptions options) {
    *options_ = CallOptions(std::move(options), true);
    if (!prepared_) return;
    for (ComponentSolver& solver : prepared_->solvers) solver.options_changed();
}

FairResult FairSolver::solve(Points vertices, std::optional<Points> fixed_normals,
                             const std::optional<Points>& reference, const ProgressCallback& progress) {
    input_.vertices = std::move(vertices);
    input_.fixed_normals = std::move(fixed_normals);
    return run_call(input_, reference, *options_, prepared_, progress);
}

}  // namespace fairing
