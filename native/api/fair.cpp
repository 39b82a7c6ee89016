#include "api/fair.h"

#include "accept/accept.h"
#include "api/diagnose.h"
#include "api/fair_solver.h"
#include "api/measure.h"
#include "api/shape.h"
#include "base/errors.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "geometry/vertex_normal.h"
#include "shape/visible_join.h"

namespace fairing {

namespace {

class Call {
public:
    Call(const PreparedMesh& prepared, const MeshInput& input, const FairOptions& options)
        : prepared_(prepared), options_(options) {
        result_.vertices = input.vertices;
        if (options.detail.share > 0.0) result_.base = input.vertices;
        result_.fixed = prepared.mesh.fixed;
        const Equation asked = options.solver.equation;
        result_.equation = asked == Equation::automatic ? Equation::harmonic : asked;
        for (const Diagnostics* list :
             {&prepared.mesh.topology_warnings, &prepared.mesh.warnings, &prepared.closed_components}) {
            add_warnings(*list);
        }
        side_angles_.setZero(input.vertices.cols());
        side_joins_.setZero(input.vertices.cols());
        solved_curvature_.setZero(input.vertices.cols());
        solved_sides_.setZero(input.vertices.cols());
    }

    void record(const Patch& patch, const ComponentAnswer& answer) {
        add_warnings(answer.warnings);
        write_back(patch, answer);
        const Solution& solution = answer.solution;
        result_.provenance = std::max(result_.provenance, solution.provenance);
        if (stands_in(solution.provenance)) result_.equation = Equation::least_variation;
        const bool is_beside = solution.provenance == Provenance::low_passed;
        if (stands_in(solution.provenance) || (is_beside && end_of(solution) == Termination::converged))
            result_.warnings.push_back(no_solution(answer.problem, solution));
        note_equation(answer.problem.options.equation);
        result_.residual = std::max(result_.residual, solution.residual);
        result_.initial_residual = std::max(result_.initial_residual, solution.initial_residual);
        result_.iterations = std::max(result_.iterations, solution.iterations);
        result_.polished = result_.polished && solution.polished && end_of(solution) == Termination::converged;
        result_.joins_curvature =
            result_.joins_curvature && (solution.join == Join::curvature || solution.join == Join::partly_curvature);
        warn_of_join(patch, solution, result_.warnings);
        warn_of_pins(patch, solution, result_.warnings);
        add_levels(solution.levels.empty() ? Indices{patch.vertex_count()} : solution.levels);
        for (const auto& [stage, seconds] : solution.seconds) result_.seconds[stage] += seconds;
        result_.strategies.insert(result_.strategies.end(), solution.strategies.begin(), solution.strategies.end());
        const bool has_normals = options_.solver.equation != Equation::soap_film;
        const Points& prescribed = has_normals ? answer.problem.fixed_normals : solution.boundary_normals;
        const VectorX angles = boundary_angles(patch, solution.boundary_normals, prescribed);
        add_largest(patch, angles, side_angles_);
        add_largest(patch, one_sided_join(patch, solution.points, prescribed), side_joins_);
        if (const Termination end = end_of(solution); end != Termination::converged) {
            add_failure(end, failures_of(patch, solution, end, angles));
        }
        diagnose(patch, solution, prescribed, result_.warnings);
        const Stopwatch watch;
        if (is_between_tubes(patch, solution.points, prescribed))
            note_girth(patch, girth_range(patch, solution.points));
        result_.seconds["girth"] += watch.seconds();
    }

    FairResult finish() {
        measure_rest();
        for (int v = 0; v < solved_sides_.size(); ++v) {
            if (solved_sides_[v] > 0.0) result_.mean_curvature[v] = solved_curvature_[v] / solved_sides_[v];
        }
        result_.boundary_angle = side_angles_(result_.fixed);
        result_.join = side_joins_(result_.fixed);
        return std::move(result_);
    }

private:
    void add_warnings(const Diagnostics& warnings) {
        result_.warnings.insert(result_.warnings.end(), warnings.begin(), warnings.end());
    }

    void write_back(const Patch& patch, const ComponentAnswer& answer) {
        const Points points = answer.unit.from_unit(answer.solution.points);
        if (!points.allFinite()) throw SolverError("the solution is not finite; nothing was changed");
        const auto free = free_vertices(patch);
        result_.vertices(Eigen::all, free) = points.leftCols(patch.free_count);
        if (result_.base.cols() > 0) result_.base(Eigen::all, free) = points.leftCols(patch.free_count);
        const std::vector<char>& moved = answer.problem.free_edge;
        for (int k = 0; k < static_cast<int>(moved.size()); ++k) {
            if (moved[k]) result_.vertices.col(fixed_vertices(patch)[k]) = points.col(patch.free_count + k);
        }
        if (answer.dressed) write_dressed(patch, *answer.dressed);
        // The paper's method leaves H to be measured.
        const VectorX& H = answer.solution.mean_curvature;
        for (int v = 0; v < H.size(); ++v) {
            solved_curvature_[patch.to_input[v]] += H[v] / answer.unit.diameter;
            solved_sides_[patch.to_input[v]] += 1.0;
        }
    }

    void write_dressed(const Patch& patch, const Dressed& dressed) {
        const Points shown = dressed.base + dressed.detail;
        result_.vertices(Eigen::all, free_vertices(patch)) = shown.leftCols(patch.free_count);
        if (result_.base.cols() > 0) result_.base(Eigen::all, patch.to_input) = dressed.base;
    }

    // Level counts of several components are added up, counted from the finest level.
    void add_levels(Indices counts) {
        Indices& sum = result_.levels;
        if (counts.size() > sum.size()) std::swap(counts, sum);
        for (std::size_t k = 1; k <= counts.size(); ++k) sum[sum.size() - k] += counts[counts.size() - k];
    }

    // Free slopes or long tubes have changed it. Of several, least variation is named.
    void note_equation(Equation solved) {
        if (solved == options_.solver.equation || result_.equation == Equation::least_variation) return;
        result_.equation = solved;
    }

    void note_girth(const Patch& patch, const std::optional<GirthRange>& girth) {
        if (girth) result_.girth = worst_of(result_.girth.value_or(GirthRange{}), by_input(patch, *girth));
    }

    void add_failure(Termination end, const Diagnostics& failures) {
        result_.converged = false;
        if (result_.termination != Termination::stalled) result_.termination = end;
        add_warnings(failures);
    }

    // `values`: at the patch's fixed vertices; `largest`: of all sides so far, at input vertices.
    static void add_largest(const Patch& patch, const VectorX& values, VectorX& largest) {
        for (int k = 0; k < values.size(); ++k) {
            double& here = largest[fixed_vertices(patch)[k]];
            here = std::max(here, values[k]);
        }
    }

    // H of pieces without free vertices, and of all where the solver leaves it open; elsewhere it is the solver's,
    // which may be that of its own mesh.
    void measure_rest() {
        const std::vector<char>& used = prepared_.mesh.roles.used;
        bool all_known = true;
        for (int v = 0; v < solved_sides_.size(); ++v) {
            all_known = all_known && (!used[v] || solved_sides_[v] > 0.0);
        }
        if (all_known) {
            result_.mean_curvature.setZero(solved_sides_.size());
            return;
        }
        const auto boundary = options_.solver.equation == Equation::soap_film ? NormalsAtBoundary::one_sided
                                                                              : NormalsAtBoundary::prescribed;
        const NormalKind kind = options_.solver.normals;
        result_.mean_curvature =
            prepared_.is_all_patches
                ? mean_curvature(prepared_.patches, prepared_.mesh.normals, result_.vertices, kind, boundary)
                : mean_curvature(prepared_.mesh, result_.vertices, kind, boundary);
    }

    const PreparedMesh& prepared_;
    const FairOptions& options_;
    FairResult result_;
    VectorX side_angles_;       // per input vertex, the larger of its sides
    VectorX side_joins_;        // likewise
    VectorX solved_curvature_;  // per input vertex, summed over the sides that were solved
    VectorX solved_sides_;
};

void prepare_for(const MeshInput& input, const FairOptions& options, std::unique_ptr<PreparedMesh>& prepared) {
    const auto count = static_cast<std::size_t>(input.vertices.cols());
    if (prepared && prepared->finite && prepared->mesh.roles.used.size() == count && input.vertices.allFinite()) {
        check_geometry(input, prepared->mesh);
        return;
    }
    prepared = prepare(input, options);
}

// Read again by repeated calls only: a large mesh has no room for it during the solve.
void let_go(MeshInput& input, PreparedMesh& prepared) {
    input.triangles.resize(3, 0);
    if (prepared.is_all_patches) prepared.mesh.cut = {};
}

// Patches are solved one after the other.
int largest_free_count(const std::vector<Patch>& patches) {
    int largest = 0;
    for (const Patch& patch : patches) largest = std::max(largest, patch.free_count);
    return largest;
}

Points first_surfaces(PreparedMesh& prepared, const ComponentData& data, const Progress& progress) {
    Points vertices = data.vertices;
    for (std::size_t k = 0; k < prepared.patches.size(); ++k) {
        const Patch& patch = prepared.patches[k];
        const Points points = prepared.solvers[k].first_surface(data, progress.here());
        vertices(Eigen::all, free_vertices(patch)) = points.leftCols(patch.free_count);
        for (int v = patch.free_count; v < patch.vertex_count(); ++v) {
            if (data.faired[patch.to_input[v]]) vertices.col(patch.to_input[v]) = points.col(v);
        }
    }
    return vertices;
}

}  // namespace

FairResult run_call(MeshInput& input, const std::optional<View<Points>>& reference, const FairOptions& options,
                    std::unique_ptr<PreparedMesh>& prepared, const ProgressCallback& callback, const Preview& preview) {
    const Stopwatch watch;
    const Threads threads(options.threads);
    const Progress progress(callback);
    const Checkpoints checkpoints(progress);
    progress.report(0.0, "topology");
    prepare_for(input, options, prepared);
    if (!options.repeated) let_go(input, *prepared);
    check_memory(largest_free_count(prepared->patches));
    std::optional<Call> call;  // made after the first solve, which needs the room
    const double topology_seconds = watch.seconds();
    const ComponentData data{
        input.vertices, prepared->mesh.normals,          prepared->mesh.curvatures,  reference.value_or(input.vertices),
        input.outside,  input.fixed_normals.has_value(), prepared->mesh.roles.faired};
    if (preview) preview(first_surfaces(*prepared, data, progress));
    double done = 0.1;  // of the time in a large call; all patches take eight tenths of it
    double total = 0.0;
    for (const Patch& patch : prepared->patches) total += patch.vertex_count();
    for (std::size_t k = 0; k < prepared->patches.size(); ++k) {
        const Patch& patch = prepared->patches[k];
        const double share = 0.8 * patch.vertex_count() / total;
        const ComponentAnswer answer = prepared->solvers[k].solve(data, progress.range(done, done + share));
        if (!call) call.emplace(*prepared, input, options);
        call->record(patch, answer);
        done += share;
    }
    FairResult result = call->finish();
    result.seconds["topology"] = topology_seconds;
    result.seconds["total"] = watch.seconds();
    progress.report(1.0, "done");
    return result;
}

FairResult fair(MeshInput input, const std::optional<View<Points>>& reference, const FairOptions& options,
                const ProgressCallback& progress, const Preview& preview) {
    std::unique_ptr<PreparedMesh> prepared;
    return run_call(input, reference, options, prepared, progress, preview);
}

}  // namespace fairing
