#include "method/low_passed.h"

#include "method/own_mesh.h"
#include "placement/follow_outline.h"
#include "placement/untear.h"

namespace fairing {

std::optional<Solution> solve_low_passed(const Problem& problem, const Traits& traits, Attempts& attempts,
                                         const Progress& progress) {
    const Problem& smooth = traits.low_passed();
    auto solution = place_on_own_mesh(smooth, traits, attempts, progress);
    if (!solution) return std::nullopt;
    follow_outline(problem.patch, problem.fixed_points - smooth.fixed_points, solution->points);
    solution->points = untorn(problem.patch, std::move(solution->points));
    solution->provenance = Provenance::low_passed;
    return solution;
}

}  // namespace fairing
