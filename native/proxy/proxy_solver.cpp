#include "proxy/proxy_solver.h"

#include <algorithm>
#include <cmath>

#include "proxy/placement.h"
#include "proxy/proxy_mesh.h"
#include "solver/continuation.h"
#include "solver/surface_state.h"

namespace fairing {

namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

constexpr double coarse_tolerance = 1e-6;  // units of D

// A problem on the proxy's own connectivity: uniform weights, the same boundary data.
Problem proxy_problem(const Problem& problem, const Patch& patch) {
    return {patch, problem.fixed_points, problem.fixed_normals, uniform_weights(patch), problem.options};
}

// Only a start is wanted from the coarse proxy: the harmonic surface, whatever the equation.
Problem coarse_problem(const Problem& problem, const Patch& patch) {
    Problem result = proxy_problem(problem, patch);
    result.options.equation = Equation::harmonic;
    result.options.tolerance = coarse_tolerance;
    return result;
}

Workspace make_workspace(const Problem& problem, const Progress& progress) {
    return {std::make_unique<BiharmonicOperator>(problem.patch),
            TangentialStep(problem.patch, problem.weights, problem.fixed_points, progress.here())};
}

// The fitted surface of a solution, as a target for other vertices.
struct SolvedProxy {
    ProxyMesh::Snapshot mesh;
    Solution solution;
    Points normals;
};

class ProxySolve {
public:
    ProxySolve(const Problem& problem, const Progress& progress) : problem_(problem), progress_(progress) {}

    std::optional<Solution> run(const Points& fill) {
        const int outline = static_cast<int>(problem_.fixed_points.cols());
        for (const int size : {300, 700, 1500}) {
            const int target = std::max(size, outline);
            ProxyMesh mesh(problem_.patch, fill);
            mesh.remesh(5, 5);
            removed_ = mesh.coarsen(target);
            mesh.remesh(5, 5);
            if (solve_coarse(mesh)) {
                auto fine = solve_fine(mesh);
                if (fine) return place(*fine);
            }
            if (target >= problem_.patch.free_count) break;
        }
        return std::nullopt;
    }

private:
    // Flips depend on the surface and the fill on the connectivity: a few rounds of both.
    void refill(ProxyMesh& mesh) {
        constexpr int rounds = 2;
        for (int k = 0; k < rounds; ++k) {
            const auto snapshot = mesh.snapshot();
            const Problem problem = coarse_problem(problem_, snapshot.patch);
            Workspace work = make_workspace(problem, progress_);
            mesh.read_back(snapshot.patch, best_fill(problem, work, progress_.here()));
            mesh.remesh(3, 3);
        }
    }

    bool solve_coarse(ProxyMesh& mesh) {
        refill(mesh);
        descend(mesh);
        const auto snapshot = mesh.snapshot();
        const Problem problem = coarse_problem(problem_, snapshot.patch);
        Workspace work = make_workspace(problem, progress_);
        const Points start = globalise(problem, work, snapshot.points, progress_.here());
        const Solution solution = iterate(problem, work, start, progress_.here());
        if (solution.termination != Termination::converged) return false;
        mesh.read_back(snapshot.patch, solution.points);
        return true;
    }

    void descend(ProxyMesh& mesh) {
        constexpr int most_steps = 40;
        constexpr double done = 5e-3;
        for (int k = 0; k < most_steps; ++k) {
            progress_.report(0.4 * k / most_steps, "descent");
            const auto snapshot = mesh.snapshot();
            const Problem problem = coarse_problem(problem_, snapshot.patch);
            Workspace work = make_workspace(problem, progress_);
            const DescentStep step = descent_step(problem, work, snapshot.points, progress_.here());
            mesh.read_back(snapshot.patch, step.points);
            mesh.remesh(3, 3);
            if (step.length < done) return;
        }
    }

    std::optional<SolvedProxy> solve_fine(ProxyMesh& mesh) {
        constexpr double growth = 0.15;
        mesh.refine(growth, std::max(2 * problem_.patch.free_count, 2000));
        auto snapshot = mesh.snapshot();
        const Problem problem = proxy_problem(problem_, snapshot.patch);
        Workspace work = make_workspace(problem, progress_);
        const Points start = globalise(problem, work, snapshot.points, progress_.range(0.4, 0.5));
        Solution solution = solve_equation(problem, work, start, progress_.range(0.5, 0.8));
        if (solution.termination != Termination::converged) return std::nullopt;
        SurfaceState state;
        state.points = solution.points;
        state.measure_faces(problem.patch);
        state.measure_curvature(problem);
        return SolvedProxy{{std::move(snapshot.patch), solution.points}, std::move(solution), state.normals};
    }

    Solution place(const SolvedProxy& proxy) {
        const TargetSurface target(proxy.mesh.patch, proxy.mesh.points, proxy.normals);
        Indices number(at(problem_.patch.vertex_count()), none);
        for (int v = 0; v < proxy.mesh.patch.vertex_count(); ++v) {
            const int input = proxy.mesh.patch.to_input[at(v)];
            if (input < problem_.patch.vertex_count()) number[at(input)] = v;
        }
        Placement placement = first_placement(problem_, removed_, number, target);
        Workspace work = make_workspace(problem_, progress_);
        relax(problem_, work.tangential, target, placement);
        return polish(proxy, target, placement, work);
    }

    // The discrete equation on the user's own mesh, where it converges near the surface.
    Solution polish(const SolvedProxy& proxy, const TargetSurface& target, const Placement& placement,
                    Workspace& work) {
        constexpr double farthest = 0.05;  // units of D
        Solution polished = iterate(problem_, work, placement.points, progress_.range(0.8, 1.0));
        if (polished.termination == Termination::converged &&
            largest_length(polished.points - placement.points) < farthest) {
            return polished;
        }
        Solution placed = proxy.solution;
        placed.polished = false;
        placed.points = placement.points;
        placed.mean_curvature.resize(problem_.patch.vertex_count());
        for (int v = 0; v < problem_.patch.free_count; ++v) {
            placed.mean_curvature[v] = target.interpolate(proxy.solution.mean_curvature, placement.where[at(v)]);
        }
        placed.mean_curvature.tail(problem_.fixed_points.cols()) =
            proxy.solution.mean_curvature.tail(problem_.fixed_points.cols());
        return placed;
    }

    const Problem& problem_;
    const Progress& progress_;
    std::vector<RemovedVertex> removed_;
};

}  // namespace

std::optional<Solution> solve_on_proxy(const Problem& problem, const Progress& progress) {
    const Problem uniform = proxy_problem(problem, problem.patch);
    Workspace work = make_workspace(uniform, progress);
    const Points fill = best_fill(uniform, work, progress.here());
    return ProxySolve(problem, progress).run(fill);
}

}  // namespace fairing
