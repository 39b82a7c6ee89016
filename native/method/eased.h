// A surface over an eased outline, where none meets the outline as it is.
#pragma once

#include <optional>

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

inline constexpr const char* eased_way = "eased";
inline constexpr const char* eased_loft_way = "eased loft";  // method/lofted

// The problem with its outline without short waves.
Problem eased(const Problem& problem);

// Whether curvature varies so much along the outline that noise or folds of the surroundings must be the cause.
bool is_jagged(const Problem& problem);

// What share of that is left without the outline's short waves. Fillets between voxel meshes, whose outlines run in
// steps of every length, keep 1e-9 to 1e-7 of it, noise of .1 to .8 edges 3e-5 to 7e-4, and 40 jagged patches of other
// meshes, limbs and wings that are cut across among them, 4e-5 to 0.2.
double roughness_left(const Problem& problem);

// The surface of the outline without its short waves, solved on a mesh of the engine's own, the vertices placed on it.
// The outline itself stays; the rows of vertices next to it follow where it lies beside that surface. Nothing where
// that surface is not found either.
std::optional<Solution> solve_eased(const Problem& problem, const Progress& progress);

// Whether a solution stands for another outline: it came that way, or is a loft over an eased one.
bool is_eased(const Solution& solution);

// How far the outline lies beside the eased one at most, units of D.
double eased_by(const Problem& problem);

}  // namespace fairing
