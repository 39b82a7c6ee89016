// Fields between a level and the next coarser one.
#pragma once

#include "multigrid/collapse_mesh.h"

namespace fairing {

// Vectors in single precision with a fourth entry of zero: a column fits a vector register. Enough for what only has to
// be solved to a few per cent.
using SingleField = Eigen::Matrix<float, 4, Eigen::Dynamic>;

// Fields have a column for each vertex of a level, fixed ones included (where corrections are zero).
struct Transfer {
    int fine_count = 0;         // vertices of the fine level
    int coarse_free_count = 0;  // of the coarse level, which come first
    Indices coarse_in_fine;     // coarse vertex → fine vertex
    Removals removals;          // free vertices, in fine numbers, in the order of their removal

    [[nodiscard]] int coarse_count() const { return static_cast<int>(coarse_in_fine.size()); }

    // Interpolation: removed vertices take the weighted mean of what was around them. `fine` in the right size.
    void prolong(const SingleField& coarse, SingleField& fine) const;

    // The same in double precision. `fine` comes with the fixed vertices.
    void prolong_means(const Points& coarse, int fine_free_count, Points& fine) const;

    // Its transpose; nothing arrives at fixed vertices. `fine` is used up, `coarse` in the right size.
    void restrict(SingleField& fine, SingleField& coarse) const;

    // Positions and normals (3 × vertices): means lifted as in `lifted_mean`. `fine` comes with the fixed vertices.
    void prolong_surface(const Points& coarse, const Points& coarse_normals, int fine_free_count, Points& fine,
                         Points& fine_normals) const;
};

// The weighted mean of points, lifted about half-way to their tangent planes. Half-way is exact on parabolas only, and
// lies inside of spheres by a fourth-order term that no step of a coarser level removes. With c, the length of the mean
// of the unit normals, 1/(c (1 + c)) of the way is right on spheres, too, for points at the same angle from the middle.
struct LiftedMean {
    Vector3 point;
    Vector3 normal;  // unit, the mean's
};
LiftedMean lifted_mean(const Points& points, const Points& normals, const int* vertices, const float* weights,
                       int count);

}  // namespace fairing
