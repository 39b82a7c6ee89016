#include "stand_in/stand_in.h"

#include "accept/accept.h"
#include "geometry/face_geometry.h"
#include "mesh/nearest_first.h"
#include "placement/relax.h"
#include "placement/tears.h"
#include "problem/surface_state.h"
#include "shape/kinks.h"
#include "start/clamped_fill.h"
#include "start/globalisation.h"
#include "start/loft.h"
#include "start/quick_surface.h"
#include "start/swept_start.h"

namespace fairing {

namespace {

constexpr double largest_growth = 2.0;  // of the area, by the bulge: beyond, it is a balloon or a horn

// In 60 random patches between several loops 58 have a loft that is accepted; with 0.6 alone, and none repaired, 50.
constexpr std::array roundnesses{0.6, 1.5, 4.0};

// The membrane, bent until its energy falls no further; nothing where that is a balloon.
std::optional<Points> least_bent(const Problem& problem, const Progress& progress) {
    Workspace work{make_normal_operator(problem),
                   make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress.here())};
    const Points start = membrane(problem, work);
    Points points = globalise(problem, work, start, progress);
    const Triangles& triangles = problem.patch.triangles;
    if (total_area(points, triangles) > largest_growth * total_area(start, triangles)) return std::nullopt;
    return points;
}

// A share of the bulge; nothing where it is a balloon.
std::optional<Points> surface(const Problem& problem, const Fill& fill, double share) {
    const Patch& patch = problem.patch;
    Points points(3, patch.vertex_count());
    points.rightCols(problem.fixed_points.cols()) = problem.fixed_points;
    points.leftCols(patch.free_count) = fill.flat;
    const double least_area = total_area(points, patch.triangles);
    points.leftCols(patch.free_count) += share * fill.bulge;
    if (total_area(points, patch.triangles) > largest_growth * least_area) return std::nullopt;
    return points;
}

struct Candidate {
    Points points;
    double energy;
    Provenance provenance;
};

Candidate candidate(const Problem& problem, Points points, Provenance provenance) {
    const double energy = willmore_energy(problem, points);
    return {std::move(points), energy, provenance};
}

std::vector<Candidate> candidates(const Problem& problem, const Progress& progress) {
    std::vector<Candidate> found;
    for (const double roundness : roundnesses) {
        const auto loft = Loft::of(problem, roundness, progress);
        if (!loft) continue;
        const Fill fill = loft->over(problem);
        for (const double share : {1.0, 0.75, 0.5, 0.25, 0.0}) {
            if (auto points = surface(problem, fill, share))
                found.push_back(candidate(problem, std::move(*points), Provenance::loft));
        }
    }
    if (auto points = least_bent(problem, progress))
        found.push_back(candidate(problem, std::move(*points), Provenance::least_bent));
    const auto tube = tube_between(problem);
    auto swept = tube && tube->turn() > wide_bend ? swept_start(problem, *tube, progress) : std::nullopt;
    if (swept) found.push_back(candidate(problem, std::move(*swept), Provenance::swept_tube));
    return found;
}

Solution judged(const Problem& problem, const Candidate& candidate) {
    Solution solution = solution_at(problem, candidate.points, candidate.provenance);
    solution.flaw = flaw_of(problem, solution);
    return solution;
}

bool is_accepted(const Solution& solution) { return end_of(solution) == Termination::converged; }

// Where few triangles fold or cross, what lies around them is filled anew: of 134 tubes with noisy ends one has no loft
// without.
std::optional<Solution> repaired(const Problem& problem, const Candidate& candidate, const Solution& flawed) {
    constexpr std::array rings{2, 3, 4};  // around what folds, the fewest first
    if (flawed.bad_triangles.empty() || flawed.bad_triangles.size() > few_folds) return std::nullopt;
    Candidate trial = candidate;
    for (const int reach : rings) {
        trial.points = refilled(problem.patch, candidate.points, flawed.bad_triangles, reach);
        Solution solution = judged(problem, trial);
        if (is_accepted(solution)) return solution;
    }
    return std::nullopt;
}

// The least bent one that is accepted, repaired where none is.
std::optional<Solution> best_of(const Problem& problem, std::vector<Candidate> candidates) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.energy < b.energy; });
    std::vector<std::pair<Candidate, Solution>> flawed;
    for (Candidate& candidate : candidates) {
        Solution solution = judged(problem, candidate);
        if (is_accepted(solution)) return solution;
        flawed.emplace_back(std::move(candidate), std::move(solution));
    }
    for (const auto& [candidate, solution] : flawed) {
        if (auto better = repaired(problem, candidate, solution)) return better;
    }
    return std::nullopt;
}

constexpr int most_rounds = 14;  // 2^-13 D is less than the edges of any patch that is solved

// Half of what it was, or of 2 D, at some vertices; around them no longer than that and the distance there.
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

std::optional<Solution> lofted(const Problem& problem, const Progress& progress) {
    return best_of(problem, candidates(problem, progress));
}

std::optional<Solution> smoothed(const Problem& problem, const Progress& progress) {
    if (!joins_boundaries(problem)) return std::nullopt;
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
