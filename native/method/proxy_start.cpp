#include "method/proxy_start.h"

#include <algorithm>

#include "method/eased.h"
#include "method/levels.h"
#include "method/sizes.h"

namespace fairing {

namespace {

std::shared_ptr<const ProxyStart> eased_start(const Problem& problem, const Progress& progress) {
    const Problem smooth = eased(problem);
    const Levels levels(smooth, Outlines::kept, coarsest_size);
    const Problem& coarsest = levels.problem(levels.coarsest());
    const Points membrane = proxy_membrane(coarsest, progress);
    CoarseProxy proxy = solve_coarse_proxy(coarsest, membrane, problem.patch.free_count, progress);
    return std::make_shared<const ProxyStart>(ProxyStart{std::move(proxy), membrane, false});
}

// `surface`: positions of all vertices, over the outline as it is.
std::shared_ptr<const ProxyStart> led_start(const Problem& problem, const Points& surface, const Progress& progress) {
    const Problem smooth = eased(problem);
    const Levels levels(smooth, Outlines::kept, coarsest_size);
    const Problem& coarsest = levels.problem(levels.coarsest());
    Points points = surface(Eigen::all, coarsest.patch.to_input);
    points.rightCols(coarsest.fixed_points.cols()) = coarsest.fixed_points;
    CoarseProxy proxy = coarse_proxy_from(coarsest, points, problem.patch.free_count, progress);
    return std::make_shared<const ProxyStart>(ProxyStart{std::move(proxy), proxy_membrane(coarsest, progress), true});
}

}  // namespace

bool begins_eased(const Problem& problem) {
    return is_large(problem) && problem.patch.free_count >= smallest_telling && problem.patch.loop_count() == 1 &&
           is_jagged(problem);
}

void find_start(const Problem& problem, Situation& situation, const Progress& progress) {
    if (situation.start) return;
    const auto led =
        std::find_if(situation.found.begin(), situation.found.end(), [](const auto& s) { return s.leads; });
    if (led != situation.found.end()) situation.start = led_start(problem, led->points, progress);
    if (situation.start && situation.start->found()) return;
    situation.start = begins_eased(problem) ? eased_start(problem, progress) : nullptr;
}

}  // namespace fairing
