#include "method/ladder.h"

#include <algorithm>
#include <array>

#include "method/accept.h"
#include "method/direct.h"
#include "method/eased.h"
#include "method/even.h"
#include "method/nested.h"
#include "method/one_level.h"
#include "method/proxy_start.h"
#include "method/sizes.h"
#include "variation/least_variation.h"

namespace fairing {

namespace {

using Found = std::optional<Solution>;

bool is_minimal(const Problem& problem) { return problem.options.equation == Equation::minimal; }

bool is_least_variation(const Problem& problem) { return problem.options.equation == Equation::least_variation; }

// Of fourth order in the positions: what the other ways solve.
bool is_fourth_order(const Problem& problem) { return !is_minimal(problem) && !is_least_variation(problem); }

// What a coarse level has refused, the full size would only refuse later; but long pipes between two outlines may have
// no straight surface on a coarse mesh, and keep it on their own.
bool takes_direct(const Problem& problem, const Situation& situation) {
    const bool refused = situation.produced("nested") && is_large(problem) && !is_tube(problem);
    return is_fourth_order(problem) && problem.patch.free_count <= largest_direct && !refused;
}

// Where the noise of the outline may be what stands in the way; vertices that fold because of their weights need
// others. Between several outlines of small patches only where next to nothing is left without that noise: of eight
// that cut limbs across none was found, in half as much time again.
bool takes_eased(const Problem& problem, const Situation& situation) {
    constexpr double most_left = 1e-3;
    if (!is_fourth_order(problem) || situation.attempted(eased_way)) return false;
    const bool hindered = std::all_of(situation.found.begin(), situation.found.end(), [&](const Solution& s) {
        if (s.flaw == Flaw::folded || s.flaw == Flaw::crossing) return is_uniform(problem.weights);
        return s.termination == Termination::stalled && s.reached_load == 0.0;
    });
    if (!hindered || !is_jagged(problem)) return false;
    return is_large(problem) || problem.patch.loop_count() == 1 || roughness_left(problem) < most_left;
}

Found on_eased_outline(const Problem& problem, Situation& situation, const Progress& progress) {
    if (is_large(problem)) find_start(problem, situation, progress.here());
    if (situation.start && !situation.start->found()) return std::nullopt;
    return solve_eased(problem, situation.start, progress);
}

// What no coarse proxy over the eased outline has found, none over the outline itself would.
bool takes_proxy(const Problem& problem, const Situation& situation) {
    const bool refused = situation.came_up_empty(eased_way) && begins_eased(problem) && !situation.found.empty();
    return is_fourth_order(problem) && !refused;
}

bool takes_even(const Problem& problem, const Situation& situation) {
    return is_fourth_order(problem) && !is_uniform(problem.weights) && !situation.produced("even");
}

Found evenly(const Problem& problem, Situation& /*situation*/, const Progress& progress) {
    return solve_evenly(problem, progress);
}

Found with_uniform_weights(const Problem& problem, Situation& /*situation*/, const Progress& progress) {
    Problem even = problem;
    even.weights = uniform_weights(problem.patch);
    even.tolerated_folds = 0;
    Solution solution = solve_global(even, progress);
    if (solution.flaw != Flaw::absent) return std::nullopt;
    solution.even_weights = true;
    return solution;
}

bool is_folded(const Situation& situation) {
    return std::any_of(situation.found.begin(), situation.found.end(),
                       [](const Solution& s) { return s.flaw == Flaw::folded || s.flaw == Flaw::crossing; });
}

}  // namespace

Solution solve_global(const Problem& problem, const Progress& progress) {
    const Way direct = directly();
    const Way proxy = on_proxy();
    const std::array<Way, 11> ways{{
        {"minimal", [](const Problem& p, const Situation&) { return is_minimal(p); },
         [](const Problem& p, Situation&, const Progress& part) { return Found(solve_directly(p, part)); }, 0.0, 1.0},
        {"variation", [](const Problem& p, const Situation&) { return is_least_variation(p); },
         [](const Problem& p, Situation&, const Progress& part) { return Found(solve_least_variation(p, part)); }, 0.0,
         1.0},
        {"nested", [](const Problem& p, const Situation&) { return is_fourth_order(p) && takes_levels(p); },
         [](const Problem& p, Situation&, const Progress& part) { return solve_nested(p, part); }, 0.0, 1.0},
        {"even", [](const Problem& p, const Situation& s) { return takes_even(p, s) && is_large(p); }, evenly, 0.0,
         0.3},
        // What the proxy would only refuse later, after a third of the whole time.
        {eased_way,
         [](const Problem& p, const Situation& s) { return is_large(p) && takes_eased(p, s) && is_beyond_reach(p); },
         on_eased_outline, 0.3, 0.5},
        {direct.name, takes_direct, direct.solve, direct.begin, direct.end},
        {proxy.name, takes_proxy, proxy.solve, proxy.begin, proxy.end},
        {eased_way, [](const Problem& p, const Situation& s) { return is_large(p) && takes_eased(p, s); },
         on_eased_outline, 0.9, 1.0},
        {"even", [](const Problem& p, const Situation& s) { return takes_even(p, s) && !is_large(p); }, evenly, 0.9,
         1.0},
        {eased_way, [](const Problem& p, const Situation& s) { return !is_large(p) && takes_eased(p, s); },
         on_eased_outline, 0.9, 1.0},
        // λ may turn triangles over although the surface is smooth: uniform ones then.
        {"uniform", [](const Problem& p, const Situation& s) { return !is_uniform(p.weights) && is_folded(s); },
         with_uniform_weights, 0.9, 1.0},
    }};
    return run_ways(ways, problem, progress);
}

}  // namespace fairing
