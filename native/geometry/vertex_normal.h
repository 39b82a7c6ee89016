// Vertex normals: averaged (paper §6), Max's, and fitted ones (consistent with the curvature fit).
#pragma once

#include "geometry/face_geometry.h"
#include "geometry/one_ring.h"
#include "mesh/patch.h"

namespace fairing {

enum class NormalKind { fitted, averaged };

// Normalised sum of the cross products of the incident triangles (paper §6). Zero when they cancel.
Vector3 averaged_normal(const OneRing& ring);

// Normalised Σ d_j × d_{j+1} / (|d_j|² |d_{j+1}|²): exact on spheres (N. Max, "Weights for computing vertex normals
// from facet normals", 1999). Zero when it vanishes.
Vector3 max_normal(const OneRing& ring);

// Improves the unit normal `start` by the tilt of a quadric fitted to the normal curvatures of the points:
// κ_j ≈ q(t_j) + 2 b·t_j h/|d_j| in five unknowns, normal ∝ start − h b, h the mean distance. Continuous in the points:
// the correction fades out where h |b| grows from 0.5 to 0.9, where the points are no graph over the tangent plane.
Vector3 fitted_normal(const Vector3& centre, std::span<const Vector3> points, const Vector3& start);

// Normals of all vertices of a patch. Columns of fixed vertices that are no pins are taken from `prescribed`
// (3 × fixed count, local order); averaged or fitted ones stand everywhere else.
Points vertex_normals(const Patch& patch, const Points& points, const FaceGeometry& faces, const Points& prescribed,
                      NormalKind kind);

// Max's normals at the free vertices and pins, prescribed ones elsewhere: cheap and robust, for the first stages.
Points max_normals(const Patch& patch, const Points& points, const Points& prescribed);

// Degrees between the prescribed normals and the surface's own (3 × fixed count, local order); zero at pins and where
// no free vertex is adjacent.
VectorX boundary_angles(const Patch& patch, const Points& actual, const Points& prescribed);

}  // namespace fairing
