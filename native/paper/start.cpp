#include "paper/start.h"

#include "operators/normal_operator.h"
#include "problem/surface_state.h"
#include "start/clamped_fill.h"
#include "start/globalisation.h"

namespace fairing {

namespace {

Workspace make_workspace(const Problem& problem, const Progress& progress) {
    return {make_normal_operator(problem),
            make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress)};
}

}  // namespace

Points start_of_level(const LevelProblem& level, const Points& fixed_points, const Progress& progress) {
    const bool minimal = level.solver.equation == Equation::soap_film;
    SolverOptions options = level.solver;
    if (!minimal) options.equation = Equation::harmonic;  // the other equations are reached from its solution
    const Problem problem{level.patch, fixed_points, level.fixed_normals, uniform_weights(level.patch), options};
    Workspace work = make_workspace(problem, progress.here());
    if (minimal) return descend_area(problem, work, membrane(problem, work), progress);
    return globalise(problem, work, best_fill(problem, work, progress.here()), progress);
}

}  // namespace fairing
