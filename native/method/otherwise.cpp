#include "method/otherwise.h"

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "base/stopwatch.h"
#include "geometry/face_geometry.h"
#include "geometry/self_intersection.h"
#include "method/accept.h"
#include "method/ladder.h"
#include "variation/least_variation.h"

namespace fairing {

namespace {

constexpr double bulb = 2.0;  // ratio of variations
// Changes of curvature by less than one over the patch's size can't be seen, and ratios of such energies are noise:
// spheres and cylinders have none at all.
constexpr double least_energy = 1.0;
constexpr double begin = 0.9;  // share of the progress; most solves end before

bool has_else(const Problem& problem) {
    const SolverOptions& options = problem.options;
    return options.otherwise == Otherwise::least_variation && options.equation != Equation::minimal &&
           options.equation != Equation::least_variation;
}

bool is_answer(const Solution& solution) { return end_of(solution) == Termination::converged; }

// Whether it may be a bulb at all, which only the tubes between two outlines were seen to be. Where these are long for
// the area between them, what they ask for reaches everywhere: rings and pipes shorter than two and a half radii are
// none.
bool has_room_for_bulb(const Problem& problem, const Solution& solution) {
    constexpr double least_area = 0.2;  // of the sum of the outlines' squared lengths
    const Patch& patch = problem.patch;
    const std::vector<Indices> loops = patch.loops();
    if (loops.size() != 2) return false;
    double squares = 0.0;
    for (const Indices& loop : loops) {
        double length = 0.0;
        for (std::size_t k = 0; k < loop.size(); ++k)
            length += (solution.points.col(loop[k]) - solution.points.col(loop[(k + 1) % loop.size()])).norm();
        squares += length * length;
    }
    FaceGeometry faces;
    faces.update(solution.points, patch.triangles);
    return faces.areas.sum() > least_area * squares;
}

// Solved as a way of its own, after those that the first solution tells of. With `most_energy` only where a coarse mesh
// promises less.
std::optional<Solution> least_variation(const Problem& problem, const Solution& first, double most_energy,
                                        const Progress& progress) {
    const Stopwatch watch;
    std::optional<Solution> even;
    try {
        even = solve_less_varying(problem, most_energy, progress);
    } catch (const SolverError&) {
        return std::nullopt;  // then the first one stays
    }
    if (!even) return std::nullopt;
    even->ways = first.ways;
    even->ways.push_back({"variation", watch.seconds()});
    even->flaw = flaw_of(problem, *even);
    even->instead = true;
    return even;
}

// Of two that are not accepted, whatever is wrong with them.
bool is_better(const Problem& problem, const Solution& even, const Solution& first) {
    if (first.flaw != even.flaw) return even.flaw < first.flaw;
    const auto crossings = [&](const Solution& s) {
        return crossing_triangles(problem.patch.triangles, s.points).size();
    };
    const std::size_t before = crossings(first);
    const std::size_t after = crossings(even);
    if (before != after) return after < before;
    return !(variation_energy(problem, first.points) <= variation_energy(problem, even.points));
}

Solution instead_of_bulb(const Problem& problem, Solution solution, const Progress& progress) {
    const double energy = variation_energy(problem, solution.points);
    if (!(energy > least_energy)) return solution;
    auto even = least_variation(problem, solution, energy / bulb, progress);
    if (!even || !is_answer(*even)) return solution;
    const double least = variation_energy(problem, even->points);
    if (energy <= bulb * least) return solution;
    even->variation_ratio = energy / std::max(least, least_energy);
    return std::move(*even);
}

Solution instead_of_failure(const Problem& problem, Solution solution, const Progress& progress) {
    auto even = least_variation(problem, solution, HUGE_VAL, progress);
    if (even && (is_answer(*even) || is_better(problem, *even, solution))) return std::move(*even);
    if (even) solution.ways = even->ways;
    return solution;
}

}  // namespace

bool lacks_surface(const Solution& solution) {
    const bool cut_short = solution.termination == Termination::iteration_limit || solution.reached_load > 0.0;
    // Vertices that fold on the equation's surface would on another one, too: at 30,000 vertices the try cost 15 s.
    return !is_answer(solution) && !cut_short && solution.flaw != Flaw::folded;
}

Solution solve_or_else(const Problem& problem, const Progress& progress) {
    return or_else(problem, solve_global(problem, progress), progress);
}

Solution or_else(const Problem& problem, Solution solution, const Progress& progress) {
    if (!has_else(problem)) return solution;
    const Progress rest = progress.range(begin, 1.0);
    if (is_answer(solution))
        return has_room_for_bulb(problem, solution) ? instead_of_bulb(problem, std::move(solution), rest) : solution;
    return lacks_surface(solution) ? instead_of_failure(problem, std::move(solution), rest) : solution;
}

std::optional<Solution> solve_else(const Problem& problem, const Progress& progress) {
    auto even = least_variation(problem, {}, HUGE_VAL, progress);
    if (!even || !is_answer(*even)) return std::nullopt;
    return even;
}

}  // namespace fairing
