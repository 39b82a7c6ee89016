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
#include "solver/fill.h"
#include "solver/laplace_operator.h"
#include "solver/surface_state.h"
#include "variation/lift.h"
#include "variation/newton.h"

namespace fairing {

namespace {

constexpr double coarse_growth = 0.2;
double v_damp() { const char* e = std::getenv("V_DAMP"); return e ? std::atof(e) : 1.0; }
double v_edge() { const char* e = std::getenv("V_EDGE"); return e ? std::atof(e) : 1.0; }

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

// Lengths at all vertices: those of the outline's edges, continued harmonically (of their logarithms).
VectorX spacing_of(const Problem& problem, const Stiffness& stiffness, const LaplaceOperator& laplace) {
    const Patch& patch = problem.patch;
    VectorX logarithms = VectorX::Zero(patch.vertex_count());
    for (const Indices& loop : patch.loops()) {
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const auto place = [&](std::size_t m) { return problem.fixed_points.col(loop[m % loop.size()] - patch.free_count); };
            const double length = 0.5 * ((place(k + 1) - place(k)).norm() + (place(k) - place(k + loop.size() - 1)).norm());
            logarithms[loop[k]] = std::log(length + 1e-12);
        }
    }
    const Eigen::RowVectorXd row = logarithms.transpose();
    logarithms.head(patch.free_count) = -laplace.solve(stiffness.apply(patch, row, patch.free_count).transpose());
    return logarithms.array().exp();
}

// Tubes that have collapsed are opened: edges shorter than a share of the spacing want that length.
Points inflated(const Problem& problem, const Points& start, const Progress& progress) {
    constexpr double share = 0.8;
    constexpr int rounds = 60;
    const Patch& patch = problem.patch;
    const Stiffness stiffness = uniform_stiffness(patch);
    LaplaceOperator laplace(patch);
    if (!laplace.update(stiffness, progress.here())) return start;
    const VectorX spacing = spacing_of(problem, stiffness, laplace);
    Points points = start;
    for (int k = 0; k < rounds; ++k) {
        Points rhs = Points::Zero(3, patch.free_count);
        double longest = 0.0;
        for (int e = 0; e < patch.edge_count(); ++e) {
            const auto [i, j] = patch.edge_ends[at(e)];
            const Vector3 edge = points.col(j) - points.col(i);
            const double wanted = share * std::sqrt(spacing[i] * spacing[j]);
            const double stretch = std::max(1.0, wanted / (edge.norm() + 1e-12)) - 1.0;
            const Vector3 pull = stiffness.weights[e] * stretch * edge;
            if (patch.is_free(i)) rhs.col(i) -= pull;
            if (patch.is_free(j)) rhs.col(j) += pull;
        }
        // L (x + d) = L x + div(stretch): from the present x, whose L x is kept
        const Points d = laplace.solve(rhs.transpose()).transpose();
        points.leftCols(patch.free_count) += d;
        longest = d.cwiseAbs().maxCoeff();
        if (longest < 1e-3) break;
    }
    return points;
}

struct Solved {
    ProxyMesh::Snapshot mesh;
    Sheet sheet;
    NewtonResult result;
};

// A solved surface at the vertices of a later state of its mesh.
Sheet resampled(const Solved& solved, const ProxyMesh::Snapshot& fresh) {
    const TargetSurface target(solved.mesh.patch, solved.sheet.points, solved.sheet.normals);
    const Lift lift(solved.mesh.patch, solved.sheet);
    std::vector<int> old_of;
    for (int v = 0; v < solved.mesh.patch.vertex_count(); ++v) {
        const int number = solved.mesh.patch.to_input[at(v)];
        if (number >= static_cast<int>(old_of.size())) old_of.resize(at(number) + 1, none);
        old_of[at(number)] = v;
    }
    const int count = fresh.patch.vertex_count();
    std::vector<int> triangle(at(count), none);
    Indices queue;
    for (int v = 0; v < count; ++v) {
        const int number = fresh.patch.to_input[at(v)];
        if (number < static_cast<int>(old_of.size()) && old_of[at(number)] != none) {
            triangle[at(v)] = target.at_vertex(old_of[at(number)]).triangle;
            queue.push_back(v);
        }
    }
    for (std::size_t k = 0; k < queue.size(); ++k) {
        const int v = queue[k];
        for (int u : fresh.patch.ring(v).vertices) {
            if (triangle[at(u)] != none) continue;
            triangle[at(u)] = triangle[at(v)];
            queue.push_back(u);
        }
    }
    Sheet sheet{fresh.points, Points(3, count)};
    const Eigen::Index fixed = count - fresh.patch.free_count;
    sheet.normals.rightCols(fixed) = solved.sheet.normals.rightCols(fixed);
    for (int v = 0; v < fresh.patch.free_count; ++v) {
        const SurfaceSample sample = lift.sample(target, target.project(fresh.points.col(v), triangle[at(v)]));
        sheet.points.col(v) = sample.point;
        sheet.normals.col(v) = sample.normal;
    }
    return sheet;
}

Solved solve_on(ProxyMesh& mesh, const Problem& original, const std::optional<Solved>& last, const NewtonLimits& limits, const Progress& progress) {
    auto snapshot = mesh.snapshot();
    const Problem problem = on_mesh(original, snapshot.patch);
    Sheet sheet = last ? resampled(*last, snapshot) : Sheet{snapshot.points, fitted_normals(problem, snapshot.points, progress)};
    const VariationEnergy energy(problem, Moving::points_and_normals);
    if (debug()) std::fprintf(stderr, " mesh of %d free\n", snapshot.patch.free_count);
    const NewtonResult result = minimise(energy, sheet, limits, progress);
    mesh.read_back(snapshot.patch, sheet.points);
    return {std::move(snapshot), std::move(sheet), result};
}

// Normals of vertices that were there before.
bool take_normals(const Solved& last, const Patch& patch, Points& normals) {
    std::vector<int> old_of;
    for (int v = 0; v < last.mesh.patch.vertex_count(); ++v) {
        const int number = last.mesh.patch.to_input[at(v)];
        if (number >= static_cast<int>(old_of.size())) old_of.resize(at(number) + 1, none);
        old_of[at(number)] = v;
    }
    normals.resize(3, patch.vertex_count());
    for (int v = 0; v < patch.vertex_count(); ++v) {
        const int number = patch.to_input[at(v)];
        if (number >= static_cast<int>(old_of.size()) || old_of[at(number)] == none) return false;
        normals.col(v) = last.sheet.normals.col(old_of[at(number)]);
    }
    return true;
}

void far_descent(ProxyMesh& mesh, const Problem& original, const Sizing& sizing, const Progress& progress) {
    static const int most = std::getenv("V_FAR") ? std::atoi(std::getenv("V_FAR")) : 40;
    static const double damping0 = std::getenv("V_DAMP") ? std::atof(std::getenv("V_DAMP")) : 1e-3;
    double damping = damping0;
    std::optional<Solved> last;
    for (int k = 0; k < most; ++k) {
        auto snapshot = mesh.snapshot();
        const Problem problem = on_mesh(original, snapshot.patch);
        Sheet sheet{snapshot.points, {}};
        if (!last || !take_normals(*last, snapshot.patch, sheet.normals)) sheet.normals = fitted_normals(problem, snapshot.points, progress);
        const VariationEnergy energy(problem, Moving::points_and_normals);
        const NewtonResult result = minimise(energy, sheet, {1e-3, 1, false, damping}, progress);
        damping = std::clamp(result.share > 0.2 ? 0.3 * damping : 3.0 * damping, 1e-7, 1e-1);
        mesh.read_back(snapshot.patch, sheet.points);
        last.emplace(Solved{std::move(snapshot), std::move(sheet), result});
        if (debug()) std::fprintf(stderr, "far %d free %d E %g rise %g share %g\n", k, last->mesh.patch.free_count, result.energy, result.rise, result.share);
        if (result.share == 1.0 && result.rise < 0.1 && result.energy < 1e3) return;
        if (k % 6 == 5) {
            mesh.adapt(sizing);
            last.reset();
        } else mesh.remesh(2, 2);
    }
}

}  // namespace

Solution solve_least_variation(const Problem& problem, const Progress& progress) {
    Stopwatch watch;
    const Problem uniform = on_mesh(problem, problem.patch);
    Workspace work = make_workspace(uniform, progress);
    const double edge = mean_outline_edge(problem);
    const double longest_coarse = std::clamp(v_edge() * edge, 0.02, 0.15);
    Points first = best_fill(uniform, work, progress.here());
    if (problem.patch.loop_count() > 1) first = inflated(uniform, first, progress);
    ProxyMesh mesh(problem.patch, first);
    const int limit = std::clamp(3 * problem.patch.free_count, 3000, 20000);
    mesh.adapt({coarse_growth, longest_coarse, limit, turn});
    if (std::getenv("VARIATION_STOP")) { Solution s; s.points = first; s.mean_curvature = VectorX::Zero(first.cols()); s.boundary_normals=problem.fixed_normals; return s; }
    const double start_seconds = watch.lap();
    std::optional<Solved> last;
    far_descent(mesh, problem, {coarse_growth, longest_coarse, limit, turn}, progress);
    for (int k = 0; k < 12; ++k) {
        last.emplace(solve_on(mesh, problem, last, {1e-3, k == 0 ? 30 : 15, true, k == 0 ? v_damp() : 1e-3}, progress.here()));
        const bool done = last->result.converged && last->result.steps <= 2;
        mesh.adapt({coarse_growth, longest_coarse, limit, turn});
        if (done) break;
    }
    const double coarse_seconds = watch.lap();
    const char* scale = std::getenv("VARIATION_FINE");
    const Sizing fine{fine_growth, std::clamp((scale ? std::atof(scale) : 1.0) * edge, 0.01, 0.15), limit, turn};
    mesh.adapt(fine);
    const Solved solved =
        solve_on(mesh, problem, last, {problem.options.tolerance, problem.options.max_iterations, false, 1e-6, 1.0}, progress.range(0.5, 0.9));
    const double fine_seconds = watch.lap();
    const TargetSurface target(solved.mesh.patch, solved.sheet.points, solved.sheet.normals);
    Placement placement = first_placement(problem, mesh, solved.mesh, target);
    Workspace own{nullptr, make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress.here())};
    settle(problem, *own.tangential, target, placement, progress.here());
    const Problem proxy = on_mesh(problem, solved.mesh.patch);
    const SurfaceState state = measured_surface(proxy, solved.sheet.points);
    Solution solution;
    solution.points = placement.points;
    const Lift lift(solved.mesh.patch, solved.sheet);
    for (int v = 0; v < problem.patch.free_count; ++v) solution.points.col(v) = lift.sample(target, placement.where[at(v)]).point;
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
