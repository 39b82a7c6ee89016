#include "method/eased_start.h"

#include "method/eased.h"
#include "method/levels.h"
#include "method/sizes.h"

namespace fairing {

bool begins_eased(const Problem& problem) {
    return is_large(problem) && problem.patch.free_count >= smallest_telling && problem.patch.loop_count() == 1 &&
           is_jagged(problem);
}

std::shared_ptr<const EasedStart> eased_start(const Problem& problem, const Progress& progress) {
    const Problem smooth = eased(problem);
    const Levels levels(smooth, Outlines::kept, coarsest_size);
    const Problem& coarsest = levels.problem(levels.coarsest());
    const Points membrane = proxy_membrane(coarsest, progress);
    CoarseProxy proxy = solve_coarse_proxy(coarsest, membrane, problem.patch.free_count, progress);
    return std::make_shared<const EasedStart>(EasedStart{std::move(proxy), membrane});
}

}  // namespace fairing
