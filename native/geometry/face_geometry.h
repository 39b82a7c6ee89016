// Cotangents, areas and unit normals of all triangles, and the Laplace–Beltrami weights that follow from them.
#pragma once

#include "base/parallel.h"
#include "mesh/patch.h"

namespace fairing {

// 1 for an equilateral triangle, 0 for a degenerate one.
double triangle_shape(const Vector3& a, const Vector3& b, const Vector3& c);

// Scratch data of one pass over the triangles. Column k of `cotangents` belongs to the angle at corner k.
// Finite for any finite input: a triangle flatter than 1e-12 of its longest edge squared counts as that flat,
// and its normal is zero.
struct FaceGeometry {
    Eigen::Matrix3Xd cotangents;
    VectorX areas;
    Points normals;

    FaceGeometry() = default;
    FaceGeometry(const Points& points, const Triangles& triangles) { update(points, triangles); }
    void update(const Points& points, const Triangles& triangles);

private:
    void measure(const Points& points, const Triangles& triangles, int triangle);
};

// Laplace–Beltrami matrix S of all vertices of a patch, kept as one weight for each edge (paper §5, eq. 6, 7):
// S_ij = −w_ij, S_ii = Σ_j w_ij with w = cot α + cot β (no factor ½); positive semidefinite for the full mesh.
// mass_i = ⅓ of the area of the triangles at i.
struct Stiffness {
    VectorX weights;
    VectorX mass;

    Stiffness() = default;
    Stiffness(const Patch& patch, const Points& points) { update({points, patch.triangles}, patch); }
    void update(const FaceGeometry& faces, const Patch& patch);

    // S_ii
    [[nodiscard]] double diagonal(const Patch& patch, int vertex) const;

    // (S f)_i of a scalar (1 × n) or of points (3 × n), for vertices 0 … count − 1.
    template <typename Field>
    Field apply(const Patch& patch, const Field& field, int count) const;
};

template <typename Field>
Field Stiffness::apply(const Patch& patch, const Field& field, int count) const {
    Field result = Field::Zero(field.rows(), count);
    for_ranges(count, coarse_grain, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            const RingView ring = patch.ring(i);
            for (std::size_t k = 0; k < ring.valence(); ++k) {
                result.col(i) += weights[ring.spokes[k]] * (field.col(i) - field.col(ring.vertices[k]));
            }
        }
    });
    return result;
}

double total_area(const Points& points, const Triangles& triangles);

// Averaged normals, not of unit length (3 × points): at each vertex the sum of the triangles' cross products, zero
// without triangles.
Points summed_normals(const Points& points, const Triangles& triangles);

}  // namespace fairing
