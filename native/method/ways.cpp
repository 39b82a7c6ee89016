#include "method/ways.h"

#include <algorithm>

#include "base/stopwatch.h"
#include "geometry/surface_fit.h"
#include "method/accept.h"
#include "method/least_bent.h"
#include "problem/surface_state.h"

namespace fairing {

namespace {

// Converged ones come first, by what is wrong with them.
Solution best_of(const Problem& problem, std::vector<Solution> found) {
    const auto best = std::min_element(found.begin(), found.end(), [&](const Solution& a, const Solution& b) {
        if (a.flaw != b.flaw) return a.flaw < b.flaw;
        return a.flaw == Flaw::not_converged && less_bent(problem, a, b);
    });
    return std::move(*best);
}

// What a way that gave up early has left open.
void measure(const Problem& problem, Solution& solution) {
    const SurfaceState state = measured_surface(problem, solution.points);
    solution.mean_curvature = state.curvature.mean;
    solution.residual = largest_residual(problem, state, outer_residual(problem, state));
    solution.boundary_normals = one_sided_normals(problem.patch, solution.points);
}

}  // namespace

const Solution* Situation::own_mesh() const {
    const auto last = std::find_if(found.rbegin(), found.rend(), [](const Solution& s) { return s.polished; });
    return last == found.rend() ? nullptr : &*last;
}

bool Situation::attempted(std::string_view strategy) const {
    return std::any_of(attempts.begin(), attempts.end(), [&](const Attempt& a) { return a.strategy == strategy; });
}

bool Situation::produced(std::string_view strategy) const {
    return std::any_of(attempts.begin(), attempts.end(),
                       [&](const Attempt& a) { return a.strategy == strategy && a.produced; });
}

Solution run_ways(std::span<const Way> ways, const Problem& problem, const Progress& progress) {
    Situation situation;
    std::vector<WayTaken> taken;
    for (const Way& way : ways) {
        if (!way.suits(problem, situation)) continue;
        const Stopwatch watch;
        auto solution = way.solve(problem, situation, progress.range(way.begin, way.end));
        taken.push_back({way.name, watch.seconds()});
        situation.attempts.push_back({way.name, solution.has_value()});
        if (!solution) continue;
        solution->ways = taken;
        solution->flaw = flaw_of(problem, *solution);
        if (is_final(problem, *solution)) return std::move(*solution);
        situation.found.push_back(std::move(*solution));
    }
    Solution best = best_of(problem, std::move(situation.found));
    if (best.mean_curvature.size() == 0) measure(problem, best);
    best.ways = std::move(taken);
    return best;
}

}  // namespace fairing
