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

// Mean square of log(edge length over the mean) and of log(relative area): 0 for a mesh of equal triangles.
double unevenness(const Patch& patch, const Points& points) {
    FaceGeometry faces(points, patch.triangles);
    VectorX lengths(patch.edge_count());
    for (int e = 0; e < patch.edge_count(); ++e) {
        const auto [a, b] = patch.edge_ends[static_cast<std::size_t>(e)];
        lengths[e] = (points.col(a) - points.col(b)).norm();
    }
    const auto spread = [](const VectorX& values) {
        const double mean = std::max(values.mean(), 1e-300);
        return (values / mean).cwiseMax(1e-6).array().log().square().mean();
    };
    return spread(lengths) + spread(faces.areas);
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
    return {patch, reference};
}

Points neutral_surface(const Problem& problem, const Progress& progress) {
    const Problem uniform{problem.patch, problem.fixed_points, problem.fixed_normals, uniform_weights(problem.patch),
                          problem.options};
    Workspace work = make_workspace(uniform, progress.here());
    Points best = membrane(uniform, work);
    if (problem.options.equation == Equation::soap_film) return best;
    double least = unevenness(problem.patch, best);
    const Points boundary = conormals(problem.patch, problem.fixed_points, problem.fixed_normals);
    const Fill fill = clamped_fill(problem.patch, problem.fixed_points, boundary, *work.normal, progress.here());
    for (const double sigma : {0.0, 0.5, 1.0, 1.5, 2.2, 3.2}) {
        Points points(3, problem.patch.vertex_count());
        points << fill.flat + sigma * fill.bulge, problem.fixed_points;
        const double value = unevenness(problem.patch, points);
        if (!(value < least)) continue;
        least = value;
        best = points;
    }
    return best;
}

Points start_of_level(const LevelProblem& level, const Stiffness& stiffness, const Points& fixed_points,
                      const Progress& progress) {
    const bool minimal = level.solver.equation == Equation::soap_film;
    const bool improved = level.paper.start == PaperStart::improved;
    if (!minimal && !improved) return linear_start(level, stiffness, fixed_points, progress);
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
