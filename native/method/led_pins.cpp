#include "method/led_pins.h"

#include <algorithm>

#include "geometry/flips.h"
#include "geometry/self_intersection.h"
#include "geometry/surface_fit.h"
#include "pins/spread_pins.h"
#include "placement/place.h"
#include "problem/surface_state.h"
#include "proxy/proxy_mesh.h"

namespace fairing {

namespace {

constexpr double shortest_step = 0.003;  // of a pin, in units of D
// On the way there the surface is only roughly solved.
constexpr double rough = 1e-3;
constexpr int most_rough_iterations = 20;
constexpr double growth = 0.15;          // of edge lengths per distance from the outline
constexpr double longest_edge = 0.03;    // units of D
constexpr double edge_of_radius = 0.35;  // so that bells have three edges to fall off
constexpr int least_free_limit = 3000;

// How pins are led: by steps (units of D) that grow by a factor until one has failed.
struct Pace {
    double first_step;
    double growth;
};
constexpr Pace fast = {0.05, 2.0};
// For long ways past which the surface changes much at some place: there each step has to be short.
constexpr Pace slow = {0.025, 1.0};
constexpr double far_enough = 0.7;  // of the way at the fast pace, for the slow one to be worth its time

class LedPins {
public:
    LedPins(const Problem& problem, double radius, const LedStart& start, const Progress& progress)
        : problem_(problem),
          radius_(radius),
          start_(start.points),
          guess_(start.guess),
          progress_(progress),
          pins_(isolated_pins(problem.patch)),
          mesh_(problem.patch, start.points) {
        sizing_ = {growth, std::min(longest_edge, edge_of_radius * radius),
                   std::max(least_free_limit, 3 * problem.patch.free_count)};
    }

    std::optional<Solution> run(const Pace& pace) {
        const Points ways = problem_.fixed_points - start_.rightCols(problem_.fixed_points.cols());
        const double way = std::max(largest_length(ways), pace.first_step);
        double step = pace.first_step / way;
        double factor = pace.growth;  // until a step has failed: failures cost most
        while (reached_ < 1.0) {
            progress_.report(0.8 * reached_, "pins");
            constexpr double remnant = 0.1;  // of a step, not worth one of its own
            const double share = reached_ + (1.0 + remnant) * step > 1.0 ? 1.0 : reached_ + step;
            if (go_to(share, rough, most_rough_iterations)) {
                reached_ = share;
                step *= factor;
                continue;
            }
            factor = 1.0;
            step *= 0.5;
            if (step * way < shortest_step) return std::nullopt;
        }
        // Once more on the mesh that belongs to it.
        const SolverOptions& options = problem_.options;
        if (!go_to(1.0, options.tolerance, options.max_iterations)) return std::nullopt;
        return placed();
    }

    // Share of the way.
    [[nodiscard]] double reached() const { return reached_; }

private:
    struct Solved {
        ProxyMesh::Snapshot mesh;
        Solution solution;
    };

    [[nodiscard]] Problem on_mesh(const Patch& patch, double share) const {
        Points fixed = problem_.fixed_points;
        for (int place : pins_) {
            const Vector3 begin = start_.col(problem_.patch.free_count + place);
            fixed.col(place) = begin + share * (problem_.fixed_points.col(place) - begin);
        }
        return {patch, fixed, problem_.fixed_normals, uniform_weights(patch), problem_.options};
    }

    // False where no surface without folds is found; the mesh then stays where it was.
    bool go_to(double share, double tolerance, int most_iterations) {
        mesh_.adapt(sizing_);
        ProxyMesh::Snapshot mesh = mesh_.snapshot();
        Problem problem = on_mesh(mesh.patch, share);
        problem.options.tolerance = std::max(tolerance, problem.options.tolerance);
        problem.options.max_iterations = std::min(most_iterations, problem.options.max_iterations);
        if (isolated_pins(mesh.patch).size() != pins_.size()) return false;
        Solution solution = spread_pins(problem, radius_, mesh.points, progress_.here());
        if (solution.termination != Termination::converged) return false;
        if (!flipped_by_solution(mesh.patch, solution.points).empty()) return false;
        mesh_.read_back(mesh.patch, solution.points);
        mesh.points = solution.points;
        last_.emplace(Solved{std::move(mesh), std::move(solution)});
        return true;
    }

    std::optional<Solution> placed() {
        const auto& [mesh, solution] = *last_;
        const Problem own = on_mesh(mesh.patch, 1.0);
        const Points normals = measured_surface(own, mesh.points).normals;
        const TargetSurface target(mesh.patch, mesh.points, normals);
        const auto tangential =
            make_tangential_step(problem_.patch, problem_.weights, problem_.fixed_points, progress_.here());
        const Placed best = place(problem_, *tangential, {mesh_, mesh, target}, guess_, progress_.range(0.8, 1.0));
        Solution result = solution;
        result.polished = false;
        result.points = best.placement.points;
        result.boundary_normals = one_sided_normals(mesh.patch, mesh.points);
        result.mean_curvature = carried_over(best.placement, target, solution.mean_curvature, problem_);
        result.crosses = !crossing_triangles(mesh.patch.triangles, mesh.points).empty();
        refuse_folds(problem_, best, result);
        return result;
    }

    const Problem& problem_;
    double radius_;
    const Points& start_;
    const std::optional<Points>& guess_;
    const Progress& progress_;
    Indices pins_;
    ProxyMesh mesh_;
    double reached_ = 0.0;
    Sizing sizing_{};
    std::optional<Solved> last_;
};

}  // namespace

std::optional<Solution> lead_pins(const Problem& problem, double radius, const LedStart& start,
                                  const Progress& progress) {
    LedPins first(problem, radius, start, progress);
    auto found = first.run(fast);
    if (found || first.reached() < far_enough) return found;
    return LedPins(problem, radius, start, progress).run(slow);
}

}  // namespace fairing
