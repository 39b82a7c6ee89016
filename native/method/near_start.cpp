#include "method/near_start.h"

#include <algorithm>

#include "base/errors.h"
#include "base/stopwatch.h"
#include "geometry/surface_fit.h"
#include "iteration/continuation.h"
#include "method/accept.h"
#include "operators/workspace.h"

namespace fairing {

namespace {

constexpr int most_iterations = 20;
constexpr int patience = 6;

class NoStep : public TangentialStep {
public:
    explicit NoStep(const Points& points) : points_(points) {}
    void hold(const Points& /*fixed_points*/) override {}
    [[nodiscard]] Points harmonic_positions() const override { return points_; }
    [[nodiscard]] double merit(const Points& /*points*/, const Points& /*normals*/) const override { return 0.0; }
    [[nodiscard]] Points displacement(const Points& /*points*/, const Points& /*normals*/,
                                      int /*max_cycles*/) const override {
        return Points::Zero(3, points_.cols());
    }

private:
    Points points_;  // 3 × free count
};

}  // namespace

std::optional<Solution> solve_near(const Problem& problem, const NearStart& start, const Progress& progress) {
    const Stopwatch watch;
    Problem attempt = problem;
    attempt.options.max_iterations = std::min(most_iterations, problem.options.max_iterations);
    attempt.options.patience = patience;
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
    solution.flaw = flaw_of(problem, solution);
    if (solution.flaw != Flaw::absent) return std::nullopt;
    solution.seconds = {{"iteration", watch.seconds()}};
    solution.ways = {{"near", watch.seconds()}};
    return solution;
}

}  // namespace fairing
