#include "multigrid/coarsening.h"

#include <deque>

#include "base/background_task.h"

namespace fairing {

namespace {

// Passes are made whole, which keeps the level even: the factor ends up between this and 5.
constexpr double factor = 3.5;
constexpr double least_factor = 1.6;  // a level that shrinks less is not worth its cost
constexpr double least_progress = 0.03;

// A large mesh has no room for what vectors hold in reserve.
void give_back_room(Removals& removals) {
    removals.vertex.shrink_to_fit();
    removals.begin.shrink_to_fit();
    removals.neighbours.shrink_to_fit();
    removals.weights.shrink_to_fit();
}

// Collapses down to a quarter.
Removals collapse_level(CollapseMesh& mesh, int target) {
    Removals removals;
    mesh.begin_level();
    while (mesh.free_count() > target) {
        const int before = mesh.free_count();
        removals.append(mesh.pass());
        if (before - mesh.free_count() < least_progress * before) break;
    }
    give_back_room(removals);
    return removals;
}

}  // namespace

std::vector<CoarseLevel> coarsen(const Patch& patch, const InnerWeights& weights, const FixedPlaces& boundary,
                                 int coarsest) {
    std::deque<CoarseLevel> levels;        // stay where they are
    std::vector<BackgroundTask> patching;  // the rings of levels, while collapses go on; end before `levels`
    CollapseMesh mesh(patch, weights, boundary);
    Indices fine_local(patch.vertex_count());  // vertex of the patch → of the level above
    for (std::size_t v = 0; v < fine_local.size(); ++v) fine_local[v] = static_cast<int>(v);
    int fine_count = patch.vertex_count();
    while (mesh.free_count() > 2 * coarsest) {
        const int free_before = mesh.free_count();
        Transfer transfer;
        const int target = static_cast<int>(free_before / factor);
        transfer.removals = collapse_level(mesh, target);
        if (mesh.free_count() * least_factor > free_before) break;
        for (int& v : transfer.removals.vertex) v = fine_local[v];
        for (int& v : transfer.removals.neighbours) v = fine_local[v];
        transfer.fine_count = fine_count;
        CoarseMesh coarse = mesh.mesh();
        transfer.coarse_free_count = coarse.members.free_count;
        Indices local(patch.vertex_count(), none);
        const Indices& vertices = coarse.members.to_input;
        for (std::size_t c = 0; c < vertices.size(); ++c) {
            const int v = vertices[c];
            transfer.coarse_in_fine.push_back(fine_local[v]);
            local[v] = static_cast<int>(c);
        }
        InnerWeights level_weights = mesh.weights();
        for (auto& edge : level_weights) {
            edge.i = local[edge.i];
            edge.j = local[edge.j];
        }
        fine_count = static_cast<int>(vertices.size());
        fine_local = std::move(local);
        levels.push_back({Patch({}), std::move(level_weights), std::move(transfer)});
        auto make = [&level = levels.back().patch, parts = std::move(coarse)]() mutable {
            level = Patch(std::move(parts.members), std::move(parts.twins));
        };
        patching.emplace_back(std::move(make));
    }
    for (BackgroundTask& work : patching) work.finish();
    return {std::make_move_iterator(levels.begin()), std::make_move_iterator(levels.end())};
}

std::vector<CoarseLevel> coarsen(const Patch& patch, const InnerWeights& weights) {
    constexpr int smallest_base = 40;  // free vertices: Fig. 1 of the paper with fewer starts from no surface
    const Points whole_loops = Points::Zero(3, patch.vertex_count());
    const int base = std::max(smallest_base, patch.vertex_count() - patch.free_count);
    return coarsen(patch, weights, {whole_loops, whole_loops}, base);
}

}  // namespace fairing
