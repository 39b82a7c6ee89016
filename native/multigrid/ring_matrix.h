// Symmetric matrices with the pattern of a graph.
#pragma once

#include "base/parallel.h"
#include "multigrid/transfer.h"

namespace fairing {

// (A x)_i = Σ_j w_ij (x_i − x_j), rows of all vertices.
struct RingMatrix {
    Indices begin;
    Indices columns;
    VectorX weights;
    VectorX diagonal;

    RingMatrix(int vertex_count, const InnerWeights& weights);

    // write(i, (A x)_i) for the first `rows` vertices.
    template <typename Write>
    void apply(const Points& x, int rows, const Write& write) const {
        for_ranges(rows, coarse_grain, [&](int first, int last) {
            for (int i = first; i < last; ++i) {
                Vector3 sum = diagonal[i] * x.col(i);
                for (int k = begin[at(i)]; k < begin[at(i) + 1]; ++k) sum -= weights[k] * x.col(columns[at(k)]);
                write(i, sum);
            }
        });
    }
};

// A RingMatrix over its largest weight, in single precision; refers to its columns.
class SingleRingMatrix {
public:
    explicit SingleRingMatrix(const RingMatrix& matrix);

    [[nodiscard]] double largest_weight() const { return largest_; }
    [[nodiscard]] const Eigen::VectorXf& diagonal() const { return diagonal_; }

    // write(i, (A x)_i) for the first `rows` vertices.
    template <typename Write>
    void apply(const SingleField& x, int rows, const Write& write) const {
        for_ranges(rows, coarse_grain, [&](int first, int last) {
            for (int i = first; i < last; ++i) {
                Eigen::Vector4f sum = diagonal_[i] * x.col(i);
                for (int k = matrix_.begin[at(i)]; k < matrix_.begin[at(i) + 1]; ++k)
                    sum -= weights_[k] * x.col(matrix_.columns[at(k)]);
                write(i, sum);
            }
        });
    }

private:
    const RingMatrix& matrix_;
    double largest_;
    Eigen::VectorXf weights_;
    Eigen::VectorXf diagonal_;
};

// Sweeps of x_i ← the lifted mean of its neighbours by the weights, for the first `free_count` vertices, normals
// alongside: evens out an interpolated surface.
void even_out(const RingMatrix& weights, int free_count, int sweeps, Points& points, Points& normals);

}  // namespace fairing
