// From a surface with tangent joins to one whose curvature continues that of its surroundings.
#pragma once

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

// Of the squares of what the tangent join's curvature lacks, the least share in waves of twelve vertices and more. What
// is rough comes from noise in the outline or its surroundings, or from an outline in steps, and a surface that follows
// it is only wavier. With noise in the H of a torus, an ellipsoid and a cubic cylinder, errors shrank by a quarter and
// more wherever the share was above a third, and grew in some cases below a quarter.
inline constexpr double least_smooth_share = 1.0 / 3.0;

// `tangent`: the answer with Δ_B H = 0. It comes back bit for bit where it has the curvature already, to a hundredth,
// or what it lacks is rough, and smooth to a fiftieth only; and, with the reason in `join`, where no curvature is known
// or noise speaks louder, where it is no accepted solution
// on the patch's own mesh, and where the join finds none that is accepted.
Solution joined(const Problem& problem, Solution tangent, const Progress& progress);

}  // namespace fairing
