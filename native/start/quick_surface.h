// A surface within milliseconds: shown while a better one is sought, and kept where there is none.
#pragma once

#include <optional>

#include "base/progress.h"
#include "problem/problem.h"

namespace fairing {

// 3 × local vertices, finite. Of a few linear ones that with the least Willmore energy, after two steps of its descent
// (start/globalisation): the clamped bi-Laplacian fill of the boundary by the connectivity alone (start/clamped_fill),
// the one by the shape before, and between several loops that shape low-passed (start/shape_before). It meets the
// tangent planes given; where the boundary leaves the slope free, those of the shape before. The harmonic map for
// minimal surfaces. Nothing where no system is definite. Throws Cancelled.
std::optional<Points> quick_surface(const Problem& problem, const Progress& progress);

}  // namespace fairing
