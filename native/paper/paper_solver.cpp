#include "paper/paper_solver.h"

#include "base/stopwatch.h"
#include "iteration/continuation.h"
#include "paper/factorised_iteration.h"
#include "paper/level_update.h"
#include "paper/prolongation.h"
#include "paper/start.h"

namespace fairing {

namespace {

class PaperSolver {
public:
    PaperSolver(const PaperProblem& pp, const Progress& progress)
        : pp_(pp), problem_(pp.problem), patch_(pp.problem.patch), options_(pp.problem.options), progress_(progress) {}

    Solution run() {
        Stopwatch watch;
        build_levels();
        solution_.seconds["hierarchy"] = watch.lap();
        points_.setZero(3, patch_.vertex_count());
        points_.rightCols(problem_.fixed_points.cols()) = problem_.fixed_points;
        const ProlongationSetting setting{patch_,   problem_.fixed_normals, pp_.reference, pp_.inner_fairness, options_,
                                          pp_.paper};
        Prolongation prolongation(hierarchy_, setting);
        for (int k = 0; k < hierarchy_.level_count(); ++k) {
            const auto [begin, end] = share(k);
            if (k > 0) prolongation.refine(k, points_, progress_.range(begin, begin + 0.1 * (end - begin)));
            solution_.seconds["prolongation"] += watch.lap();
            fair(k, progress_.range(begin + 0.1 * (end - begin), end));
            watch.lap();
        }
        return std::move(solution_);
    }

private:
    [[nodiscard]] const Patch& patch_of(int level) const {
        return hierarchy_.is_finest(level) ? patch_ : hierarchy_.patches[level];
    }

    // Uniform λ know nothing of M0: the interior given then leaves no trace in the result.
    void build_levels() {
        const bool by_reference = pp_.inner_fairness != InnerFairness::uniform;
        const bool single =
            level_sizes(patch_.free_count, patch_.vertex_count() - patch_.free_count, pp_.paper.levels).size() < 2;
        const Points positions = by_reference || single ? pp_.reference : neutral_surface(problem_, progress_.here());
        hierarchy_ = build_hierarchy(patch_, positions, pp_.paper.levels);
    }

    // Part of the progress that belongs to a level: half of what is left for the coarser ones.
    [[nodiscard]] std::pair<double, double> share(int level) const {
        const int finer = hierarchy_.level_count() - 1 - level;
        const double begin = level == 0 ? 0.0 : std::pow(0.5, finer + 1);
        return {begin, std::pow(0.5, finer)};
    }

    [[nodiscard]] Indices numbers_of(int level) const {
        if (!hierarchy_.is_finest(level)) return patch_of(level).to_input;
        Indices all(patch_.vertex_count());
        std::iota(all.begin(), all.end(), 0);
        return all;
    }

    [[nodiscard]] LevelProblem level_problem(int level, const Points& reference) const {
        const bool finest = hierarchy_.is_finest(level);
        const bool completed = pp_.paper.virtual_points == VirtualPoints::everywhere ||
                               (pp_.paper.virtual_points == VirtualPoints::coarse && !finest);
        return {patch_of(level),
                problem_.fixed_normals,
                options_,
                pp_.paper,
                finest ? pp_.weights : row_weights(patch_of(level), reference, pp_.inner_fairness),
                completed};
    }

    // Coarse levels need not be more accurate than they differ from the next finer one. Their outline is much finer
    // than they are inside, where without acceleration s above about ½ makes vertices alternate.
    [[nodiscard]] IterationLimits limits_of(int level) const {
        constexpr double coarse_damping = 0.55;  // of the caller's
        const SolverOptions& options = options_;
        const PaperOptions& paper = pp_.paper;
        if (hierarchy_.is_finest(level))
            return {paper.epsilon, options.tolerance, options.max_iterations, paper.damping};
        return {0.0, std::max(options.tolerance, start_tolerance), std::clamp(2 * options.max_iterations, 100, 400),
                paper.acceleration == Acceleration::plain ? coarse_damping * paper.damping : paper.damping};
    }

    void fair(int level, const Progress& progress) {
        Stopwatch watch;
        const Patch& patch = patch_of(level);
        const Indices numbers = numbers_of(level);
        const Points reference = pp_.reference(Eigen::all, numbers);
        const LevelProblem lp = level_problem(level, reference);
        Points start = points_(Eigen::all, numbers);
        // A coarser level that did not converge says nothing about this one.
        if (!coarser_converged_) {
            const Stiffness stiffness = start_stiffness(patch, pp_.inner_fairness, reference);
            start = start_of_level(lp, stiffness, problem_.fixed_points, progress.range(0.0, 0.1));
            start = raise_load(lp, std::move(start), progress.here());
            solution_.seconds["start"] += watch.lap();
        }
        IterationOutcome outcome = fair_level(lp, start, limits_of(level), progress.range(0.1, 1.0));
        if (hierarchy_.is_finest(level) && options_.load != problem_.options.load) confess(lp, outcome);
        solution_.seconds[hierarchy_.is_finest(level) ? "iteration" : "coarse levels"] += watch.lap();
        for (std::size_t v = 0; v < numbers.size(); ++v) {
            points_.col(numbers[v]) = outcome.points.col(static_cast<Eigen::Index>(v));
        }
        coarser_converged_ = outcome.termination == Termination::converged;
        record(level, outcome);
    }

    // The load of Δ_B H = load on the coarsest level: at once, or in steps, each from the last one's surface. What is
    // not reached here is out of reach on the finer levels too: the branch of solutions has ended.
    Points raise_load(const LevelProblem& level, Points points, const Progress& progress) {
        if (options_.equation != Equation::constant || problem_.options.load == 0.0) return points;
        const IterationLimits limits{0.0, start_tolerance, 100, limits_of(0).damping};
        const double whole = problem_.options.load;
        double reached = 0.0;
        for (double increment = 1.0; reached < 1.0 && increment >= smallest_increment;) {
            options_.load = whole * std::min(1.0, reached + increment);  // `level` looks at these options
            IterationOutcome outcome = fair_level(level, points, limits, progress);
            if (outcome.termination == Termination::converged) {
                reached += increment;
                points = std::move(outcome.points);
            } else {
                increment *= 0.5;
            }
        }
        options_.load = whole * std::min(1.0, reached);
        return points;
    }

    // The surface has less load than it should: it is measured by the whole one.
    void confess(const LevelProblem& level, IterationOutcome& outcome) const {
        const LevelProblem asked{level.patch, level.fixed_normals, problem_.options,
                                 level.paper, level.weights,       level.completed};
        outcome.residual = LevelUpdate(asked, outcome.points).measure();
        outcome.termination = Termination::stalled;
    }

    void record(int level, const IterationOutcome& outcome) {
        solution_.levels.push_back(patch_of(level).vertex_count());
        if (level == 0) solution_.initial_residual = outcome.initial_residual;
        if (!hierarchy_.is_finest(level)) return;
        solution_.points = outcome.points;
        solution_.termination = outcome.termination;
        solution_.iterations = outcome.iterations;
        solution_.residual = outcome.residual;
    }

    const PaperProblem& pp_;
    const Problem& problem_;
    const Patch& patch_;
    SolverOptions options_;  // with as much of the load as there is a solution for
    const Progress& progress_;
    bool coarser_converged_ = false;
    Hierarchy hierarchy_;
    Points points_;
    Solution solution_;
};

}  // namespace

Solution solve_paper(const PaperProblem& paper_problem, const Progress& progress) {
    return PaperSolver(paper_problem, progress).run();
}

}  // namespace fairing
