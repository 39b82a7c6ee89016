#include "pins/led_pins.h"

#include "geometry/flips.h"
#include "geometry/self_intersection.h"
#include "geometry/surface_fit.h"
#include "pins/spread_pins.h"
#include "placement/place.h"
#include "problem/surface_state.h"
#include "proxy/proxy_solver.h"

namespace fairing {

namespace {

constexpr double longest_step = 0.05;    // of a pin, in units of D
constexpr double shortest_step = 0.005;  // likewise: below, the search ends
constexpr double edge_of_radius = 0.35;  // so that bells have three edges to fall off

class LedPins {
public:
    LedPins(const Problem& problem, double radius, const Points& start, const Progress& progress)
        : problem_(problem),
          radius_(radius),
          start_(start),
          progress_(progress),
          pins_(isolated_pins(problem.patch)),
          mesh_(problem.patch, start),
          sizing_(fine_sizing(problem.patch.free_count)) {
        sizing_.longest = std::min(sizing_.longest, edge_of_radius * radius);
    }

    std::optional<Solution> run() {
        const double distance = largest_length(problem_.fixed_points - start_.rightCols(problem_.fixed_points.cols()));
        const double shortest = shortest_step / std::max(distance, longest_step);
        double step = std::min(1.0, longest_step / std::max(distance, longest_step));
        bool growing = true;  // until a step has failed: failures cost most
        for (double reached = 0.0; reached < 1.0;) {
            progress_.report(0.8 * reached, "pins");
            const double share = std::min(1.0, reached + step);
            if (go_to(share)) {
                reached = share;
                step *= growing ? 2.0 : 1.0;
                continue;
            }
            growing = false;
            step *= 0.5;
            if (step < shortest) return std::nullopt;
        }
        // Once more on the mesh that belongs to it.
        if (!go_to(1.0)) return std::nullopt;
        return projected();
    }

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
    bool go_to(double share) {
        mesh_.adapt(sizing_);
        ProxyMesh::Snapshot mesh = mesh_.snapshot();
        const Problem problem = on_mesh(mesh.patch, share);
        if (isolated_pins(mesh.patch).size() != pins_.size()) return false;
        Solution solution = spread_pins(problem, radius_, mesh.points, progress_.here());
        if (solution.termination != Termination::converged) return false;
        if (!flipped_by_solution(mesh.patch, solution.points).empty()) return false;
        mesh_.read_back(mesh.patch, solution.points);
        mesh.points = solution.points;
        last_.emplace(Solved{std::move(mesh), std::move(solution)});
        return true;
    }

    std::optional<Solution> projected() {
        const auto& [mesh, solution] = *last_;
        const Problem own = on_mesh(mesh.patch, 1.0);
        const Points normals = measured_surface(own, mesh.points).normals;
        const TargetSurface target(mesh.patch, mesh.points, normals);
        const auto tangential =
            make_tangential_step(problem_.patch, problem_.weights, problem_.fixed_points, progress_.here());
        const Projected best = place(problem_, *tangential, mesh_, mesh, target);
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
    const Progress& progress_;
    Indices pins_;
    ProxyMesh mesh_;
    Sizing sizing_;
    std::optional<Solved> last_;
};

}  // namespace

std::optional<Solution> lead_pins(const Problem& problem, double radius, const Points& start,
                                  const Progress& progress) {
    return LedPins(problem, radius, start, progress).run();
}

}  // namespace fairing
