#include "method/nested.h"

#include "accept/accept.h"
#include "base/background_task.h"
#include "base/stopwatch.h"
#include "geometry/flips.h"
#include "geometry/surface_fit.h"
#include "iteration/accelerated_iteration.h"
#include "method/direct.h"
#include "method/levels.h"
#include "problem/surface_state.h"
#include "start/loft.h"
#include "start/quick_surface.h"
#include "tangential/slide.h"

namespace fairing {

namespace {

// Free vertices of the coarsest level over smooth boundaries that only one surface fits: enough to find it, for a third
// of the cost. If not, the next level is solved from the boundary.
constexpr int smallest_coarsest = 150;
constexpr double small_tolerance = 7e-4;  // of that level, units of D: its triangles are too large for more
// Levels between are good enough as starts even where single poor triangles keep them from converging.
constexpr int most_between = 6;
constexpr int most_small = 14;  // on the finest level of patches that are not large: another strategy is cheap there
// Free vertices of a level whose ordering is kept while coarser ones are solved; larger ones have no room for it.
constexpr int largest_prepared = 200'000;
// Shares of the time, measured at 100k and 256k.
constexpr double begin = 0.06;  // the hierarchy
constexpr double share_of_start = 0.3;

// Folds that a level's start may have: the iteration irons single ones out.
std::size_t tolerated_folds(const Problem& problem) {
    constexpr std::size_t share = 100;  // one triangle in so many
    return problem.tolerated_folds + problem.patch.triangle_count() / share;
}

// The fraction of all that is done after level k: each level takes about a quarter of the next finer one.
double done_after(std::size_t k) { return begin + (1.0 - begin) * std::pow(0.25, static_cast<double>(k)); }

class NestedSolve {
public:
    // `coarsest`: free vertices of the level to begin on.
    NestedSolve(const Problem& problem, const Traits& traits, int coarsest, const Progress& progress)
        : problem_(problem),
          traits_(traits),
          progress_(progress),
          begins_small_(coarsest < coarsest_size),
          levels_(levels_of(problem, traits, coarsest)) {
        for (std::size_t k = 0; k <= levels_.coarsest(); ++k) {
            Conduct& conduct = levels_.problem(k).conduct;
            conduct.limits = nearby;
            conduct.contracts = traits_.is_jagged && k == 0;
            conduct.begins_near = k == 0;
            if (k == 0 && !traits_.is_large) conduct.limits.steps = most_small;
            if (k == 0) continue;
            conduct.limits.steps = most_between;
            conduct.start_only = true;
            SolverOptions& options = levels_.problem(k).options;
            options.tolerance = std::max(start_tolerance, problem.options.tolerance);
        }
    }

    std::optional<Solution> run() {
        const std::size_t coarsest = levels_.coarsest();
        if (coarsest == 0) return std::nullopt;
        std::map<std::string, double> seconds{{"hierarchy", watch_.lap()}};
        progress_.report(begin, "hierarchy");
        levels_.prepare_beside();
        std::size_t k = coarsest;
        Solution solution = solved_alone(k);
        while (!is_start(k, solution) && k > 1 && may_be_alone(k - 1)) solution = solved_alone(--k);
        seconds["coarsest"] = watch_.lap();
        const double initial_residual = solution.initial_residual;
        solution = is_start(k, solution) ? refined(k, std::move(solution)) : given_up(k, solution.points);
        solution.initial_residual = initial_residual;
        solution.levels = levels_.sizes();
        seconds["iteration"] = watch_.lap();
        solution.seconds = std::move(seconds);
        return solution;
    }

private:
    // Level k solved from its boundary, without a coarser level's surface.
    [[nodiscard]] Solution solved_alone(std::size_t k) const {
        Problem problem = levels_.problem(k);
        if (is_small(k)) {
            problem.options.tolerance = std::max(problem.options.tolerance, small_tolerance);
            problem.conduct.limits = nearby;
        }
        Solution solution = is_small(k) ? solve_directly(problem, progress_.range(begin, done_after(k)))
                                        : try_directly(problem, progress_.range(begin, done_after(k)));
        solution.flaw = flaw_of(problem, solution);
        return solution;
    }

    // Whether it is the extra-coarse level, which need not show the surface.
    [[nodiscard]] bool is_small(std::size_t k) const { return begins_small_ && k == levels_.coarsest(); }

    [[nodiscard]] bool may_be_alone(std::size_t k) const {
        return levels_.problem(k).patch.free_count <= 2 * coarsest_size;
    }

    // Orders the factorisations of finer levels in the background: the first surface shows roughly where vertices are.
    void prepare_beside(std::size_t from, const Points& surface) {
        operators_.resize(from);
        for (std::size_t k = operators_.size(); k-- > 0;) {
            if (levels_.problem(k).patch.free_count > largest_prepared) continue;
            operators_[k].preparing = BackgroundTask([this, k, from, surface] {
                const Problem& problem = levels_.problem(k);
                operators_[k].made = make_normal_operator(problem, levels_.layout(k, from, surface), Solves::few);
                operators_[k].made->prepare();
            });
        }
    }

    [[nodiscard]] std::unique_ptr<NormalOperator> normal_operator(std::size_t k, const Points& points) {
        operators_[k].preparing.finish();
        if (operators_[k].made) return std::move(operators_[k].made);
        const Problem& problem = levels_.problem(k);
        return make_normal_operator(problem, points.leftCols(problem.patch.free_count), Solves::few);
    }

    // All finer levels from the solution of level `from`.
    Solution refined(std::size_t from, Solution solution) {
        prepare_beside(from, solution.points);
        levels_.set_up_tangential(from, progress_);
        for (std::size_t k = from; k-- > 0;) {
            const Points coarser = solution.points;
            solution = refine(k, coarser, progress_.range(done_after(k + 1), done_after(k)));
            if (is_good(k, solution)) continue;
            return given_up(k + 1, coarser);
        }
        solution.boundary_normals = one_sided_normals(problem_.patch, solution.points);
        return solution;
    }

    // Whether a level that was solved alone is a start. Noise of the boundary and single poor triangles keep it from
    // converging, and the next level converges all the same. Regions of a bust went on from steps of 0.001 to 0.03,
    // those of an ear, whose surface the coarsest mesh does not resolve, ended at 0.5 and more.
    [[nodiscard]] bool is_start(std::size_t k, const Solution& solution) const {
        constexpr double small_step = 0.04;  // units of D
        // A coarser mesh may lead from one surface to another.
        if (is_small(k) && may_fit_several(levels_.problem(k).patch, solution.points)) return false;
        const double longest = is_small(k) ? near_step : small_step;
        if (solution.flaw == Flaw::not_converged) return solution.last_step <= longest;
        return solution.flaw == Flaw::absent;
    }

    // Levels between are good enough as starts where their steps shrink, even if single poor triangles keep them from
    // converging.
    [[nodiscard]] bool is_good(std::size_t k, const Solution& solution) const {
        constexpr double shrinks = 1.0 / 3.0;  // in all steps of the level
        constexpr double small_step = 1e-3;    // units of D
        if (solution.termination == Termination::converged) return true;
        if (k == 0 || solution.iterations == 0) return false;
        return solution.iterations == most_between &&
               solution.last_step <= std::min(small_step, shrinks * solution.first_step);
    }

    // The surface of level k on the finest one, not measured there.
    [[nodiscard]] Solution given_up(std::size_t k, const Points& points) {
        Solution solution;
        solution.points = points;
        while (k-- > 0) {
            levels_.come_back(k + 1);
            solution.points = levels_.interpolated(k, solution.points, levels_.laplacian(k)).points;
        }
        return solution;
    }

    // The solution of level k from that of the coarser one; stalled where its start is folded.
    Solution refine(std::size_t k, const Points& coarse, const Progress& progress) {
        const Problem& problem = levels_.problem(k);
        Workspace& work = levels_.work(k);
        RingMatrix laplacian = levels_.laplacian(k);
        auto [points, normals, shapes] = levels_.interpolated(k, coarse, laplacian);
        levels_.leave(k + 1);
        progress.report(share_of_start / 3, "refinement");
        levels_.set_up_tangential(k, std::move(laplacian), progress_);
        slide(problem, *work.tangential, normals, std::move(shapes), most_slides, points);
        normals.resize(3, 0);  // the iteration needs the room
        progress.report(share_of_start, "refinement");
        work.normal = normal_operator(k, points);
        if (flipped_by_solution(problem.patch, points).size() > tolerated_folds(problem)) return {};
        Solution solution = iterate(problem, work, std::move(points), progress.range(share_of_start, 1.0));
        work.normal.reset();  // the tangential step serves the finer levels
        return solution;
    }

    const Problem& problem_;
    const Traits& traits_;
    const Progress& progress_;
    const bool begins_small_;
    Stopwatch watch_;
    Levels levels_;
    struct Operator {
        std::unique_ptr<NormalOperator> made;
        BackgroundTask preparing;  // makes it, from the levels; ends before both
    };
    std::vector<Operator> operators_;  // of levels to come
};

// Free vertices of the level on which the first surface is made, and up to which no levels are made. Between several
// loops coarse levels lose the shape before: limbs of a few hundred vertices turn over on them.
struct Fineness {
    int level;
    int largest_direct;
};
constexpr Fineness usual{coarsest_size, 900};  // one loop
constexpr Fineness with_limbs{1500, 2500};     // several

Problem with_shape_before(const Problem& level, const Points& before) {
    Problem result = level;
    if (before.cols() > 0) result.before = Points(before(Eigen::all, level.patch.to_input));
    return result;
}

std::optional<Points> by_levels(const Problem& given, int size, const Progress& progress) {
    Problem problem = given;
    problem.weights = uniform_weights(given.patch);
    const Traits traits(problem);
    const Levels levels = levels_of(problem, traits, size);
    std::size_t k = levels.coarsest();
    if (k == 0) return std::nullopt;
    auto points = quick_surface(with_shape_before(levels.problem(k), *problem.before), progress);
    while (points && k-- > 0) points = levels.interpolated(k, *points, levels.laplacian(k)).points;
    return points;
}

Points as_before(const Problem& problem) {
    const Patch& patch = problem.patch;
    Points points = with_fixed(patch, problem.fixed_points);
    if (problem.before->cols() == points.cols())
        points.leftCols(patch.free_count) = problem.before->leftCols(patch.free_count);
    return points;
}

}  // namespace

std::optional<Solution> solve_nested(const Problem& problem, const Traits& traits, const Progress& progress) {
    if (traits.begins_small) {
        auto solution = NestedSolve(problem, traits, smallest_coarsest, progress).run();
        if (solution && solution->termination == Termination::converged) return solution;
        if (!traits.is_large) return std::nullopt;
    }
    return NestedSolve(problem, traits, coarsest_size, progress).run();
}

Points first_surface(const Problem& problem, const Progress& progress) {
    std::optional<Points> points;
    const Fineness fineness = joins_boundaries(problem) ? with_limbs : usual;
    if (problem.patch.free_count > fineness.largest_direct) points = by_levels(problem, fineness.level, progress);
    if (!points) points = quick_surface(problem, progress);
    return points && points->allFinite() ? *points : as_before(problem);
}

}  // namespace fairing
