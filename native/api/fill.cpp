#include "api/fill.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "accept/accept.h"
#include "api/old_surface.h"
#include "base/columns.h"
#include "base/errors.h"
#include "base/parallel.h"
#include "fill/equal_edge_mesh.h"
#include "fill/first_surface.h"
#include "mesh/pieces.h"

namespace fairing {

namespace {

// The vertices of some loops, numbered anew in the loops' order.
struct OutlineData {
    Indices to_input;
    std::vector<Indices> loops;
    Points points;
    Points normals;
};

OutlineData gathered(const OpenLoops& input, std::span<const int> chosen) {
    OutlineData data;
    std::vector<Vector3> normals;
    for (const int l : chosen) {
        Indices& loop = data.loops.emplace_back();
        const Indices& given = input.loops[l];
        for (std::size_t k = 0; k < given.size(); ++k) {
            loop.push_back(static_cast<int>(data.to_input.size()));
            data.to_input.push_back(given[k]);
            normals.emplace_back(input.normals[l].col(static_cast<Eigen::Index>(k)));
        }
    }
    data.points = gather(input.vertices, data.to_input);
    data.normals = as_columns(normals);
    return data;
}

// Triangles and vertices of all parts, the old vertices' numbers first.
class Assembly {
public:
    explicit Assembly(int old_count) : old_count_(old_count) {}

    // `to_input`: of the local vertices from `free_count` on; those before are new.
    void add(const Triangles& triangles, const Points& free_points, std::span<const int> to_input) {
        const int first = old_count_ + static_cast<int>(points_.size());
        const int free_count = static_cast<int>(free_points.cols());
        for (int v = 0; v < free_count; ++v) points_.emplace_back(free_points.col(v));
        for (const auto corners : triangles.colwise()) {
            Eigen::Vector3i& added = triangles_.emplace_back();
            for (int k = 0; k < 3; ++k)
                added[k] = corners[k] < free_count ? first + corners[k] : to_input[corners[k] - free_count];
        }
    }
    void keep(const Eigen::Vector3i& triangle) { triangles_.push_back(triangle); }

    [[nodiscard]] Points points() const { return as_columns(points_); }
    [[nodiscard]] Triangles triangles() const { return as_columns(triangles_); }

private:
    int old_count_;
    std::vector<Vector3> points_;
    std::vector<Eigen::Vector3i> triangles_;
};

using EdgeSet = std::set<std::array<int, 2>>;

EdgeSet sorted_pairs(const VertexPairs& pairs) {
    EdgeSet result;
    for (const auto& [a, b] : pairs) result.insert({std::min(a, b), std::max(a, b)});
    return result;
}

KeptEdges edges_among(const Patch& patch, const EdgeSet& pairs) {
    KeptEdges kept;
    if (pairs.empty()) return kept;
    for (const auto& [a, b] : patch.edge_ends) {
        const auto [low, high] = std::minmax(patch.to_input[a], patch.to_input[b]);
        kept.push_back(pairs.contains({low, high}) ? 1 : 0);
    }
    return kept;
}

}  // namespace

NewSurface fill_loops(const OpenLoops& input, bool bridge, const SolverOptions& options,
                      const ProgressCallback& callback) {
    const Progress progress(callback);
    const Checkpoints checkpoints(progress);
    const int count = static_cast<int>(input.loops.size());
    const int surfaces = bridge ? 1 : count;
    Assembly assembly(static_cast<int>(input.vertices.cols()));
    NewSurface result;
    for (int s = 0; s < surfaces; ++s) {
        const Progress part = progress.range(double(s) / surfaces, double(s + 1) / surfaces);
        part.report(0.0, "triangulation");
        Indices chosen{s};
        for (int l = 1; bridge && l < count; ++l) chosen.push_back(l);
        const OutlineData data = gathered(input, chosen);
        const Normalisation unit = normalise(data.points);
        const Points points = unit.to_unit(data.points);
        const FirstSurface first = first_surface({points, data.normals, data.loops}, options, part.range(0.1, 1.0));
        const int free_count = first.patch.free_count;
        assembly.add(first.patch.triangles, unit.from_unit(first.solution.points.leftCols(free_count)), data.to_input);
        result.converged = result.converged && end_of(first.solution) == Termination::converged;
        const Provenance kind = first.solution.provenance;
        result.provenance = s == 0 || result.provenance == kind ? kind : Provenance::equation;
    }
    result.vertices = assembly.points();
    result.triangles = assembly.triangles();
    return result;
}

NewMesh remesh(const MeshInput& input, const VertexPairs& kept, const WantedLengths& wanted, int threads,
               const ProgressCallback& callback) {
    const Threads team(threads);
    const Progress progress(callback);
    const Checkpoints checkpoints(progress);
    const CheckedMesh mesh = check_mesh(input);
    const std::vector<Patch> patches = patches_with_vertices(mesh);
    Assembly assembly(static_cast<int>(input.vertices.cols()));
    std::vector<char> replaced(static_cast<std::size_t>(input.triangles.cols()), 0);
    const EdgeSet pairs = sorted_pairs(kept);
    NewMesh result;
    std::vector<Vector3> weights;
    std::vector<Vector3> normals;
    for (const Patch& patch : patches) {
        progress.report(static_cast<double>(&patch - patches.data()) / static_cast<double>(patches.size()), "mesh");
        OldSurface old(input, mesh, patch);
        if (wanted.flat) old.normals.setZero();
        const KeptEdges staying = edges_among(patch, pairs);
        const TargetSurface surface(patch, old.points, old.normals, staying);
        const VectorX lengths = old.lengths(wanted, staying);
        EqualEdgeMesh equal(patch, old.points, surface, lengths, staying);
        equal.equalise();
        if (!wanted.flat) equal.repair_angles();
        const EqualEdgeMesh::Result made = equal.result();
        assembly.add(made.triangles, old.unit.from_unit(made.points), fixed_vertices(patch));
        for (const SurfacePoint& where : made.where) {
            result.triangle.push_back(patch.input_triangle[where.triangle]);
            weights.push_back(where.weights);
            normals.push_back(surface.normal(where));
        }
        for (const int v : made.old) result.old.push_back(v == none ? none : patch.to_input[v]);
        for (const int t : patch.input_triangle) replaced[t] = 1;
    }
    for (Eigen::Index t = 0; t < input.triangles.cols(); ++t) {
        if (!replaced[static_cast<std::size_t>(t)]) assembly.keep(input.triangles.col(t));
    }
    result.vertices = assembly.points();
    result.triangles = assembly.triangles();
    result.weights = as_columns(weights);
    result.normals = as_columns(normals);
    progress.report(1.0, "done");
    return result;
}

double expected_remesh_count(const MeshInput& input, const WantedLengths& wanted) {
    const CheckedMesh mesh = check_mesh(input);
    double count = 0.0;
    for (const Patch& patch : patches_with_vertices(mesh)) {
        const OldSurface old(input, mesh, patch);
        count += expected_count(patch, old.points, old.lengths(wanted));
    }
    return count;
}

}  // namespace fairing
