#include "api/fill.h"

#include <atomic>

#include "api/hole_job.h"
#include "base/errors.h"
#include "base/parallel.h"

namespace fairing {

namespace {

FilledHole left_open(const Hole& hole, Diagnostic reason) {
    FilledHole left;
    for (const BoundaryLoop& loop : hole.loops) left.loops.push_back(loop.vertices);
    left.left_because = std::move(reason);
    return left;
}

Diagnostic breakdown(const Hole& hole, const SolverError& error) {
    Indices vertices = hole.loops[0].vertices;
    std::sort(vertices.begin(), vertices.end());
    return {Code::no_solution, error.what(), std::move(vertices), ElementKind::vertex, {{"breakdown", 1.0}}};
}

// A hole that no other one waits for: what can't be filled is left open.
FilledHole filled_or_left(const HoleJob& job, const Hole& hole, const Progress& progress) {
    try {
        return job.filled(progress);
    } catch (const MeshError& error) {
        return left_open(hole, error.diagnostic());
    } catch (const SolverError& error) {
        return left_open(hole, breakdown(hole, error));
    }
}

}  // namespace

std::vector<FilledHole> fill(const HoledMesh& mesh, const std::vector<Hole>& holes,
                             const std::vector<std::optional<CurvesThrough>>& through, const FillOptions& options,
                             const ProgressCallback& callback) {
    constexpr double large = 2000.0;  // new vertices from which a hole takes all threads
    const Threads team(options.fair.threads);
    const Progress progress(callback);
    const Checkpoints checkpoints(progress);
    const auto curves = [&](std::size_t k) { return k < through.size() && through[k] ? &*through[k] : nullptr; };
    if (holes.size() == 1) return {HoleJob(mesh, holes[0], curves(0), options).filled(progress)};
    FillOptions alone = options;
    alone.fair.threads = 1;
    std::vector<FilledHole> result(holes.size());
    std::vector<char> is_large(holes.size(), 0);
    std::atomic<int> done = 0;
    const auto count = static_cast<double>(holes.size());
    run_pieces(static_cast<int>(holes.size()), [&](int k) {
        const HoleJob job(mesh, holes[k], curves(k), alone);
        is_large[k] = job.flat_count() > large ? 1 : 0;
        if (is_large[k]) return;
        result[k] = filled_or_left(job, holes[k], {});
        progress.report(++done / count, "holes");
    });
    for (std::size_t k = 0; k < holes.size(); ++k) {
        if (!is_large[k]) continue;
        const Progress part = progress.range(done / count, (done + 1) / count);
        result[k] = filled_or_left(HoleJob(mesh, holes[k], curves(k), options), holes[k], part);
        ++done;
    }
    const auto is_left = [](const FilledHole& hole) { return hole.left_because.has_value(); };
    if (!result.empty() && std::all_of(result.begin(), result.end(), is_left))
        throw MeshError(*result.front().left_because);
    return result;
}

}  // namespace fairing
