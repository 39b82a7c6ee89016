#include "api/quad_mesh.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "api/old_surface.h"

namespace fairing {

namespace {

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
