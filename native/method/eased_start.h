// The coarse proxy over an eased outline: where a surface begins that follows the jagged outline, and one beside it.
#pragma once

#include <memory>

#include "base/progress.h"
#include "problem/problem.h"
#include "proxy/proxy_solver.h"

namespace fairing {

// Of the problem's coarsest level, whose outline has all vertices.
struct EasedStart {
    CoarseProxy proxy;
    Points membrane;
};

// Whether the ways over a proxy have this beginning in common: for large patches with one jagged outline.
bool begins_eased(const Problem& problem);

// Nothing where no coarse surface is found over the eased outline: then none is on finer proxies, over either outline.
std::shared_ptr<const EasedStart> eased_start(const Problem& problem, const Progress& progress);

// The coarse proxy over another outline with as many vertices, 3 × fixed count.
CoarseProxy over_outline(const CoarseProxy& coarse, const Points& outline);

}  // namespace fairing
