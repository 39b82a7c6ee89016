// Mean curvature by mixed finite elements with the conormal boundary term: less accurate than the fit of §6, but the
// gradient of an energy, and so the safe one far from the solution.
#pragma once

#include "geometry/face_geometry.h"

namespace fairing {

// c_i = Σ over the two border edges e at i of (e × n_i)/3 + (e × n_other)/6, e in the direction of its triangle, so
// that e × n points out of the patch. 3 × fixed count; zero at pins and inside curves. `normals`: 3 × fixed count.
Points conormals(const Patch& patch, const Points& fixed_points, const Points& fixed_normals);

// h_i = −½ (S x)_i + c_i at all vertices: H n ≈ h / 2M.
Points mixed_curvature_vectors(const Patch& patch, const Stiffness& stiffness, const Points& points,
                               const Points& conormals);

// H_i = ⟨h_i, n_i⟩ / 2 M_i.
VectorX mixed_mean_curvature(const Points& curvature_vectors, const Stiffness& stiffness, const Points& normals);

// Discrete Willmore energy Σ |h_i|² / M_i, about 4 ∫ H².
double willmore_energy(const Points& curvature_vectors, const Stiffness& stiffness);

}  // namespace fairing
