// Moves vertices within a surface that is known from its own mesh alone.
#pragma once

#include "geometry/target_surface.h"
#include "problem/problem.h"
#include "tangential/tangential_step.h"

namespace fairing {

// Whether steps use how the tangent planes turn, which is read off the normals. Where these are noisy, as beside a
// jagged boundary, the planes count as fixed.
enum class Turning { known, unknown };

// Moves vertices nearer to their inner-fairness positions, by some accelerated tangential steps, each of which ends on
// the surface as given. `points`: 3 × local vertices; `normals`: unit, of the surface there (0 at pins).
void slide(const Problem& problem, const TangentialStep& tangential, const Points& normals, Turning turning,
           int most_steps, Points& points);

// The same where the shape operators are known at the free vertices; empty: not known.
void slide(const Problem& problem, const TangentialStep& tangential, const Points& normals, ShapeOperators shapes,
           int most_steps, Points& points);

// The same on another surface. `where`: places of the free vertices on it; `points`: 3 × local vertices.
void slide_on(const TargetSurface& target, const TangentialStep& tangential, int most_steps,
              std::vector<SurfacePoint>& where, Points& points);

}  // namespace fairing
