#include "paper/paper_solver.h"

#include "base/stopwatch.h"
#include "multigrid/coarsening.h"
#include "paper/factorised_iteration.h"
#include "paper/level_update.h"
#include "problem/surface_state.h"
#include "start/clamped_fill.h"
#include "start/globalisation.h"

namespace fairing {

namespace {

// Positions of the level's vertices (3 × level vertices) from connectivity and boundary data alone: the clamped
// bilaplacian's bulge of least Willmore energy, made fair by mixed finite elements; for minimal surfaces the membrane,
// with descent of its area.
Points start_of_level(const LevelProblem& level, const Points& fixed_points, const Progress& progress) {
    const bool minimal = level.solver.equation == Equation::soap_film;
    const Problem problem{level.patch, fixed_points, level.fixed_normals, uniform_weights(level.patch), level.solver};
    Workspace work{make_normal_operator(problem),
                   make_tangential_step(problem.patch, problem.weights, fixed_points, progress.here())};
    if (minimal) return descend_area(problem, work, membrane(problem, work), progress);
    return globalise(problem, work, best_fill(problem, work, progress.here()), progress);
}

class PaperSolver {
public:
    PaperSolver(const Problem& problem, const PaperOptions& paper, const Progress& progress)
        : problem_(problem), paper_(paper), options_(problem.options), progress_(progress) {}

    Solution run() {
        Stopwatch watch;
        const auto coarsened = [&](const InnerWeights& edges) { return coarsen(problem_.patch, edges); };
        if (options_.nested) coarser_ = with_edges(problem_.patch, problem_.weights, coarsened);
        if (paper_.levels > 0 && coarser_.size() >= static_cast<std::size_t>(paper_.levels))
            coarser_.erase(coarser_.begin() + paper_.levels - 1, coarser_.end());
        solution_.seconds["hierarchy"] = watch.lap();
        for (auto k = static_cast<int>(coarser_.size()); k >= 0; --k) {
            const auto [begin, end] = share(k);
            points_ = k < static_cast<int>(coarser_.size()) ? refined(k) : on_boundary(k);
            solution_.seconds["prolongation"] += watch.lap();
            fair(k, progress_.range(begin, end));
            watch.lap();
        }
        return std::move(solution_);
    }

private:
    // 0: the patch itself.
    [[nodiscard]] const Patch& patch_of(int level) const {
        return level == 0 ? problem_.patch : coarser_[static_cast<std::size_t>(level) - 1].patch;
    }

    [[nodiscard]] Points on_boundary(int level) const {
        Points points = Points::Zero(3, patch_of(level).vertex_count());
        points.rightCols(problem_.fixed_points.cols()) = problem_.fixed_points;
        return points;
    }

    // The coarser surface, lifted (multigrid/transfer).
    [[nodiscard]] Points refined(int level) const {
        const BentPoints coarse{points_, max_normals(patch_of(level + 1), points_, problem_.fixed_normals), {}};
        Points normals = Points::Zero(3, patch_of(level).vertex_count());
        normals.rightCols(problem_.fixed_normals.cols()) = problem_.fixed_normals;
        BentPoints fine{on_boundary(level), std::move(normals), {}};
        coarser_[static_cast<std::size_t>(level)].transfer.prolong_surface(coarse, patch_of(level).free_count, fine);
        return std::move(fine.points);
    }

    // Part of the progress that belongs to a level: half of what is left for the coarser ones.
    [[nodiscard]] std::pair<double, double> share(int level) const {
        const bool coarsest = level == static_cast<int>(coarser_.size());
        return {coarsest ? 0.0 : std::pow(0.5, level + 1), std::pow(0.5, level)};
    }

    [[nodiscard]] LevelProblem level_problem(int level) const {
        const Patch& patch = patch_of(level);
        const auto made = [&](const InnerWeights& edges) { return RingMatrix(patch.vertex_count(), edges); };
        return {patch, problem_.fixed_normals, options_, paper_,
                level == 0 ? with_edges(patch, problem_.weights, made)
                           : made(coarser_[static_cast<std::size_t>(level) - 1].weights)};
    }

    // Coarse levels need not be more accurate than they differ from the next finer one. Their boundary is much finer
    // than they are inside, where without acceleration s above about ½ makes vertices alternate.
    [[nodiscard]] IterationLimits limits_of(int level) const {
        constexpr double coarse_damping = 0.55;  // of the caller's
        if (level == 0) return {options_.tolerance, options_.max_iterations, paper_.damping};
        return {std::max(options_.tolerance, start_tolerance), std::clamp(2 * options_.max_iterations, 100, 400),
                paper_.acceleration == Acceleration::plain ? coarse_damping * paper_.damping : paper_.damping};
    }

    void fair(int level, const Progress& progress) {
        Stopwatch watch;
        const LevelProblem lp = level_problem(level);
        // A coarser level that did not converge says nothing about this one.
        if (!coarser_converged_) {
            points_ = start_of_level(lp, problem_.fixed_points, progress.range(0.0, 0.1));
            solution_.seconds["start"] += watch.lap();
        }
        IterationOutcome outcome = fair_level(lp, points_, limits_of(level), progress.range(0.1, 1.0));
        solution_.seconds[level == 0 ? "iteration" : "coarse levels"] += watch.lap();
        coarser_converged_ = outcome.termination == Termination::converged;
        points_ = outcome.points;
        record(level, outcome);
    }

    void record(int level, const IterationOutcome& outcome) {
        solution_.levels.push_back(patch_of(level).vertex_count());
        if (solution_.levels.size() == 1) solution_.initial_residual = outcome.initial_residual;
        if (level > 0) return;
        solution_.points = outcome.points;
        solution_.termination = outcome.termination;
        solution_.iterations = outcome.iterations;
        solution_.residual = outcome.residual;
    }

    const Problem& problem_;
    const PaperOptions& paper_;
    const SolverOptions& options_;
    const Progress& progress_;
    bool coarser_converged_ = false;
    std::vector<CoarseLevel> coarser_;  // fine to coarse
    Points points_;                     // of the level at hand
    Solution solution_;
};

}  // namespace

Solution solve_paper(const Problem& problem, const PaperOptions& paper, const Progress& progress) {
    return PaperSolver(problem, paper, progress).run();
}

}  // namespace fairing
