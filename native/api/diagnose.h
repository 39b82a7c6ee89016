// What is said about a patch before and after its solve.
#pragma once

#include <optional>
#include <string>

#include "base/errors.h"
#include "mesh/patch.h"

namespace fairing {

// Degrees between the prescribed normals and the surface's own (3 × fixed count, local order); zero at pins and where
// no free vertex is adjacent.
VectorX boundary_angles(const Patch& patch, const Points& actual, const Points& prescribed);

// Triangles (input numbers) whose normal points against the mean of the normals at their corners.
Indices flipped_triangles(const Patch& patch, const Points& points);

// Whether inner-fairness weights can be read off a reference mesh (3 × local vertices); warns REFERENCE_UNUSABLE where
// more than a tenth of it is needles, collapsed or turned over, or the whole one-ring of a free vertex has no area.
bool is_usable_reference(const Patch& patch, const Points& reference, Diagnostics& warnings);

// D and the largest move, in units of D, at which the solve stops.
struct Precision {
    double diameter;
    double tolerance;
};
// PRECISION where neighbouring floating-point numbers lie farther apart than that, or than a thousandth of the border
// edges. `input`: positions of all input vertices.
void warn_of_precision(const Patch& patch, const Points& input, const Precision& wanted, Diagnostics& warnings);

// Why what the equation's solver calls a solution (3 × local vertices, units of D) is none: no area is left, or most of
// the `angles` at the outline are beyond 90°, from the other side. Nothing where it is one.
std::optional<std::string> why_unusable(const Patch& patch, const Points& points, const VectorX& angles);

// About a solved patch: flipped and crossing triangles, and an outline that turns more than 20° from vertex to vertex.
void diagnose(const Patch& patch, const Points& points, const Points& prescribed, Diagnostics& warnings);

}  // namespace fairing
