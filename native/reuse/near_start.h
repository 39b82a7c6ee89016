// From positions that lie near the surface already.
#pragma once

#include <optional>

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

struct NearStart {
    Points points;  // 3 × local vertices, units of D
    // The vertices sit within the surface as they should: they move along its normals only. So they do where the
    // weights are the conformal ones of these very positions.
    bool settled;
};

// The accepted surface that the iteration finds within a few steps from there; nothing where there is none, and the
// outline alone has to decide. Throws Cancelled.
std::optional<Solution> solve_near(const Problem& problem, const NearStart& start, const Progress& progress);

}  // namespace fairing
