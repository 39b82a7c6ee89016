#include "method/nested.h"

#include <algorithm>
#include <cmath>

#include "base/stopwatch.h"
#include "geometry/flips.h"
#include "geometry/surface_fit.h"
#include "iteration/accelerated_iteration.h"
#include "method/one_level.h"
#include "method/sizes.h"
#include "multigrid/coarsening.h"
#include "multigrid/tangential_multigrid.h"
#include "operators/workspace.h"
#include "problem/surface_state.h"
#include "tangential/slide.h"

namespace fairing {

namespace {

constexpr int coarsest_size = 600;  // free vertices
// Up to so many free vertices the tangential step is factorised; beyond, multigrid is faster.
constexpr int largest_factorised = 7000;
constexpr double between_tolerance = 1e-4;  // units of D, of levels that are only starts
// A level that starts at the coarser one's surface needs 3 to 8 iterations. Those between are good enough as starts
// even where single poor triangles of a coarse level keep them from converging.
constexpr int most_iterations = 20;
constexpr int most_between = 6;
constexpr int patience = 4;
constexpr int evening_sweeps = 3;
constexpr int most_slides = 8;
// Shares of the time, measured at 100k and 256k.
constexpr double begin = 0.06;  // the hierarchy
constexpr double share_of_start = 0.3;

InnerWeights symmetric_weights(const Lambda& weights) {
    if (const auto* rows = std::get_if<RowWeights>(&weights)) return symmetrised(*rows);
    return std::get<InnerWeights>(weights);
}

// Columns of the vertices of a coarse level, in its order.
Points pick(const Points& points, const Indices& columns, int first) {
    Points result(3, static_cast<Eigen::Index>(columns.size()) - first);
    for (Eigen::Index k = 0; k < result.cols(); ++k) result.col(k) = points.col(columns[at(first) + std::size_t(k)]);
    return result;
}

// A value for all vertices of which only the fixed ones are known.
Points with_fixed(const Patch& patch, const Points& fixed) {
    Points points = Points::Zero(3, patch.vertex_count());
    points.rightCols(fixed.cols()) = fixed;
    return points;
}

// Of a level's start: the iteration irons single ones out.
std::size_t tolerated_folds(const Problem& problem) {
    constexpr std::size_t share = 100;
    return problem.tolerated_folds + at(problem.patch.triangle_count()) / share;
}

// The fraction of all that is done after level k: each level takes about a quarter of the next finer one.
double done_after(std::size_t k) { return begin + (1.0 - begin) * std::pow(0.25, static_cast<double>(k)); }

struct Level {
    Problem problem;
    InnerWeights weights;
    Workspace work;
    const LaplaceCycle* tangential_cycle = nullptr;  // in `work`
};

class NestedSolve {
public:
    NestedSolve(const Problem& problem, const Progress& progress)
        : problem_(problem),
          progress_(progress),
          fixed_points_(with_fixed(problem.patch, problem.fixed_points)),
          fixed_normals_(with_fixed(problem.patch, problem.fixed_normals)) {}

    std::optional<Solution> run() {
        Stopwatch watch;
        InnerWeights weights = symmetric_weights(problem_.weights);
        coarse_ = coarsen(problem_.patch, weights, {fixed_points_, fixed_normals_}, coarsest_size);
        if (coarse_.empty()) return std::nullopt;
        make_levels(std::move(weights));
        std::map<std::string, double> seconds{{"hierarchy", watch.lap()}};
        progress_.report(begin, "hierarchy");
        const std::size_t coarsest = coarse_.size();
        Solution solution = solve_on_own_mesh(coarsest_problem(), progress_.range(begin, done_after(coarsest)));
        seconds["coarsest"] = watch.lap();
        const double initial_residual = solution.initial_residual;
        solution = is_start(solution) ? refined(std::move(solution)) : given_up(coarsest, solution.points);
        solution.initial_residual = initial_residual;
        for (std::size_t k = levels_.size(); k-- > 0;)
            solution.levels.push_back(levels_[k].problem.patch.vertex_count());
        seconds["iteration"] = watch.lap();
        solution.seconds = std::move(seconds);
        return solution;
    }

private:
    // Fine to coarse; levels_[0] is the caller's.
    void make_levels(InnerWeights weights) {
        levels_.reserve(coarse_.size() + 1);
        levels_.push_back({problem_, std::move(weights), {}});
        for (CoarseLevel& coarse : coarse_) {
            const Patch& patch = coarse.patch;
            Problem problem{patch, pick(fixed_points_, patch.to_input, patch.free_count),
                            pick(fixed_normals_, patch.to_input, patch.free_count), coarse.weights, problem_.options};
            problem.options.tolerance = std::max(between_tolerance, problem_.options.tolerance);
            levels_.push_back({std::move(problem), std::move(coarse.weights), {}});
        }
        for (Level& level : levels_) {
            const int most = &level == &levels_.front() ? most_iterations : most_between;
            level.problem.options.max_iterations = std::min(most, problem_.options.max_iterations);
            level.problem.options.patience = patience;
        }
    }

    [[nodiscard]] Problem coarsest_problem() const {
        Problem problem = levels_.back().problem;
        problem.options.max_iterations = problem_.options.max_iterations;
        problem.options.patience = problem_.options.patience;
        return problem;
    }

    [[nodiscard]] bool is_factorised(std::size_t k) const {
        return k == coarse_.size() || levels_[k].problem.patch.free_count <= largest_factorised;
    }

    void set_up_tangential(std::size_t k, RingMatrix laplacian) {
        Level& level = levels_[k];
        const Problem& problem = level.problem;
        const auto adopt = [&](auto step) {
            level.tangential_cycle = step.get();
            level.work.tangential = std::move(step);
        };
        if (is_factorised(k)) {
            adopt(std::make_unique<FactorisedLaplacian>(problem.patch, level.weights, problem.fixed_points,
                                                        progress_.here()));
        } else {
            adopt(std::make_unique<MultigridStep>(problem.patch, std::move(laplacian), problem.fixed_points,
                                                  coarse_[k].transfer, *levels_[k + 1].tangential_cycle));
        }
    }

    // All levels from the coarsest one's solution.
    Solution refined(Solution solution) {
        set_up_tangential(coarse_.size(), laplacian_of(coarse_.size()));
        for (std::size_t k = coarse_.size(); k-- > 0;) {
            const Points coarser = solution.points;
            solution = refine(k, coarser, progress_.range(done_after(k + 1), done_after(k)));
            if (!is_good(k, solution)) return given_up(k + 1, coarser);
        }
        solution.boundary_normals = one_sided_normals(problem_.patch, solution.points);
        return solution;
    }

    // Of the coarsest level. Noise of the outline and single poor triangles keep it from converging, and the next level
    // converges all the same. Regions of a bust went on from steps of 0.001 to 0.03, those of an ear, whose surface the
    // coarsest mesh does not resolve, ended at 0.5 and more.
    [[nodiscard]] static bool is_start(const Solution& solution) {
        constexpr double small_step = 0.04;  // units of D
        if (solution.flaw == Flaw::not_converged) return solution.last_step <= small_step;
        return solution.flaw == Flaw::absent;
    }

    // Levels between are good enough as starts where their steps shrink, even if single poor triangles keep them from
    // converging.
    [[nodiscard]] static bool is_good(std::size_t k, const Solution& solution) {
        constexpr double shrinks = 1.0 / 3.0;
        if (solution.termination == Termination::converged) return true;
        return k > 0 && solution.termination == Termination::iteration_limit &&
               solution.last_step <= shrinks * solution.first_step;
    }

    // The surface of level k on the finest one.
    [[nodiscard]] Solution given_up(std::size_t k, const Points& points) const {
        Solution solution;
        solution.points = points;
        while (k-- > 0) solution.points = interpolated(k, solution.points, laplacian_of(k)).points;
        const SurfaceState state = measured_surface(problem_, solution.points);
        solution.mean_curvature = state.curvature.mean;
        solution.residual = largest_residual(problem_, state, outer_residual(problem_, state));
        solution.boundary_normals = one_sided_normals(problem_.patch, solution.points);
        return solution;
    }

    // The solution of level k from that of the coarser one; stalled where its start is folded.
    Solution refine(std::size_t k, const Points& coarse, const Progress& progress) {
        Level& level = levels_[k];
        const Problem& problem = level.problem;
        RingMatrix laplacian = laplacian_of(k);
        auto [points, normals] = interpolated(k, coarse, laplacian);
        progress.report(share_of_start / 3, "refinement");
        set_up_tangential(k, std::move(laplacian));
        slide(problem, *level.work.tangential, normals, most_slides, points);
        progress.report(share_of_start, "refinement");
        level.work.normal = make_normal_operator(problem, points.leftCols(problem.patch.free_count));
        // λ that aren't symmetric need a factorisation of their own; so far their symmetric part was good enough.
        if (k == 0 && std::holds_alternative<RowWeights>(problem.weights)) {
            level.work.tangential =
                make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress.here());
            slide(problem, *level.work.tangential, max_normals(problem.patch, points, problem.fixed_normals),
                  most_slides, points);
        }
        if (flipped_by_solution(problem.patch, points).size() > tolerated_folds(problem)) return {};
        Solution solution = iterate(problem, level.work, points, progress.range(share_of_start, 1.0));
        level.work.normal.reset();  // the tangential step serves the finer levels
        return solution;
    }

    [[nodiscard]] RingMatrix laplacian_of(std::size_t k) const {
        return {levels_[k].problem.patch.vertex_count(), levels_[k].weights};
    }

    struct Surface {
        Points points;
        Points normals;
    };

    [[nodiscard]] Surface interpolated(std::size_t k, const Points& coarse, const RingMatrix& laplacian) const {
        const Problem& fine = levels_[k].problem;
        const SurfaceState state = measured_surface(levels_[k + 1].problem, coarse);
        Points points = with_fixed(fine.patch, fine.fixed_points);
        Points normals = with_fixed(fine.patch, fine.fixed_normals);
        coarse_[k].transfer.prolong_surface(coarse, state.normals, fine.patch.free_count, points, normals);
        even_out(laplacian, fine.patch.free_count, evening_sweeps, points, normals);
        return {std::move(points), std::move(normals)};
    }

    const Problem& problem_;
    const Progress& progress_;
    Points fixed_points_;  // of the finest level, all vertices; 0 at free ones
    Points fixed_normals_;
    std::vector<CoarseLevel> coarse_;  // coarse_[k] lies below levels_[k]
    std::vector<Level> levels_;
};

}  // namespace

std::optional<Solution> solve_nested(const Problem& problem, const Progress& progress) {
    return NestedSolve(problem, progress).run();
}

}  // namespace fairing
