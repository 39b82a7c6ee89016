// What can be measured on a mesh without fairing it.
#pragma once

#include "api/input.h"
#include "geometry/vertex_normal.h"

namespace fairing {

// Where the normals of fixed vertices come from: prescribed ones of the checked mesh, or fits to their own side.
enum class NormalsAtBoundary { prescribed, one_sided };

// H at each vertex of a checked mesh: the mean of the sides on cut curves, zero at vertices without triangles.
// Positions may differ from those that were checked.
VectorX mean_curvature(const CheckedMesh& mesh, const View<Points>& points, NormalKind kind,
                       NormalsAtBoundary boundary);
// The same of a mesh that consists of these pieces.
VectorX mean_curvature(std::span<const Patch> pieces, const FixedNormals& normals, const View<Points>& points,
                       NormalKind kind, NormalsAtBoundary boundary);

// Which component each input triangle belongs to: numbered by their lowest triangles, `none` where no vertex is free
// and for triangles that name a vertex twice. The components are those that fair() solves, closed ones among them.
Indices component_of_triangles(const Triangles& triangles, const std::optional<Indices>& fixed, int vertex_count);

// The mesh and the levels of multigrid below it (multigrid/coarsening), `most` in all or 0 for as many as there are,
// fine to coarse. Vertices of curves and borders are on all; a component without coarser levels stays as it is.
std::vector<Triangles> mesh_levels(const MeshInput& input, int most);

// H of a mesh; normals of fixed vertices that are not prescribed are one-sided fits.
VectorX mean_curvature(const MeshInput& input, NormalKind kind);

// Unit normals of all vertices, those of the border included; zero at vertices without triangles.
Points vertex_normals(const MeshInput& input, NormalKind kind);

// Entries of S for all vertices of any triangle list, duplicates summed: cot α + cot β off the diagonal (negative), the
// sum of the row on it; positive semidefinite, no factor ½ (paper §5, eq. 6, 7).
struct MatrixEntries {
    Indices rows;
    Indices columns;
    std::vector<double> values;
};
MatrixEntries cotan_laplacian(const Points& points, const Triangles& triangles);

// Triangles, ascending, that are turned over against those around them (geometry/flips.h); pieces are looked at one by
// one, as fair() does. Positions must be finite.
Indices flipped_triangles(const MeshInput& input);

// Ratio ≥ 1 of the singular values of the affine map of each triangle from the reference to the points; infinite where
// one of them is degenerate.
VectorX conformal_distortion(const Points& reference, const Points& points, const Triangles& triangles);

// Rows: the mesh's vertices; columns as those of `given`, whose rows belong to `input.fixed`. Harmonic at the other
// vertices (fairness/harmonic_values); zero where no component holds a fixed vertex. Border vertices that are not fixed
// stay zero, too: a mesh whose border is not all fixed has no use for this. Throws what check_mesh throws, and
// SolverError.
Eigen::MatrixXd interpolate(const MeshInput& input, const Eigen::MatrixXd& given);

}  // namespace fairing
