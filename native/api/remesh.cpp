#include "api/remesh.h"

#include <map>

#include "accept/accept.h"
#include "api/assembly.h"
#include "api/component.h"
#include "api/kept_skin.h"
#include "fill/equal_edge_mesh.h"
#include "fill/first_surface.h"
#include "mesh/pieces.h"

namespace fairing {

namespace {

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

// The pairs among some vertices, by their places there.
EdgeSet places_of(const VertexPairs& pairs, std::span<const int> vertices) {
    std::map<int, int> places;
    for (const int v : vertices) places.emplace(v, static_cast<int>(places.size()));
    VertexPairs among;
    for (const auto& [a, b] : pairs) {
        if (places.contains(a) && places.contains(b)) among.push_back({places[a], places[b]});
    }
    return sorted_pairs(among);
}

// The vertices of some loops, numbered anew in the loops' order.
struct BoundaryData {
    Indices to_input;
    std::vector<Indices> loops;
    Points points;
    Points normals;
};

BoundaryData gathered(const OpenLoops& input, std::span<const int> chosen) {
    BoundaryData data;
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

constexpr int most_for_each = 6;               // patterns for each set of corners,
constexpr int most_laid_out = 12;              // of all of them,
constexpr int most_tried = 4;                  // and with all effort, until one has convex quads alone
constexpr Relaxation enough_to_choose{40, 4};  // while patterns are compared
constexpr Relaxation all_effort{200, 60};      // for those that are kept
constexpr double weight_of_size = 0.15;        // beside that of angles, which count most (seeds 11 to 13)
constexpr double same_demerit = 1e-3;  // so that roundoff doesn't choose between patterns that mirror each other

double demerit(const QuadShapes& shapes) {
    return shapes.angle_error + weight_of_size * shapes.size_error + shapes.unfit + 10.0 * shapes.concave;
}

// Those that are best laid out with little effort, best first.
std::vector<CandidatePattern> best_patterns(const FlatMap& map, const QuadLayout& layout, const Progress& progress) {
    std::vector<CandidatePattern> candidates =
        map.is_tube() ? tube_patterns(map.tube(), most_laid_out) : candidate_patterns(map.hole(), most_for_each);
    const auto by_misfit = [](const CandidatePattern& a, const CandidatePattern& b) { return a.misfit < b.misfit; };
    std::stable_sort(candidates.begin(), candidates.end(), by_misfit);
    if (candidates.size() > most_laid_out) candidates.resize(most_laid_out);
    for (CandidatePattern& each : candidates) {
        progress.report(double(&each - candidates.data()) / double(candidates.size()), "quads");
        const double found = demerit(layout.laid_out(each.pattern, enough_to_choose).shapes);
        each.misfit = std::exp2(std::round(std::log2(found) / same_demerit) * same_demerit);
    }
    std::stable_sort(candidates.begin(), candidates.end(), by_misfit);
    if (candidates.size() > most_tried) candidates.resize(most_tried);
    return candidates;
}

// Whether each fixed vertex is passed once by one of the loops: none is a pin, or on a curve inside.
bool is_held_by_loops(const Patch& patch) {
    std::size_t passes = 0;
    std::set<int> passed;
    for (const Indices& loop : patch.loops()) {
        passes += loop.size();
        passed.insert(loop.begin(), loop.end());
    }
    return passes == passed.size() && static_cast<int>(passes) == patch.vertex_count() - patch.free_count;
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
        const std::span<const int> held = std::span(patch.to_input).subspan(patch.free_count);
        EqualEdgeMesh equal(patch, old.points, surface, lengths, staying, places_of(input.taken, held));
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

NewSurface fill_loops(const OpenLoops& input, bool bridge, const std::optional<SolverOptions>& options,
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
        const BoundaryData data = gathered(input, chosen);
        const Normalisation unit = normalise(data.points);
        const Points points = unit.to_unit(data.points);
        const OpenBoundary boundary{points, data.normals, data.loops, places_of(input.taken, data.to_input)};
        const FirstSurface first =
            options ? first_surface(boundary, *options, part.range(0.1, 1.0)) : flat_surface(boundary);
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

QuadMesh quad_mesh(const MeshInput& input, const ProgressCallback& callback) {
    const Progress progress(callback);
    const Checkpoints checkpoints(progress);
    const CheckedMesh mesh = check_mesh(input);
    const std::vector<Patch> patches = patches_with_vertices(mesh);
    QuadMesh result;
    if (patches.size() != 1 || patches.front().loop_count() > 2) return result;
    if (!is_held_by_loops(patches.front())) return result;
    const OldSurface old(input, mesh, patches.front());
    const TargetSurface surface(old.patch, old.points, old.normals);
    const FlatMap map(old.patch, old.points);
    const QuadLayout layout(map, old.patch, old.points, surface);
    std::vector<CandidatePattern> candidates = best_patterns(map, layout, progress.range(0.0, 0.7));
    std::optional<CandidatePattern> best;
    LaidOut laid;
    for (std::size_t k = 0; k < candidates.size() && !best; ++k) {
        laid = layout.laid_out(candidates[k].pattern, all_effort);
        if (laid.shapes.concave == 0.0) best = std::move(candidates[k]);
    }
    if (!best) return result;
    result.shapes = laid.shapes;
    for (const Indices& loop : map.loops()) {
        for (const int v : loop) result.boundary.push_back(old.patch.to_input[v]);
    }
    result.poles = best->poles;
    result.least_poles = best->least_poles;
    const auto count = static_cast<Eigen::Index>(laid.where.size());
    result.vertices = old.unit.from_unit(laid.points.rightCols(count));
    result.normals.resize(3, count);
    result.weights.resize(3, count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const SurfacePoint& where = laid.where[static_cast<std::size_t>(k)];
        result.triangle.push_back(old.patch.input_triangle[where.triangle]);
        result.weights.col(k) = where.weights;
        result.normals.col(k) = surface.normal(where);
    }
    result.pattern = std::move(best->pattern);
    progress.report(1.0, "done");
    return result;
}

}  // namespace fairing
