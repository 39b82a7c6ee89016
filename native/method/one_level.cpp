#include "method/one_level.h"

#include <array>

#include "method/direct.h"
#include "method/on_coarse_proxy.h"
#include "method/on_proxy.h"
#include "method/proxy_start.h"
#include "method/sizes.h"

namespace fairing {

namespace {

// A coarse level's vertices would lose which of a tube's surfaces it is.
bool takes_coarse_proxy(const Problem& problem, const std::optional<OwnSurface>& guess) {
    const bool leads = guess && guess->solved && is_tube(problem) && problem.patch.free_count <= largest_direct;
    return is_large(problem) && !leads;
}

std::optional<OwnSurface> guess_from(const Situation& situation) {
    const Solution* own = situation.own_mesh();
    if (!own || !own->points.allFinite()) return std::nullopt;
    return OwnSurface{own->points, own->termination == Termination::converged};
}

}  // namespace

Way directly() {
    return {"direct", [](const Problem&, const Situation&) { return true; },
            [](const Problem& problem, Situation&, const Progress& progress) {
                return std::optional(try_directly(problem, progress));
            },
            0.3, 0.5};
}

Way on_proxy() {
    return {"proxy", [](const Problem&, const Situation&) { return true; },
            [](const Problem& problem, Situation& situation, const Progress& progress) {
                const auto guess = guess_from(situation);
                if (takes_coarse_proxy(problem, guess)) {
                    find_start(problem, situation, progress.here());
                    const bool in_vain = situation.start && !situation.start->found();
                    if (in_vain && !situation.found.empty()) return std::optional<Solution>();
                    if (auto solution = solve_on_coarse_proxy(problem, guess, situation.start, progress))
                        return solution;
                }
                return std::optional(solve_on_proxy(problem, guess, progress));
            },
            0.5, 0.9};
}

Solution solve_on_own_mesh(const Problem& problem, const Progress& progress) {
    return run_ways(std::array{directly()}, problem, progress);
}

}  // namespace fairing
