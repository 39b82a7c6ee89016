#include "solver/global_solver.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "solver/anderson.h"
#include "solver/fill.h"
#include "solver/mixed_curvature.h"
#include "solver/normal_operator.h"
#include "solver/surface_state.h"
#include "solver/tangential_step.h"

namespace fairing {

static const bool trace = std::getenv("TRACE") != nullptr;

namespace {

double largest_column(const Points& field) { return std::sqrt(field.colwise().squaredNorm().maxCoeff()); }

class HarmonicSolver {
public:
    HarmonicSolver(const Problem& problem, const Progress& progress)
        : problem_(problem),
          patch_(problem.patch),
          progress_(progress),
          op_(problem.patch),
          tangential_(problem.patch, problem.weights, problem.fixed_points),
          conormals_(conormals(problem.patch, problem.fixed_points, problem.fixed_normals)) {}

    Solution run() {
        start();
        globalise(false, 12, 2e-2);
        globalise(true, 15, 2e-3);
        polish();
        return solution_;
    }

private:
    void start() {
        const Fill fill = clamped_fill(patch_, problem_.fixed_points, conormals_, op_);
        state_.points.resize(3, patch_.vertex_count());
        state_.points.rightCols(problem_.fixed_points.cols()) = problem_.fixed_points;
        double best = INFINITY;
        Points best_points;
        for (double sigma : {1.0, 1.5, 2.2, 3.2, 4.5}) {
            state_.points.leftCols(patch_.free_count) = fill.flat + sigma * fill.bulge;
            state_.measure_faces(patch_);
            const double E = willmore_energy(
                mixed_curvature_vectors(patch_, state_.stiffness, state_.points, conormals_), state_.stiffness);
            if (trace) std::fprintf(stderr, "fill sigma %g E %g\n", sigma, E);
            if (E < best) { best = E; best_points = state_.points; }
        }
        state_.points = best_points;
        state_.measure_faces(patch_);
        state_.measure_curvature(problem_);
        solution_.initial_residual = largest_residual(problem_, state_, outer_residual(problem_, state_));
    }

    void move(const Points& displacement, double limit) {
        const double largest = largest_column(displacement);
        const double scale = largest > limit ? limit / largest : 1.0;
        state_.points.leftCols(patch_.free_count) += scale * displacement;
    }

    void globalise(bool tangential, int steps, double threshold) {
        for (int k = 0; k < steps; ++k) {
            progress_.report(0.1, "globalise");
            state_.measure_faces(patch_);
            state_.normals = max_normals(patch_, state_.points, problem_.fixed_normals);
            const Points h = mixed_curvature_vectors(patch_, state_.stiffness, state_.points, conormals_);
            state_.mean_curvature = mixed_mean_curvature(h, state_.stiffness, state_.normals);
            const VectorX r = outer_residual(problem_, state_);
            op_.update(state_.stiffness);
            const VectorX u = op_.solve(r);
            Points d = state_.normals.leftCols(patch_.free_count).array().rowwise() * u.transpose().array();
            double t = 0;
            if (tangential) {
                const Points dt = tangential_.displacement(state_.points, state_.normals);
                t = largest_column(dt);
                d += dt;
            }
            if (trace) std::fprintf(stderr, "mixed %d %d E %g u %g t %g\n", tangential, k, willmore_energy(h, state_.stiffness), u.cwiseAbs().maxCoeff(), t);
            move(d, 0.25);
            if (largest_column(d) < threshold) break;
        }
    }

    void polish() {
        Anderson anderson(3 * patch_.free_count, 6);
        double best = INFINITY;
        Points best_points;
        for (int k = 0; k < problem_.options.max_iterations; ++k) {
            progress_.report(0.5, "solve");
            state_.measure_faces(patch_);
            state_.measure_curvature(problem_);
            const VectorX r = outer_residual(problem_, state_);
            const double residual = largest_residual(problem_, state_, r);
            if (residual < best) { best = residual; best_points = state_.points; solution_.mean_curvature = state_.mean_curvature; }
            if (k == 0) op_.update(state_.stiffness);
            const VectorX u = op_.solve(r);
            Points d = state_.normals.leftCols(patch_.free_count).array().rowwise() * u.transpose().array();
            const Points dt = tangential_.displacement(state_.points, state_.normals);
            d += dt;
            Eigen::Map<const VectorX> x(state_.points.data(), 3 * patch_.free_count);
            Eigen::Map<const VectorX> f(d.data(), 3 * patch_.free_count);
            const VectorX step = anderson.step(x, f);
            if (trace) std::fprintf(stderr, "Q %d res %g u %g t %g step %g\n", k, residual, u.cwiseAbs().maxCoeff(), largest_column(dt), step.cwiseAbs().maxCoeff());
            solution_.iterations = k + 1;
            if (largest_column(d) < problem_.options.tolerance) { solution_.termination = Termination::converged; break; }
            move(Eigen::Map<const Points>(step.data(), 3, patch_.free_count), 0.1);
        }
        solution_.points = solution_.termination == Termination::converged ? state_.points : best_points;
        solution_.residual = best;
    }

    const Problem& problem_;
    const Patch& patch_;
    const Progress& progress_;
    BiharmonicOperator op_;
    TangentialStep tangential_;
    Points conormals_;
    SurfaceState state_;
    Solution solution_;
};

}  // namespace

Solution solve_global(const Problem& problem, const Progress& progress) {
    return HarmonicSolver(problem, progress).run();
}

}  // namespace fairing
