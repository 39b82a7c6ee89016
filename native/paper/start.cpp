#include "paper/start.h"

#include "operators/biharmonic_operator.h"
#include "operators/normal_operator.h"
#include "problem/surface_state.h"
#include "start/clamped_fill.h"
#include "start/globalisation.h"

namespace fairing {

namespace {

std::unique_ptr<NormalOperator> make_operator(const Problem& problem) {
    if (problem.options.equation == Equation::soap_film) return std::make_unique<LaplaceOperator>(problem.patch);
    return std::make_unique<BiharmonicOperator>(problem.patch);
}

Workspace make_workspace(const Problem& problem, const Progress& progress) {
    return {make_operator(problem),
            make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress)};
}

Points linear_start(const LevelProblem& level, const Points& fixed_points, const Progress& progress) {
    BiharmonicOperator op(level.patch);
    const Points boundary = conormals(level.patch, fixed_points, level.fixed_normals);
    const Fill fill = clamped_fill(level.patch, fixed_points, boundary, op, progress);
    Points points(3, level.patch.vertex_count());
    points << fill.flat + fill.bulge, fixed_points;
    return points;
}

}  // namespace

Points start_of_level(const LevelProblem& level, const Points& fixed_points, const Progress& progress) {
    const bool minimal = level.solver.equation == Equation::soap_film;
    const bool improved = level.paper.start == PaperStart::improved;
    if (!minimal && !improved) return linear_start(level, fixed_points, progress);
    SolverOptions options = level.solver;
    if (!minimal) options.equation = Equation::harmonic;  // the other equations are reached from its solution
    const Problem problem{level.patch, fixed_points, level.fixed_normals, uniform_weights(level.patch), options};
    Workspace work = make_workspace(problem, progress.here());
    if (minimal) {
        const Points flat = membrane(problem, work);
        return improved ? descend_area(problem, work, flat, progress) : flat;
    }
    return globalise(problem, work, best_fill(problem, work, progress.here()), progress);
}

}  // namespace fairing
