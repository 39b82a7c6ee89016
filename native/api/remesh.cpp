#include "api/remesh.h"

#include <algorithm>
#include <array>
#include <set>

#include "api/assembly.h"
#include "api/old_surface.h"
#include "fill/equal_edge_mesh.h"
#include "mesh/pieces.h"

namespace fairing {

namespace {

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
