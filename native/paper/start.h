// The initial surface of the coarsest level (end of §7.4).
#pragma once

#include "base/progress.h"
#include "paper/level_update.h"

namespace fairing {

// S and M by which the linear bilaplacian is built: those of M0 for conformal λ, of equilateral triangles otherwise.
// `reference`: positions of M0 at the patch's vertices.
Stiffness start_stiffness(const Patch& patch, InnerFairness kind, const Points& reference);

// A surface over the boundary on which the hierarchy judges edges and triangles, independent of the interior given: the
// membrane or the bilaplacian with one of several bulges, whichever has the most regular triangles. Uniform λ.
Points neutral_surface(const Problem& problem, const Progress& progress);

// Positions of the level's vertices (3 × level vertices) from connectivity and boundary data alone.
// `linear` is the clamped bilaplacian. `improved` takes its bulge of least Willmore energy, made fair by mixed finite
// elements. For minimal surfaces they are the membrane, without and with descent of its area.
Points start_of_level(const LevelProblem& level, const Stiffness& stiffness, const Points& fixed_points,
                      const Progress& progress);

}  // namespace fairing
