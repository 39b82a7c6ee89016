// Fields between a level and the next coarser one.
#pragma once

#include "geometry/shape_operator.h"
#include "multigrid/collapse_mesh.h"

namespace fairing {

// Vectors in single precision with a fourth entry of zero: a column fits a vector register. Enough for systems that are
// solved to a few per cent.
using SingleField = Eigen::Matrix<float, 4, Eigen::Dynamic>;

// Points of a surface with their unit normals (3 × vertices) and shape operators (6 × vertices, NaN where they are
// unknown; no columns: all are).
struct BentPoints {
    Points points;
    Points normals;
    ShapeOperators shapes;

    [[nodiscard]] bool bends(int i) const { return shapes.cols() > 0 && !std::isnan(shapes(0, i)); }
};

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

    // Means as in `lifted_mean`. `fine` comes with the fixed vertices; those that the coarse level lacks bend unknown.
    void prolong_surface(const BentPoints& coarse, int fine_free_count, BentPoints& fine) const;
};

// The weighted mean of points, lifted about half-way to their tangent planes. Half-way is exact on parabolas only, and
// lies inside of spheres by a fourth-order term that no step of a coarser level removes. A share of 1/(c (1 + c)), c
// being the length of the mean of the unit normals, is exact on spheres, too, for points at the same angle from the
// middle. The normal is the mean of theirs, each turned by half of what its shape operator predicts for the
// displacement to the mean: otherwise it is tilted where the curvature varies, by a quarter of the squared spacing
// times the Laplacian of the slope. Where one of the operators is unknown none is used: some alone would tilt it on a
// sphere. No weights: all are 1.
struct LiftedMean {
    Vector3 point;
    Vector3 normal;  // unit
};
LiftedMean lifted_mean(const BentPoints& points, const int* vertices, const float* weights, int count);

// The weighted mean of those shape operators that are known; NaN where none is.
Eigen::Vector<float, 6> mean_shape(const ShapeOperators& shapes, const int* vertices, const float* weights, int count);

// The transpose of Transfer::prolong, stored by target vertex so that several threads can apply it. Takes eight bytes
// for each weight beside the interpolation's own.
class Restriction {
public:
    // Refers to it.
    explicit Restriction(const Transfer& transfer);

    // coarse ← scale · Pᵀ fine; nothing arrives at fixed vertices. `sums`: scratch of the size of `fine`, `coarse` in
    // the right size.
    void apply(const SingleField& fine, float scale, SingleField& sums, SingleField& coarse) const;

    [[nodiscard]] const Transfer& transfer() const { return transfer_; }

private:
    [[nodiscard]] Eigen::Vector4f arrived(int row, const Eigen::Vector4f& own, const SingleField& sums) const;

    const Transfer& transfer_;
    Indices begin_;  // of each row: the removed vertices in the order of their removal, then the coarse free ones
    Indices from_;   // removals
    std::vector<float> weights_;
};

}  // namespace fairing
