// The discrete Willmore energy of mixed finite elements and its gradient: the merit function of the globalisation.
#pragma once

#include "geometry/face_geometry.h"

namespace fairing {

// c_i = Σ over the two border edges e at i of (e × n_i)/3 + (e × n_other)/6, e in the direction of its triangle, so
// that e × n points out of the patch. 3 × fixed count; zero at pins. `fixed_points`, `normals`: 3 × fixed count.
Points conormals(const Patch& patch, const Points& fixed_points, const Points& normals);

// h_i = −½ (S x)_i + c_i at all vertices: 2 M H n ≈ h, the boundary's tangent planes included.
Points mixed_curvature_vectors(const Patch& patch, const Stiffness& stiffness, const Points& points,
                               const Points& conormals);

// H_i = ⟨h_i, n_i⟩ / 2 M_i.
VectorX mixed_mean_curvature(const Points& curvature_vectors, const Stiffness& stiffness, const Points& normals);

// E = Σ |h_i|² / M_i, about 4 ∫ H² (8 π on a hemisphere).
double willmore_energy(const Points& curvature_vectors, const Stiffness& stiffness);

// ∂E/∂x_i at the free vertices (3 × free count), exact.
Points willmore_gradient(const Patch& patch, const Stiffness& stiffness, const Points& points,
                         const Points& curvature_vectors);

}  // namespace fairing
