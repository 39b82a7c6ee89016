#include "variation/least_variation.h"

#include <cstdio>
#include <cstdlib>

#include "base/stopwatch.h"
#include "geometry/surface_fit.h"
#include "proxy/placement.h"
#include "proxy/proxy_mesh.h"
#include "solver/biharmonic_operator.h"
#include "solver/globalisation.h"
#include "solver/minimal_start.h"
#include "solver/normal_fill.h"
#include "solver/surface_state.h"
#include "variation/newton.h"

namespace fairing {

namespace {

constexpr double coarse_growth = 0.5;
constexpr double fine_growth = 0.15;
constexpr double turn = 0.7;

bool debug() {
    static const bool on = std::getenv("VARIATION_DEBUG") != nullptr;
    return on;
}

Problem on_mesh(const Problem& problem, const Patch& patch) {
    return {patch, problem.fixed_points, problem.fixed_normals, uniform_weights(patch), problem.options,
            problem.normal_weights};
}

Workspace make_workspace(const Problem& problem, const Progress& progress) {
    return {std::make_unique<BiharmonicOperator>(problem.patch),
            make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress.here())};
}

double mean_outline_edge(const Problem& problem) {
    const auto place = [&](int v) { return problem.fixed_points.col(v - problem.patch.free_count); };
    double sum = 0.0;
    std::size_t count = 0;
    for (const Indices& loop : problem.patch.loops()) {
        for (std::size_t k = 0; k < loop.size(); ++k)
            sum += (place(loop[k]) - place(loop[(k + 1) % loop.size()])).norm();
        count += loop.size();
    }
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

// The problem with the common lean of each loop's normals taken away: its tubes begin straight.
Problem upright(const Problem& problem) {
    constexpr double most_lean = 0.6;
    Problem result = problem;
    for (const Indices& loop : problem.patch.loops()) {
        Vector3 mean = Vector3::Zero();
        double total = 0.0;
        const auto size = loop.size();
        const auto fixed = [&](std::size_t k) { return loop[k % size] - problem.patch.free_count; };
        for (std::size_t k = 0; k < size; ++k) {
            const double share = (problem.fixed_points.col(fixed(k + 1)) - problem.fixed_points.col(fixed(k + size - 1))).norm();
            mean += share * problem.fixed_normals.col(fixed(k));
            total += share;
        }
        mean /= std::max(total, 1e-300);
        if (mean.norm() > most_lean) continue;
        for (std::size_t k = 0; k < size; ++k) {
            const Vector3 normal = problem.fixed_normals.col(fixed(k)) - mean;
            if (normal.norm() > 1e-3) result.fixed_normals.col(fixed(k)) = normal.normalized();
        }
    }
    return result;
}

struct Solved {
    ProxyMesh::Snapshot mesh;
    Sheet sheet;
    NewtonResult result;
};

Solved solve_on(ProxyMesh& mesh, const Problem& original, const NewtonLimits& limits, const Progress& progress) {
    auto snapshot = mesh.snapshot();
    const Problem problem = on_mesh(original, snapshot.patch);
    Sheet sheet{snapshot.points, fitted_normals(problem, snapshot.points, progress)};
    const VariationEnergy energy(problem, Moving::points_and_normals);
    if (debug()) std::fprintf(stderr, " mesh of %d free\n", snapshot.patch.free_count);
    const NewtonResult result = minimise(energy, sheet, limits, progress);
    mesh.read_back(snapshot.patch, sheet.points);
    return {std::move(snapshot), std::move(sheet), result};
}

}  // namespace

Solution solve_least_variation(const Problem& problem, const Progress& progress) {
    Stopwatch watch;
    const Problem uniform = on_mesh(problem, problem.patch);
    Workspace work = make_workspace(uniform, progress);
    const double edge = mean_outline_edge(problem);
    const double longest_coarse = std::clamp(2.0 * edge, 0.04, 0.15);
    const auto filled = problem.patch.loop_count() > 1 ? normal_fill(upright(uniform), progress.here()) : std::nullopt;
    ProxyMesh mesh(problem.patch, filled ? *filled : membrane(uniform, work));
    const int limit = std::clamp(3 * problem.patch.free_count, 3000, 20000);
    mesh.adapt({coarse_growth, longest_coarse, limit});
    const char* kind = std::getenv("VARIATION_START");
    if (problem.patch.loop_count() > 1 && !(kind && kind[0] == 'w')) {
        for (int k = 0; k < 3; ++k) {
            const auto snapshot = mesh.snapshot();
            const auto points = normal_fill(upright(on_mesh(problem, snapshot.patch)), progress.here());
            if (!points) break;
            mesh.read_back(snapshot.patch, *points);
            mesh.adapt({coarse_growth, longest_coarse, limit, turn});
        }
    } else {
        const auto snapshot = mesh.snapshot();
        const Problem coarse = on_mesh(problem, snapshot.patch);
        Workspace coarse_work = make_workspace(coarse, progress);
        mesh.read_back(snapshot.patch, best_fill(coarse, coarse_work, progress.here()));
        mesh.adapt({coarse_growth, longest_coarse, limit, turn});
    }
    const double start_seconds = watch.lap();
    for (int k = 0; k < 6; ++k) {
        const Solved solved = solve_on(mesh, problem, {1e-3, 12}, progress.here());
        const bool done = solved.result.converged && solved.result.steps <= 2;
        mesh.adapt({coarse_growth, longest_coarse, limit, turn});
        if (done) break;
    }
    const double coarse_seconds = watch.lap();
    const char* scale = std::getenv("VARIATION_FINE");
    const Sizing fine{fine_growth, std::clamp((scale ? std::atof(scale) : 1.0) * edge, 0.01, 0.15), limit, turn};
    mesh.adapt(fine);
    solve_on(mesh, problem, {1e-3, 6}, progress.here());
    mesh.remesh(3, 5);
    const Solved solved =
        solve_on(mesh, problem, {problem.options.tolerance, problem.options.max_iterations}, progress.range(0.5, 0.9));
    const double fine_seconds = watch.lap();
    const TargetSurface target(solved.mesh.patch, solved.sheet.points, solved.sheet.normals);
    Placement placement = first_placement(problem, mesh, solved.mesh, target);
    Workspace own{nullptr, make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress.here())};
    settle(problem, *own.tangential, target, placement, progress.here());
    const Problem proxy = on_mesh(problem, solved.mesh.patch);
    const SurfaceState state = measured_surface(proxy, solved.sheet.points);
    Solution solution;
    solution.points = placement.points;
    solution.mean_curvature = carried_over(placement, target, state.curvature.mean, problem);
    solution.boundary_normals = one_sided_normals(solved.mesh.patch, solved.sheet.points);
    solution.termination = solved.result.converged ? Termination::converged : Termination::stalled;
    solution.polished = false;
    solution.iterations = solved.result.steps;
    solution.residual = solved.result.gradient;
    solution.levels = {solved.mesh.patch.vertex_count()};
    solution.seconds = {{"fill", start_seconds}, {"coarse", coarse_seconds}, {"fine", fine_seconds}, {"place", watch.lap()}};
    return solution;
}

double variation_energy(const Problem& problem, const Points& points) {
    const Points normals = fitted_normals(problem, points, Progress());
    return VariationEnergy(problem, Moving::normals).value({points, normals});
}

}  // namespace fairing
