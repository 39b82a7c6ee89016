#include "paper/paper_solver.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/stopwatch.h"
#include "paper/factorised_iteration.h"
#include "paper/prolongation.h"
#include "paper/start.h"

namespace fairing {

namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

class PaperSolver {
public:
    PaperSolver(const PaperProblem& pp, const Progress& progress)
        : pp_(pp), problem_(pp.problem), patch_(pp.problem.patch), progress_(progress) {}

    Solution run() {
        Stopwatch watch;
        build_levels();
        solution_.seconds["hierarchy"] = watch.lap();
        points_.setZero(3, patch_.vertex_count());
        points_.rightCols(problem_.fixed_points.cols()) = problem_.fixed_points;
        const ProlongationSetting setting{
            patch_, problem_.fixed_normals, pp_.reference, pp_.inner_fairness, problem_.options, pp_.paper};
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
        return hierarchy_.is_finest(level) ? patch_ : hierarchy_.patches[at(level)];
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
        Indices all(at(patch_.vertex_count()));
        std::iota(all.begin(), all.end(), 0);
        return all;
    }

    [[nodiscard]] LevelProblem level_problem(int level, const Points& reference) const {
        const bool finest = hierarchy_.is_finest(level);
        const bool completed = pp_.paper.virtual_points == VirtualPoints::everywhere ||
                               (pp_.paper.virtual_points == VirtualPoints::coarse && !finest);
        return {patch_of(level),
                problem_.fixed_normals,
                problem_.options,
                pp_.paper,
                finest ? pp_.weights : row_weights(patch_of(level), reference, pp_.inner_fairness),
                completed};
    }

    // Coarse levels need not be more accurate than they differ from the next finer one. Their outline is much finer
    // than they are inside, where larger s than about ½ makes vertices alternate.
    [[nodiscard]] IterationLimits limits_of(int level) const {
        constexpr double coarse_epsilon = 1.0;
        constexpr double coarse_damping = 0.55;
        const bool finest = hierarchy_.is_finest(level);
        const double wanted = pp_.paper.epsilon > 0.0 ? pp_.paper.epsilon : default_epsilon(problem_.options);
        const double epsilon = finest ? wanted : std::max(wanted, coarse_epsilon);
        const int most = problem_.options.max_iterations;
        return {epsilon, unfairness_limit(problem_.options, epsilon), finest ? most : std::clamp(2 * most, 100, 400),
                finest ? pp_.paper.damping : coarse_damping * pp_.paper.damping};
    }

    void fair(int level, const Progress& progress) {
        Stopwatch watch;
        const Patch& patch = patch_of(level);
        const Indices numbers = numbers_of(level);
        const Points reference = pp_.reference(Eigen::all, numbers);
        const LevelProblem lp = level_problem(level, reference);
        Points start = points_(Eigen::all, numbers);
        if (level == 0) {
            const Stiffness stiffness = start_stiffness(patch, pp_.inner_fairness, reference);
            start = start_of_level(lp, stiffness, problem_.fixed_points, progress.range(0.0, 0.1));
            start = raise_load(lp, std::move(start), progress.here());
            solution_.seconds["start"] = watch.lap();
        }
        const IterationOutcome outcome = fair_level(lp, start, limits_of(level), progress.range(0.1, 1.0));
        solution_.seconds[hierarchy_.is_finest(level) ? "iteration" : "coarse levels"] += watch.lap();
        for (std::size_t v = 0; v < numbers.size(); ++v) {
            points_.col(numbers[v]) = outcome.points.col(static_cast<Eigen::Index>(v));
        }
        record(level, outcome);
    }

    // The load of Δ_B H = load in steps, each from the last one's surface: its solutions lie far from the start.
    [[nodiscard]] static Points raise_load(const LevelProblem& full, Points points, const Progress& progress) {
        constexpr double largest_step = 15.0;  // units of 1/D³
        constexpr int updates = 100;
        if (full.solver.equation != Equation::constant) return points;
        const int steps = std::min(20, static_cast<int>(std::ceil(std::abs(full.solver.load) / largest_step)));
        for (int k = 0; k < steps; ++k) {
            SolverOptions options = full.solver;
            options.load *= static_cast<double>(k) / steps;
            const LevelProblem level{full.patch, full.fixed_normals, options, full.paper, full.weights, full.completed};
            points = fair_level(level, points, {1e-2 * largest_step, 1.0, updates, 0.5 * full.paper.damping}, progress)
                         .points;
        }
        return points;
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
    const Progress& progress_;
    Hierarchy hierarchy_;
    Points points_;
    Solution solution_;
};

}  // namespace

double default_epsilon(const SolverOptions& options) {
    return (options.equation == Equation::minimal ? 20.0 : 500.0) * options.tolerance;
}

double unfairness_limit(const SolverOptions& options, double epsilon) {
    return options.equation == Equation::minimal ? epsilon : 0.04 * epsilon;
}

Solution solve_paper(const PaperProblem& paper_problem, const Progress& progress) {
    return PaperSolver(paper_problem, progress).run();
}

}  // namespace fairing
