#include "api/fair.h"

#include <algorithm>
#include <cmath>

#include "api/component.h"
#include "api/diagnose.h"
#include "api/measure.h"
#include "base/stopwatch.h"
#include "geometry/surface_fit.h"
#include "proxy/global_method.h"

namespace fairing {

namespace {

// Leaves out components without fixed vertices; refuses when nothing is left.
std::vector<Patch> solvable_patches(const CheckedMesh& mesh, Diagnostics& warnings) {
    std::vector<Patch> patches = make_patches(mesh.cut, mesh.roles);
    if (patches.empty()) {
        throw MeshError(
            {Code::no_free_vertices, "there is no vertex that may move: all are fixed or on the border", {}});
    }
    Indices closed;
    std::erase_if(patches, [&](const Patch& patch) {
        if (patch.free_count < patch.vertex_count()) return false;
        closed.insert(closed.end(), patch.to_input.begin(), patch.to_input.end());
        return true;
    });
    if (closed.empty()) return patches;
    const std::string text = "a closed component has no fixed vertices to hold it: fix some of them";
    if (patches.empty()) throw MeshError({Code::no_boundary, text, std::move(closed)});
    warnings.push_back({Code::no_boundary, text + "; it was left alone", std::move(closed)});
    return patches;
}

bool reads_reference(InnerFairness kind) { return kind != InnerFairness::uniform && kind != InnerFairness::custom; }

FairOptions with_uniform_fairness(FairOptions options) {
    options.inner_fairness = InnerFairness::uniform;
    return options;
}

class Call {
public:
    Call(const MeshInput& input, const std::optional<Points>& reference, const FairOptions& options)
        : input_(input),
          reference_(reference ? *reference : input.vertices),
          options_(options),
          uniform_options_(with_uniform_fairness(options)) {}

    FairResult run(const ProgressCallback& callback) {
        const Stopwatch watch;
        const Progress progress(callback);
        progress.report(0.0, "topology");
        mesh_ = check_mesh(input_);
        result_.warnings = mesh_.warnings;
        result_.vertices = input_.vertices;
        result_.fixed = mesh_.fixed;
        side_angles_.assign(at(static_cast<int>(input_.vertices.cols())), 0.0);
        solved_curvature_.setZero(input_.vertices.cols());
        solved_sides_.setZero(input_.vertices.cols());
        const std::vector<Patch> patches = solvable_patches(mesh_, result_.warnings);
        result_.seconds["topology"] = watch.seconds();
        double done = 0.0;
        double total = 0.0;
        for (const Patch& patch : patches) total += patch.vertex_count();
        for (const Patch& patch : patches) {
            const double share = patch.vertex_count() / total;
            solve(patch, progress.range(done, done + share));
            done += share;
        }
        finish();
        result_.seconds["total"] = watch.seconds();
        progress.report(1.0, "done");
        return std::move(result_);
    }

private:
    void solve(const Patch& patch, const Progress& progress) {
        const Points fixed_points = gather(input_.vertices, fixed_vertices(patch));
        const Normalisation unit = normalise(fixed_points);
        if (!(unit.diameter > 0.0)) {
            throw MeshError({Code::no_boundary, "a component is held in a single point: fix more of its vertices",
                             Indices(fixed_vertices(patch).begin(), fixed_vertices(patch).end())});
        }
        Problem problem{
            patch, unit.to_unit(fixed_points), gather(mesh_.normals, fixed_vertices(patch)), {}, options_.solver};
        problem.options.load *= std::pow(unit.diameter, 3);
        warn_of_precision(patch, input_.vertices, {unit.diameter, options_.solver.tolerance}, result_.warnings);
        const Solution solution = solve(problem, unit, progress);
        const Points points = unit.from_unit(solution.points);
        if (!points.allFinite()) throw SolverError("the solution is not finite; nothing was changed");
        for (int v = 0; v < patch.free_count; ++v) result_.vertices.col(patch.to_input[at(v)]) = points.col(v);
        // The paper's method leaves H to be measured.
        for (int v = 0; v < solution.mean_curvature.size(); ++v) {
            solved_curvature_[patch.to_input[at(v)]] += solution.mean_curvature[v] / unit.diameter;
            solved_sides_[patch.to_input[at(v)]] += 1.0;
        }
        record(patch, problem, solution);
    }

    Solution solve(Problem& problem, const Normalisation& unit, const Progress& progress) {
        const Patch& patch = problem.patch;
        const Points reference = unit.to_unit(gather(reference_, patch.to_input));
        const bool usable =
            !reads_reference(options_.inner_fairness) || is_usable_reference(patch, reference, result_.warnings);
        const FairOptions& options = usable ? options_ : uniform_options_;
        if (options.method == Method::paper) {
            Solution solution = solve_paper({problem, options.paper, options.inner_fairness, reference,
                                             make_row_weights(patch, reference, options)},
                                            progress);
            solution.boundary_normals = one_sided_normals(patch, solution.points);
            return solution;
        }
        problem.weights = make_lambda(patch, reference, options);
        const Solution solution = solve_global(problem, progress);
        return options.inner_fairness == InnerFairness::uniform ? solution
                                                                : injective(problem, reference, solution, progress);
    }

    // λ may turn triangles over although the surface is smooth: uniform ones then, where they do better.
    Solution injective(Problem& problem, const Points& reference, const Solution& solution, const Progress& progress) {
        if (solution.termination != Termination::converged) return solution;
        Indices flipped = flipped_triangles(problem.patch, solution.points);
        // Needles across a curvature count as turned over in the reference already.
        const bool readable = reads_reference(options_.inner_fairness);
        const std::size_t before = readable ? flipped_triangles(problem.patch, reference).size() : 0;
        if (flipped.size() <= before) return solution;
        problem.weights = make_lambda(problem.patch, reference, uniform_options_);
        Solution uniform = solve_global(problem, progress.here());
        const bool better = uniform.termination == Termination::converged &&
                            flipped_triangles(problem.patch, uniform.points).size() < flipped.size();
        if (!better) return solution;
        result_.warnings.push_back({Code::flipped_triangles,
                                    "the inner fairness asked for turns " + std::to_string(flipped.size()) +
                                        " triangles over; uniform inner fairness was used",
                                    std::move(flipped), ElementKind::triangle});
        return uniform;
    }

    // Level counts of several components are added up, counted from the finest level.
    void add_levels(Indices counts) {
        Indices& sum = result_.levels;
        if (counts.size() > sum.size()) std::swap(counts, sum);
        for (std::size_t k = 1; k <= counts.size(); ++k) sum[sum.size() - k] += counts[counts.size() - k];
    }

    void record(const Patch& patch, const Problem& problem, const Solution& solution) {
        result_.residual = std::max(result_.residual, solution.residual);
        result_.initial_residual = std::max(result_.initial_residual, solution.initial_residual);
        result_.iterations = std::max(result_.iterations, solution.iterations);
        result_.polished = result_.polished && solution.polished && solution.termination == Termination::converged;
        add_levels(solution.levels.empty() ? Indices{patch.vertex_count()} : solution.levels);
        for (const auto& [stage, seconds] : solution.seconds) result_.seconds[stage] += seconds;
        if (solution.termination != Termination::converged) {
            result_.converged = false;
            if (result_.termination != Termination::stalled) result_.termination = solution.termination;
            result_.warnings.push_back(
                {Code::not_converged,
                 "a component of " + std::to_string(patch.free_count) +
                     " free vertices did not converge; its positions are the best that were found",
                 Indices(free_vertices(patch).begin(), free_vertices(patch).end())});
        }
        const bool has_normals = options_.solver.equation != Equation::minimal;
        const Points& prescribed = has_normals ? problem.fixed_normals : solution.boundary_normals;
        const VectorX angles = boundary_angles(patch, solution.boundary_normals, prescribed);
        for (int k = 0; k < angles.size(); ++k) {
            double& angle = side_angles_[at(fixed_vertices(patch)[at(k)])];
            angle = std::max(angle, angles[k]);
        }
        diagnose(patch, solution.points, prescribed, result_.warnings);
    }

    void finish() {
        // Pieces without free vertices are measured; the others' H is the solver's, which may be that of its own mesh.
        const auto boundary =
            options_.solver.equation == Equation::minimal ? BoundaryNormals::one_sided : BoundaryNormals::prescribed;
        result_.mean_curvature = mean_curvature(mesh_, result_.vertices, options_.solver.normals, boundary);
        for (int v = 0; v < solved_sides_.size(); ++v) {
            if (solved_sides_[v] > 0.0) result_.mean_curvature[v] = solved_curvature_[v] / solved_sides_[v];
        }
        result_.boundary_angle.resize(static_cast<Eigen::Index>(result_.fixed.size()));
        for (std::size_t k = 0; k < result_.fixed.size(); ++k) {
            result_.boundary_angle[static_cast<Eigen::Index>(k)] = side_angles_[at(result_.fixed[k])];
        }
    }

    const MeshInput& input_;
    const Points& reference_;
    const FairOptions& options_;
    const FairOptions uniform_options_;
    CheckedMesh mesh_;
    FairResult result_;
    std::vector<double> side_angles_;  // per input vertex, the larger of its sides
    VectorX solved_curvature_;         // per input vertex, summed over the sides that were solved
    VectorX solved_sides_;
};

}  // namespace

FairResult fair(const MeshInput& input, const std::optional<Points>& reference, const FairOptions& options,
                const ProgressCallback& progress) {
    return Call(input, reference, options).run(progress);
}

}  // namespace fairing
