#include "api/new_patch.h"

#include <set>
#include <tuple>

#include "api/hole_job.h"
#include "api/inner_vertices.h"
#include "api/measure.h"
#include "base/errors.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "fill/proportion.h"
#include "mesh/edges.h"
#include "mesh/loops.h"

namespace fairing {

namespace {

constexpr int least_solved = 1000;  // new vertices: smaller meshes are cut from a finer old one's surface

using EdgeSet = std::set<std::array<int, 2>>;

std::vector<Indices> loops_of(const Triangles& triangles) {
    return boundary_loops(triangles, triangles.size() > 0 ? triangles.maxCoeff() + 1 : 0);
}

Indices border_of(const Triangles& triangles) {
    std::set<int> border;
    for (const Indices& loop : loops_of(triangles)) border.insert(loop.begin(), loop.end());
    return {border.begin(), border.end()};
}

// About how many vertices of a new mesh are new: by Euler's formula half as many as the boundary has are not.
double expected_new(const HolePatch& patch, const WantedLengths& wanted) {
    const Indices component =
        component_of_triangles(patch.triangles, patch.fixed, static_cast<int>(patch.vertices.cols()));
    Indices mine;
    for (int t = 0; t < static_cast<int>(component.size()); ++t)
        if (component[t] != none) mine.push_back(t);
    double border = 0.0;
    for (const Indices& loop : loops_of(patch.triangles(Eigen::all, mine))) border += static_cast<double>(loop.size());
    return expected_remesh_count(patch.input({}), wanted) - 0.5 * border;
}

// Edges of the new mesh between the old vertices of a kept edge, or new ones in their places.
VertexPairs edges_again(const NewPatch& made, int old_count, const VertexPairs& kept) {
    EdgeSet held;
    for (const auto& [a, b] : kept) held.insert({std::min(a, b), std::max(a, b)});
    const auto name = [&](int v) { return v < old_count ? v : made.old[v - old_count]; };
    VertexPairs edges;
    for (int side = 0; side < static_cast<int>(made.triangles.size()) && !held.empty(); ++side) {
        const int a = side_tail(made.triangles, side);
        const int b = side_head(made.triangles, side);
        const int one = name(a);
        const int other = name(b);
        if (held.contains({std::min(one, other), std::max(one, other)})) edges.push_back({a, b});
    }
    return edges;
}

// Triangles around a patch and its own. Those between fixed vertices lie around it, unless that leaves most of these
// without any: single triangles at the boundary's corners.
std::pair<Triangles, Triangles> parted(const View<Points>& points, const Triangles& triangles, const Indices& fixed) {
    std::vector<char> held(static_cast<std::size_t>(points.cols()), 0);
    for (const int v : fixed)
        if (v >= 0 && v < static_cast<int>(held.size())) held[v] = 1;  // fair() names others
    Indices idle;
    Indices own;
    std::set<int> beside_idle;
    std::set<int> beside_own;
    for (int t = 0; t < static_cast<int>(triangles.cols()); ++t) {
        const Eigen::Vector3i corners = triangles.col(t);
        const bool is_idle = held[corners[0]] != 0 && held[corners[1]] != 0 && held[corners[2]] != 0;
        if (is_idle && !points(Eigen::all, corners).allFinite()) continue;
        (is_idle ? idle : own).push_back(t);
        for (const int v : corners)
            if (held[v] != 0) (is_idle ? beside_idle : beside_own).insert(v);
    }
    const auto both = std::ranges::count_if(beside_idle, [&](int v) { return beside_own.contains(v); });
    if (idle.empty() || 2 * both < static_cast<std::ptrdiff_t>(beside_own.size())) return {Triangles(3, 0), triangles};
    return {triangles(Eigen::all, idle), triangles(Eigen::all, own)};
}

class Job {
public:
    Job(const MeshInput& input, const VertexPairs& kept, const NewPatchOptions& options, const Progress& progress)
        : input_(input),
          kept_(kept),
          options_(options),
          progress_(progress),
          old_count_(static_cast<int>(input.vertices.cols())),
          refined_(with_inner_vertices(input.vertices, input.triangles, input.fixed, kept)),
          points_(refined_ ? refined_->vertices : Points(input.vertices)),
          triangles_(refined_ ? refined_->triangles : input.triangles) {}

    NewPatch made() {
        const Indices border = border_of(triangles_);
        const Limit most = Limit::of(flat_count(), options_.max_vertices);
        most.check(most.flat, border);
        FairResult report = faired({points_, triangles_, input_.fixed, input_.fixed_normals}, Start::boundary,
                                   input_.fixed_curvatures, progress_.range(0.0, 0.4));
        const double first_seconds = watch_.lap();
        SolvedHole solved{surface_of(report), std::move(report)};
        most.check(expected_new(solved.patch, options_.wanted), border);
        NewPatch result;
        const HolePatch patch = meshed(solved, result);
        const double mesh_seconds = watch_.lap();
        relax(solved, patch, result);
        result.report.seconds["first"] = first_seconds;
        result.report.seconds["mesh"] = mesh_seconds;
        result.report.seconds["total"] = watch_.seconds();
        return result;
    }

private:
    [[nodiscard]] bool has_curves() const { return !kept_.empty() || !input_.held.creases.empty(); }

    // 0 where fair() will say why there is no surface.
    [[nodiscard]] double flat_count() const {
        try {
            const Indices fixed = input_.fixed ? *input_.fixed : border_of(triangles_);
            return expected_new({points_, triangles_, fixed, input_.fixed ? input_.fixed_normals : std::nullopt},
                                options_.wanted);
        } catch (const MeshError&) {
            return 0.0;
        }
    }

    [[nodiscard]] FairResult faired(MeshInput patch, Start start, const std::optional<VectorX>& curvatures,
                                    const Progress& progress) const {
        HolePatch side;
        std::tie(patch.outside, side.triangles) = surroundings(patch);
        patch.fixed_curvatures = curvatures;
        patch.held = input_.held;
        FairOptions options = options_.fair;
        options.start = start;
        const Triangles outside = patch.outside;
        FairResult report = fair(std::move(patch), {}, options, within(progress));
        measure_join(report, side, outside);
        return report;
    }

    [[nodiscard]] std::pair<Triangles, Triangles> surroundings(const MeshInput& patch) const {
        if (input_.outside.cols() > 0) return {input_.outside, patch.triangles};
        return parted(patch.vertices, patch.triangles, patch.fixed ? *patch.fixed : Indices());
    }

    // Without normals given those of the old triangles are kept.
    [[nodiscard]] HolePatch surface_of(const FairResult& report) const {
        if (input_.fixed && input_.fixed_normals)
            return {report.vertices, triangles_, *input_.fixed, input_.fixed_normals};
        const Points normals = vertex_normals({points_, triangles_, {}, {}}, NormalKind::averaged);
        return {report.vertices, triangles_, report.fixed, Points(normals(Eigen::all, report.fixed))};
    }

    HolePatch meshed(SolvedHole& solved, NewPatch& result) const {
        const Progress progress = progress_.range(0.4, 0.6);
        if (options_.in_rows && !has_curves()) {
            if (auto rows = rows_over(solved.patch, old_count_, progress)) {
                result.triangle = std::move(rows->triangle);
                result.weights = std::move(rows->weights);
                result.old.assign(result.triangle.size(), none);
                result.pairs = std::move(rows->pairs);
                return std::move(rows->patch);
            }
        }
        NewMesh mesh =
            remesh(solved.patch.input(input_.held), kept_, options_.wanted, options_.fair.threads, within(progress));
        const auto all = static_cast<int>(points_.cols());
        HolePatch patch{joined(solved.patch.vertices.leftCols(old_count_), mesh.vertices),
                        mesh.triangles.unaryExpr([&](int v) { return v < all ? v : v - (all - old_count_); }),
                        solved.patch.fixed, solved.patch.normals};
        result.triangle = std::move(mesh.triangle);
        result.weights = std::move(mesh.weights);
        result.old = std::move(mesh.old);
        return patch;
    }

    void relax(SolvedHole& solved, const HolePatch& patch, NewPatch& result) const {
        const auto added = patch.vertices.cols() - old_count_;
        const std::set<int> used(triangles_.reshaped().begin(), triangles_.reshaped().end());
        const std::set<int> fixed(solved.report.fixed.begin(), solved.report.fixed.end());
        const auto free = std::ranges::count_if(used, [&](int v) { return !fixed.contains(v); });
        result.triangles = patch.triangles;
        result.is_cut = added < std::min<Eigen::Index>(least_solved, free);
        if (result.is_cut) {
            solved = cut_from(solved, patch, result.triangle, result.weights);
        } else {
            solved.report =
                faired(patch.input({}), Start::given, curvatures_at(patch.fixed), progress_.range(0.6, 1.0));
            solved.patch = patch;
            solved.patch.vertices = solved.report.vertices;
        }
        result.vertices = solved.patch.vertices.rightCols(added);
        result.report = std::move(solved.report);
        result.report.mean_curvature = VectorX(result.report.mean_curvature.tail(added));
        if (options_.in_rows && !result.pairs) {
            result.report.warnings.push_back(
                has_curves() ? no_rows(border_of(triangles_), "curves", "edges that stay run through it")
                             : no_rows(border_of(triangles_), "shape", "no pattern fits its corners"));
            result.pairs = pairs_among(solved, edges_again(result, old_count_, kept_));
        }
        result.report.vertices.resize(3, 0);
        result.report.base.resize(3, 0);
        if (refined_) lay_on_given(result);
    }

    // The curvatures given, and unknown ones where the border's vertices follow.
    [[nodiscard]] std::optional<VectorX> curvatures_at(const Indices& fixed) const {
        if (!input_.fixed_curvatures) return std::nullopt;
        VectorX all =
            VectorX::Constant(static_cast<Eigen::Index>(fixed.size()), std::numeric_limits<double>::quiet_NaN());
        all.head(input_.fixed_curvatures->size()) = *input_.fixed_curvatures;
        return all;
    }

    void lay_on_given(NewPatch& result) const {
        for (Eigen::Index k = 0; k < result.weights.cols(); ++k) {
            int& t = result.triangle[k];
            result.weights.col(k) = refined_->corners.middleCols<3>(3 * t) * Vector3(result.weights.col(k));
            t = refined_->parent[t];
        }
    }

    const MeshInput& input_;
    const VertexPairs& kept_;
    const NewPatchOptions& options_;
    Progress progress_;
    int old_count_;
    std::optional<RefinedPatch> refined_;
    Points points_;
    Triangles triangles_;
    Stopwatch watch_;
};

}  // namespace

NewPatch new_patch(const MeshInput& input, const VertexPairs& kept, const NewPatchOptions& options,
                   const ProgressCallback& callback) {
    const Threads team(options.fair.threads);
    const Progress progress(callback);
    const Checkpoints checkpoints(progress);
    return Job(input, kept, options, progress).made();
}

}  // namespace fairing
