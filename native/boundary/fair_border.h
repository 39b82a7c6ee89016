// Open borders as fair curves.
#pragma once

#include "base/types.h"

namespace fairing {

// Smooths the runs of marked vertices along one loop. `loop`: columns of `points`, in their order around; a run ends at
// the vertices beside it, which stay. The curve minimises Σ |Δ³x|² + μ Σ |x − given|²: its third derivative, which is
// how its curvature varies, against what it moves. μ is found by generalised cross-validation (Craven & Wahba 1979), so
// that noise goes and a shape of many vertices stays. Runs shorter than 6 stay as they are.
void fair_border(const Indices& loop, const std::vector<char>& marked, Points& points);

}  // namespace fairing
