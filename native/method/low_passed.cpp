#include "method/low_passed.h"

#include "method/own_mesh.h"
#include "placement/follow_outline.h"
#include "placement/tears.h"
#include "placement/untear.h"

namespace fairing {

namespace {

// The placed vertices beside the boundary that lies off their surface by these offsets. The rows next to it follow it;
// where that leaves triangles torn and the rows that stay have fewer, these do.
Points beside(const Patch& patch, const Points& offsets, const Points& placed) {
    Points followed = placed;
    follow_outline(patch, offsets, followed);
    followed = untorn(patch, std::move(followed));
    const std::size_t torn = torn_triangles(patch, followed).size();
    if (torn == 0) return followed;
    Points kept = placed;
    kept.rightCols(offsets.cols()) += offsets;
    kept = untorn(patch, std::move(kept));
    return torn_triangles(patch, kept).size() < torn ? kept : followed;
}

}  // namespace

std::optional<Solution> solve_low_passed(const Problem& problem, const Traits& traits, Attempts& attempts,
                                         const Progress& progress) {
    const Problem& smooth = traits.low_passed();
    auto solution = place_on_own_mesh(smooth, traits, attempts, progress);
    if (!solution) return std::nullopt;
    solution->points = beside(problem.patch, problem.fixed_points - smooth.fixed_points, solution->points);
    solution->provenance = Provenance::low_passed;
    return solution;
}

}  // namespace fairing
