// The initial surface of the coarsest level (end of §7.4).
#pragma once

#include "base/progress.h"
#include "paper/level_update.h"

namespace fairing {

// Positions of the level's vertices (3 × level vertices) from connectivity and boundary data alone.
// The clamped bilaplacian's bulge of least Willmore energy, made fair by mixed finite elements; for minimal surfaces
// the membrane, with descent of its area.
Points start_of_level(const LevelProblem& level, const Points& fixed_points, const Progress& progress);

}  // namespace fairing
