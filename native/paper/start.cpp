#include "paper/start.h"

#include <memory>

#include "solver/fill.h"
#include "solver/globalisation.h"
#include "solver/minimal_start.h"
#include "solver/willmore.h"

namespace fairing {

namespace {

std::unique_ptr<NormalOperator> make_operator(const LevelProblem& level) {
    if (level.solver.equation == Equation::minimal) return std::make_unique<LaplaceOperator>(level.patch);
    return std::make_unique<BiharmonicOperator>(level.patch);
}

Points linear_start(const LevelProblem& level, const Stiffness& stiffness, const Points& fixed_points,
                    const Progress& progress) {
    BiharmonicOperator op(level.patch);
    const Points boundary = conormals(level.patch, fixed_points, level.fixed_normals);
    const Fill fill = clamped_fill(level.patch, stiffness, fixed_points, boundary, op, progress);
    Points points(3, level.patch.vertex_count());
    points << fill.flat + fill.bulge, fixed_points;
    return points;
}

}  // namespace

Stiffness start_stiffness(const Patch& patch, InnerFairness kind, const Points& reference) {
    if (kind != InnerFairness::conformal) return uniform_stiffness(patch);
    FaceGeometry faces;
    faces.update(reference, patch.triangles);
    Stiffness stiffness;
    stiffness.update(faces, patch);
    return stiffness;
}

Points start_of_level(const LevelProblem& level, const Stiffness& stiffness, const Points& fixed_points,
                      const Progress& progress) {
    const bool minimal = level.solver.equation == Equation::minimal;
    const bool improved = level.paper.start == PaperStart::improved;
    if (!minimal && !improved) return linear_start(level, stiffness, fixed_points, progress);
    SolverOptions options = level.solver;
    if (!minimal) options.equation = Equation::harmonic;  // the other equations are reached from its solution
    const Problem problem{level.patch, fixed_points, level.fixed_normals, uniform_weights(level.patch), options};
    Workspace work{make_operator(level), TangentialStep(level.patch, problem.weights, fixed_points, progress.here())};
    if (minimal) {
        const Points flat = membrane(problem, work);
        return improved ? descend_area(problem, work, flat, progress) : flat;
    }
    return globalise(problem, work, best_fill(problem, work, progress.here()), progress);
}

}  // namespace fairing
