#include "stand_in/smoothed.h"

#include <algorithm>
#include <limits>

#include "accept/accept.h"
#include "mesh/nearest_first.h"
#include "problem/solution_at.h"
#include "shape/blemishes.h"
#include "start/several_outlines.h"
#include "start/shape_before.h"

namespace fairing {

namespace {

constexpr int most_rounds = 14;  // 2^-13 D is less than the edges of any patch that is solved

// Half of what it was, or of 2 D, at some vertices; around them no longer than that and the way there.
void shorten(const Patch& patch, const Points& before, const Indices& vertices, VectorX& wavelengths) {
    NearestFirst reached(wavelengths);
    for (const int v : vertices) reached.lower(v, 0.5 * std::min(wavelengths[v], 2.0));
    for (int v = reached.next(); v != none; v = reached.next()) {
        for (const int w : patch.ring(v).vertices)
            reached.lower(w, reached[v] + (before.col(v) - before.col(w)).norm());
    }
    wavelengths = std::move(reached).take();
}

// The first without blemishes, or the last one that is not torn.
std::optional<Points> smoothest(const Problem& problem, ShapeBefore& shape, const BlemishFinder& finder,
                                const Progress& progress) {
    VectorX wavelengths = VectorX::Constant(problem.patch.vertex_count(), std::numeric_limits<double>::infinity());
    std::optional<Points> best;
    for (int round = 0; round < most_rounds; ++round) {
        const auto points = shape.smoothed(wavelengths, progress);
        if (!points || !points->allFinite()) return best;
        const Blemishes blemishes = finder.in(*points);
        if (blemishes.torn.empty()) best = *points;
        if (blemishes.absent()) return best;
        shorten(problem.patch, shape.points(), blemishes.all(), wavelengths);
    }
    return best;
}

}  // namespace

std::optional<Solution> smoothed(const Problem& problem, const Progress& progress) {
    if (!joins_outlines(problem)) return std::nullopt;
    auto shape = ShapeBefore::of(problem, progress);
    if (!shape) return std::nullopt;
    const auto points = smoothest(problem, *shape, BlemishFinder(problem, shape->points()), progress);
    if (!points) return std::nullopt;
    Solution solution = solution_at(problem, *points, Provenance::old_shape);
    solution.flaw = flaw_of(problem, solution);
    if (end_of(solution) != Termination::converged) return std::nullopt;
    return solution;
}

}  // namespace fairing
