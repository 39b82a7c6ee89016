// A surface over an eased outline, where none meets the outline as it is.
#pragma once

#include <memory>
#include <optional>

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

struct ProxyStart;  // method/proxy_start

inline constexpr const char* eased_way = "eased";

// The problem with its outline without short waves.
Problem eased(const Problem& problem);

// Whether curvature varies so much along the outline that noise or folds of the surroundings must be the cause.
bool is_jagged(const Problem& problem);

// Whether it varies so much that no surface on a mesh of the engine's own has met such an outline.
bool is_beyond_reach(const Problem& problem);

// What share of that is left without the outline's short waves: noise of 0.1 to 0.8 edges keeps 3e-5 to 7e-4 of it,
// jagged patches of other meshes 4e-5 to 0.2, those of limbs and wings that are cut across 2e-3 and more.
double roughness_left(const Problem& problem);

// The surface of the outline without its short waves, solved on a mesh of the engine's own, the vertices placed on it.
// The outline itself stays; the rows of vertices next to it follow where it lies beside that surface. Nothing where
// that surface is not found either. `start`: where large patches begin, if there is such a start.
std::optional<Solution> solve_eased(const Problem& problem, const std::shared_ptr<const ProxyStart>& start,
                                    const Progress& progress);

// How far the outline lies beside the eased one at most, units of D.
double eased_by(const Problem& problem);

}  // namespace fairing
