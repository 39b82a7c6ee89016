#include "reuse/near_start.h"

#include <algorithm>

#include "accept/accept.h"
#include "base/errors.h"
#include "base/stopwatch.h"
#include "geometry/surface_fit.h"
#include "iteration/continuation.h"
#include "operators/workspace.h"
#include "variation/least_variation.h"

namespace fairing {

namespace {

class NoStep : public TangentialStep {
public:
    explicit NoStep(const Points& points) : points_(points) {}
    void hold(const Points& /*fixed_points*/) override {}
    [[nodiscard]] Points harmonic_positions() const override { return points_; }
    [[nodiscard]] double merit(const Points& /*points*/, const Points& /*normals*/) const override { return 0.0; }
    using TangentialStep::displacement;
    [[nodiscard]] double imbalance(const Points& /*points*/, const Points& /*normals*/) const override { return 0.0; }
    [[nodiscard]] Points displacement(const Points& /*points*/, const TangentPlanes& /*planes*/,
                                      Effort /*effort*/) const override {
        return Points::Zero(3, points_.cols());
    }

private:
    Points points_;  // 3 × free count
};

std::optional<Solution> accepted(const Problem& problem, Solution solution, const WayTaken& way) {
    if (solution.termination != Termination::converged) return std::nullopt;
    solution.flaw = flaw_of(problem, solution);
    if (solution.flaw != Flaw::absent) return std::nullopt;
    solution.ways = {way};
    return solution;
}

// On a mesh of its own.
std::optional<Solution> vary_least_near(const Problem& problem, const Points& points, const Progress& progress) {
    const Stopwatch watch;
    VariationLimits limits;
    limits.near = NearVariation{points, false};
    std::optional<Solution> solution;
    try {
        solution = solve_less_varying(problem, limits, progress);
    } catch (const SolverError&) {
        return std::nullopt;
    }
    return solution ? accepted(problem, std::move(*solution), {"variation", watch.seconds()}) : std::nullopt;
}

}  // namespace

std::optional<Solution> solve_near(const Problem& problem, const NearStart& start, const Progress& progress) {
    if (problem.options.equation == Equation::least_variation) return vary_least_near(problem, start.points, progress);
    const Stopwatch watch;
    Problem attempt = problem;
    attempt.conduct.limits = nearby;
    const Points free_points = start.points.leftCols(problem.patch.free_count);
    Workspace work{make_normal_operator(attempt, free_points), nullptr};
    if (start.settled) {
        work.tangential = std::make_unique<NoStep>(free_points);
    } else {
        work.tangential = make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress.here());
    }
    Solution solution;
    try {
        solution = solve_equation(attempt, work, start.points, progress);
    } catch (const SolverError&) {
        return std::nullopt;  // a start without a factor: the other ways don't need it
    }
    if (solution.termination != Termination::converged) return std::nullopt;
    solution.boundary_normals = one_sided_normals(problem.patch, solution.points);
    solution.seconds = {{"iteration", watch.seconds()}};
    return accepted(problem, std::move(solution), {"near", watch.seconds()});
}

}  // namespace fairing
