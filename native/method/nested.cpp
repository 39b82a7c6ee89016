#include "method/nested.h"

#include <algorithm>
#include <cmath>

#include "base/beside.h"
#include "base/stopwatch.h"
#include "geometry/flips.h"
#include "geometry/surface_fit.h"
#include "iteration/accelerated_iteration.h"
#include "method/eased.h"
#include "method/levels.h"
#include "method/one_level.h"
#include "problem/surface_state.h"
#include "tangential/slide.h"

namespace fairing {

namespace {

constexpr double between_tolerance = 1e-4;  // units of D, of levels that are only starts
// A level that starts at the coarser one's surface needs 3 to 8 iterations. Those between are good enough as starts
// even where single poor triangles of a coarse level keep them from converging.
constexpr int most_iterations = 20;
constexpr int most_between = 6;
constexpr int patience = 4;
constexpr int evening_sweeps = 3;
constexpr int most_slides = 8;
// Free vertices of a level whose ordering is kept while coarser ones are solved; larger ones have no room for it.
constexpr int largest_prepared = 200'000;
// Shares of the time, measured at 100k and 256k.
constexpr double begin = 0.06;  // the hierarchy
constexpr double share_of_start = 0.3;

// Of a level's start: the iteration irons single ones out.
std::size_t tolerated_folds(const Problem& problem) {
    constexpr std::size_t share = 100;
    return problem.tolerated_folds + at(problem.patch.triangle_count()) / share;
}

// The fraction of all that is done after level k: each level takes about a quarter of the next finer one.
double done_after(std::size_t k) { return begin + (1.0 - begin) * std::pow(0.25, static_cast<double>(k)); }

class NestedSolve {
public:
    NestedSolve(const Problem& problem, const Progress& progress)
        : problem_(problem), progress_(progress), is_rough_(is_jagged(problem)), levels_(problem, Outlines::thinned) {
        for (std::size_t k = 0; k <= levels_.coarsest(); ++k) {
            SolverOptions& options = levels_.problem(k).options;
            options.max_iterations = std::min(k == 0 ? most_iterations : most_between, problem.options.max_iterations);
            options.patience = patience;
            options.contracts = is_rough_;
            if (k == 0) continue;
            options.tolerance = std::max(between_tolerance, problem.options.tolerance);
            options.start_only = true;
        }
    }

    std::optional<Solution> run() {
        const std::size_t coarsest = levels_.coarsest();
        if (coarsest == 0) return std::nullopt;
        std::map<std::string, double> seconds{{"hierarchy", watch_.lap()}};
        progress_.report(begin, "hierarchy");
        levels_.factorise_beside();
        Solution solution = solve_on_own_mesh(coarsest_problem(), progress_.range(begin, done_after(coarsest)));
        seconds["coarsest"] = watch_.lap();
        const double initial_residual = solution.initial_residual;
        solution = is_start(solution) ? refined(std::move(solution)) : given_up(coarsest, solution.points);
        solution.initial_residual = initial_residual;
        solution.levels = levels_.sizes();
        seconds["iteration"] = watch_.lap();
        solution.seconds = std::move(seconds);
        return solution;
    }

private:
    [[nodiscard]] Problem coarsest_problem() const {
        Problem problem = levels_.problem(levels_.coarsest());
        problem.options.max_iterations = problem_.options.max_iterations;
        problem.options.patience = problem_.options.patience;
        return problem;
    }

    // Analyses the operators of finer levels beside other work: the coarsest surface tells about where vertices are.
    void prepare_beside(const Points& coarsest) {
        operators_.resize(levels_.coarsest());
        for (std::size_t k = operators_.size(); k-- > 0;) {
            if (levels_.problem(k).patch.free_count > largest_prepared) continue;
            operators_[k].preparing = Beside([this, k, coarsest] {
                const Problem& problem = levels_.problem(k);
                operators_[k].made = make_normal_operator(problem, levels_.layout(k, coarsest), Solves::few);
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

    // All levels from the coarsest one's solution.
    Solution refined(Solution solution) {
        prepare_beside(solution.points);
        levels_.set_up_tangential(levels_.coarsest(), progress_);
        for (std::size_t k = levels_.coarsest(); k-- > 0;) {
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
    // converging. Over jagged outlines no steps need to shrink there: the finest level tells after four to six. Of 24
    // regions of scans with 10,000 vertices, none of whose levels between converged, 11 were solved from there, all but
    // one with last steps below the larger limit; 4 others were not.
    [[nodiscard]] bool is_good(std::size_t k, const Solution& solution) const {
        constexpr double shrinks = 1.0 / 3.0;
        constexpr double small_step = 1e-3;  // units of D
        constexpr double rough_step = 0.03;
        if (solution.termination == Termination::converged) return true;
        if (k == 0 || solution.iterations == 0) return false;
        if (is_rough_) return solution.last_step <= rough_step;
        return solution.termination == Termination::iteration_limit &&
               solution.last_step <= std::min(small_step, shrinks * solution.first_step);
    }

    // The surface of level k on the finest one, not measured there.
    [[nodiscard]] Solution given_up(std::size_t k, const Points& points) {
        Solution solution;
        solution.points = points;
        while (k-- > 0) {
            levels_.come_back(k + 1);
            solution.points = interpolated(k, solution.points, levels_.laplacian(k)).points;
        }
        return solution;
    }

    // The solution of level k from that of the coarser one; stalled where its start is folded.
    Solution refine(std::size_t k, const Points& coarse, const Progress& progress) {
        const Problem& problem = levels_.problem(k);
        Workspace& work = levels_.work(k);
        RingMatrix laplacian = levels_.laplacian(k);
        auto [points, normals] = interpolated(k, coarse, laplacian);
        levels_.leave(k + 1);
        progress.report(share_of_start / 3, "refinement");
        levels_.set_up_tangential(k, std::move(laplacian), progress_);
        slide(problem, *work.tangential, normals, turning(), most_slides, points);
        normals.resize(3, 0);  // the iteration needs the room
        progress.report(share_of_start, "refinement");
        work.normal = normal_operator(k, points);
        // λ that aren't symmetric need a factorisation of their own; so far their symmetric part was good enough.
        if (k == 0 && std::holds_alternative<RowWeights>(*problem.weights)) {
            work.tangential =
                make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress.here());
            slide(problem, *work.tangential, max_normals(problem.patch, points, problem.fixed_normals), turning(),
                  most_slides, points);
        }
        if (flipped_by_solution(problem.patch, points).size() > tolerated_folds(problem)) return {};
        Solution solution = iterate(problem, work, std::move(points), progress.range(share_of_start, 1.0));
        work.normal.reset();  // the tangential step serves the finer levels
        return solution;
    }

    [[nodiscard]] Turning turning() const { return is_rough_ ? Turning::unknown : Turning::known; }

    struct Surface {
        Points points;
        Points normals;
    };

    [[nodiscard]] Surface interpolated(std::size_t k, const Points& coarse, const RingMatrix& laplacian) const {
        const Problem& fine = levels_.problem(k);
        const SurfaceState state = measured_surface(levels_.problem(k + 1), coarse);
        Points points = with_fixed(fine.patch, fine.fixed_points);
        Points normals = with_fixed(fine.patch, fine.fixed_normals);
        levels_.transfer(k).prolong_surface(coarse, state.normals, fine.patch.free_count, points, normals);
        even_out(laplacian, fine.patch.free_count, evening_sweeps, points, normals);
        return {std::move(points), std::move(normals)};
    }

    const Problem& problem_;
    const Progress& progress_;
    const bool is_rough_;
    Stopwatch watch_;
    Levels levels_;
    struct Operator {
        std::unique_ptr<NormalOperator> made;
        Beside preparing;
    };
    std::vector<Operator> operators_;  // of levels to come
};

}  // namespace

std::optional<Solution> solve_nested(const Problem& problem, const Progress& progress) {
    return NestedSolve(problem, progress).run();
}

}  // namespace fairing
