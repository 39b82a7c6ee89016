#include "method/lofted.h"

#include <algorithm>
#include <array>

#include "accept/accept.h"
#include "geometry/spikes.h"
#include "geometry/surface_fit.h"
#include "placement/refill.h"
#include "problem/surface_state.h"
#include "proxy/proxy_solver.h"
#include "start/loft.h"
#include "start/swept_start.h"

namespace fairing {

namespace {

constexpr double largest_growth = 2.0;  // of the area, by the bulge: beyond, it is a balloon or a horn

// Roundness of a loft, and how many times less it must be bent than others to be taken: rounder ones have waists.
struct Kind {
    double roundness;
    double handicap;
};
constexpr std::array kinds{Kind{0.6, 1.0}, Kind{1.5, 1.0}, Kind{4.0, 1.3}};

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
    double merit;
    Provenance provenance;
};

// The tube between two outlines along a wide bend.
std::optional<Candidate> swept(const Problem& problem, const Progress& progress) {
    const auto tube = tube_between(problem);
    auto points = tube && tube->turn() > wide_bend ? swept_start(problem, *tube, progress) : std::nullopt;
    if (!points) return std::nullopt;
    const double merit = willmore_energy(problem, *points);
    return Candidate{std::move(*points), merit, Provenance::swept_tube};
}

std::vector<Candidate> candidates(const Problem& problem, const Progress& progress) {
    std::vector<Candidate> found;
    for (const Kind& kind : kinds) {
        const auto loft = Loft::of(problem, kind.roundness, progress);
        if (!loft) continue;
        const Fill fill = loft->over(problem);
        for (const double share : {1.0, 0.75, 0.5, 0.25, 0.0}) {
            auto points = surface(problem, fill, share);
            if (!points) continue;
            const double merit = kind.handicap * willmore_energy(problem, *points);
            found.push_back({std::move(*points), merit, Provenance::loft});
        }
    }
    return found;
}

// Hairs, where fingers end within the patch, and tips, where many vertices lie in few: finer than the outline shows.
bool is_spiky(const Problem& problem, const Points& points) {
    return has_spike(problem.patch, points, 0.5 * mean_outline_edge(problem));
}

// Its curvature is left open: few are taken.
Solution solution_at(const Problem& problem, const Candidate& candidate) {
    Solution solution;
    solution.points = candidate.points;
    solution.termination = is_spiky(problem, candidate.points) ? Termination::stalled : Termination::converged;
    if (solution.termination != Termination::converged) return solution;
    solution.boundary_normals = one_sided_normals(problem.patch, candidate.points);
    solution.iterations = 1;
    solution.provenance = candidate.provenance;
    solution.flaw = flaw_of(problem, solution);
    return solution;
}

bool is_accepted(const Solution& solution) { return end_of(solution) == Termination::converged; }

Solution measured(const Problem& problem, Solution solution) {
    solution.mean_curvature = measured_surface(problem, solution.points).curvature.mean;
    return solution;
}

// Where few triangles fold or cross, what lies around them is filled anew.
std::optional<Solution> mended(const Problem& problem, const Candidate& candidate, const Solution& flawed) {
    constexpr std::size_t few = 20;
    constexpr std::array rings{2, 3, 4};
    if (flawed.bad_triangles.empty() || flawed.bad_triangles.size() > few) return std::nullopt;
    Candidate trial = candidate;
    for (const int reach : rings) {
        trial.points = refilled(problem.patch, candidate.points, flawed.bad_triangles, reach);
        Solution solution = solution_at(problem, trial);
        if (is_accepted(solution)) return measured(problem, std::move(solution));
    }
    return std::nullopt;
}

// The least bent one that is accepted, mended where none is.
std::optional<Solution> best_of(const Problem& problem, std::vector<Candidate> candidates) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.merit < b.merit; });
    std::vector<std::pair<Candidate, Solution>> flawed;
    for (Candidate& candidate : candidates) {
        Solution solution = solution_at(problem, candidate);
        if (is_accepted(solution)) return measured(problem, std::move(solution));
        flawed.emplace_back(std::move(candidate), std::move(solution));
    }
    for (const auto& [candidate, solution] : flawed) {
        if (auto better = mended(problem, candidate, solution)) return better;
    }
    return std::nullopt;
}

}  // namespace

std::optional<Solution> lofted(const Problem& problem, const Progress& progress) {
    std::vector<Candidate> found = candidates(problem, progress);
    if (auto tube = swept(problem, progress)) found.push_back(std::move(*tube));
    return best_of(problem, std::move(found));
}

}  // namespace fairing
