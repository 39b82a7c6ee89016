#include "paper/paper_solver.h"

#include "base/stopwatch.h"
#include "paper/factorised_iteration.h"
#include "paper/start.h"

namespace fairing {

double default_epsilon(const SolverOptions& options) {
    return (options.equation == Equation::minimal ? 20.0 : 500.0) * options.tolerance;
}

Solution solve_paper(const PaperProblem& pp, const Progress& progress) {
    Stopwatch watch;
    const Problem& problem = pp.problem;
    const LevelProblem level{problem.patch,   problem.fixed_normals,
                             problem.options, pp.paper,
                             pp.weights,      pp.paper.virtual_points == VirtualPoints::everywhere};
    const Stiffness stiffness = start_stiffness(problem.patch, pp.inner_fairness, pp.reference);
    const Points start = start_of_level(level, stiffness, problem.fixed_points, progress.range(0.0, 0.1));
    Solution solution;
    solution.seconds["start"] = watch.lap();
    const double epsilon = pp.paper.epsilon > 0.0 ? pp.paper.epsilon : default_epsilon(problem.options);
    IterationOutcome outcome =
        fair_level(level, start, {epsilon, problem.options.max_iterations}, progress.range(0.1, 1.0));
    solution.points = std::move(outcome.points);
    solution.termination = outcome.termination;
    solution.iterations = outcome.iterations;
    solution.residual = outcome.residual;
    solution.initial_residual = outcome.initial_residual;
    solution.levels = {problem.patch.vertex_count()};
    solution.seconds["iteration"] = watch.lap();
    return solution;
}

}  // namespace fairing
