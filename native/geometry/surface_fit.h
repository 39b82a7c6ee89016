// Surfaces fitted to nearby vertices: for boundary loops, where the one-ring sees one side only.
#pragma once

#include <Eigen/Core>

#include "base/columns.h"
#include "base/types.h"
#include "geometry/neighbourhood.h"
#include "geometry/slope_fit.h"
#include "mesh/patch.h"

namespace fairing {

// The best fits at vertices of a triangulated surface. Where they pass through the centre, four fits of up to three
// rings compete; where the centre is free (noise), also fits of up to four rings and of the 40 nearest vertices; a
// strip's fit is used where none of these determines a quadric.
class SurfaceFits {
public:
    // Coordinates beyond ±1e100 or within ±1e-100 lose their digits: scale them. Keeps references.
    SurfaceFits(const Points& points, const Triangles& triangles, Centre at_centres);

    // The fit whose slopes have the least standard error, with the curvature of the fit that has the least standard
    // error of that; nothing where the points are too few.
    std::optional<SlopeFit> at_vertex(int vertex) { return at_vertex(vertex, around_); }
    // The same with the caller's own walk, for loops on several threads.
    std::optional<SlopeFit> at_vertex(int vertex, Neighbourhood& around) const;
    [[nodiscard]] Neighbourhood walk() const { return {adjacency_, points_, reach_of(at_centres_)}; }
    // The normalised sum of the adjacent triangles' cross products; zero without triangles.
    [[nodiscard]] Vector3 averaged(int vertex) const { return direction(summed_.col(vertex)); }

private:
    [[nodiscard]] std::optional<SlopeFit> strip_at(int vertex, const Neighbourhood& around) const;
    static Reach reach_of(Centre at_centres);

    const Points& points_;
    VertexAdjacency adjacency_;
    Neighbourhood around_;
    Points summed_;  // cross products
    Centre at_centres_;
};

// Coordinates of the triangles' corners divided by `size`, the largest of them: no product of edges is infinite, and
// none is lost to denormals.
struct UnitSized {
    Points points;
    double size;
};
UnitSized to_unit_size(const Points& points, const Triangles& triangles);

// Normals at the fixed vertices (3 × fixed count) of the surface through them that fits the patch's own side of the
// boundary; averaged ones where the fit has too few points.
Points one_sided_normals(const Patch& patch, const Points& points);

// A = Q R by Householder's reflections. Rows are stored in groups of four (SIMD), padded with zeros: Eigen's blocks of
// any size would spend half of the time on their ends.
class TallSystem {
public:
    using Four = Eigen::Array4d;
    using Index = Eigen::Index;
    static constexpr int most_columns = 11;  // ten unknowns of a cubic with a free centre, and the heights
    using Row = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_columns, 1>;

    // rows ≥ columns
    TallSystem(Index rows, Index columns);

    [[nodiscard]] Index fours() const { return fours_; }
    // Entries 4 `four` … 4 `four` + 3 of a column.
    void set(Index four, Index column, const Four& values) { rows_.col(column * fours_ + four) = values; }

    // Computes R, and clears the rows for the next fit.
    void triangularise();
    [[nodiscard]] double factor(Index row, Index column) const { return factor_(row, column); }
    // The least pivot of the first `count` ones over the largest of them.
    [[nodiscard]] double least_pivot(Index count) const;
    // Solves R x = column `count` for the first `count` columns.
    [[nodiscard]] Row solve(Index count) const;
    // Solves Rᵀ x = y likewise.
    [[nodiscard]] Row solve_transposed(Row y) const;

private:
    void reflect(Index column);

    Index columns_;
    Index fours_;
    Eigen::Matrix<double, 4, Eigen::Dynamic> rows_;
    Eigen::Matrix<double, most_columns, most_columns> factor_;
};

// Sums weighted rows a · x = value of N unknowns. The sums are written out for N known to the compiler: rings have few
// rows, and every step of the iteration fits two of them at every vertex.
template <int N, typename Scalar = double>
class NormalEquations {
public:
    using Vector = Eigen::Matrix<Scalar, N, 1>;

    void add(const Vector& row, Scalar value, Scalar weight) {
        for (int j = 0; j < N; ++j) {
            const Scalar weighted = weight * row[j];
            rhs_[j] += weighted * value;
            for (int i = j; i < N; ++i) matrix_(i, j) += weighted * row[i];
        }
    }

    [[nodiscard]] Scalar trace() const { return matrix_.trace(); }
    void add_to_diagonal(Scalar value) { matrix_.diagonal().array() += value; }
    void add_to_diagonal(int k, Scalar value) { matrix_(k, k) += value; }

    // By Cholesky's factor; the matrix must be positive definite. Destroys the sums.
    [[nodiscard]] Vector solve() {
        using std::sqrt;
        Vector inverse;  // of the factor's diagonal
        for (int j = 0; j < N; ++j) {
            const Scalar pivot = inverse[j] = 1.0 / sqrt(matrix_(j, j));
            for (int i = j + 1; i < N; ++i) matrix_(i, j) *= pivot;
            for (int k = j + 1; k < N; ++k) {
                for (int i = k; i < N; ++i) matrix_(i, k) -= matrix_(i, j) * matrix_(k, j);
            }
            rhs_[j] *= pivot;
            for (int i = j + 1; i < N; ++i) rhs_[i] -= matrix_(i, j) * rhs_[j];
        }
        for (int j = N - 1; j >= 0; --j) {
            for (int i = j + 1; i < N; ++i) rhs_[j] -= matrix_(i, j) * rhs_[i];
            rhs_[j] *= inverse[j];
        }
        return rhs_;
    }

private:
    Eigen::Matrix<Scalar, N, N> matrix_ = Eigen::Matrix<Scalar, N, N>::Zero();  // its lower triangle
    Vector rhs_ = Vector::Zero();
};

}  // namespace fairing
