// Symmetric matrices with the pattern of a graph.
#pragma once

#include "base/parallel.h"
#include "multigrid/transfer.h"

namespace fairing {

// (A x)_i = Σ_j w_ij (x_i − x_j) over the largest w, rows of all vertices. The weights are kept in single precision,
// which moves vertices by some 1e-7 of an edge within the surface.
struct RingMatrix {
    Indices begin;
    Indices columns;
    Eigen::VectorXf weights;   // w_ij / largest; empty where all are 1
    Eigen::VectorXf diagonal;  // Σ_j w_ij / largest
    double largest = 1.0;

    RingMatrix(int vertex_count, const InnerWeights& weights);

    [[nodiscard]] float weight(int k) const { return weights.size() > 0 ? weights[k] : 1.0F; }
    // The weights from the k-th on; null where all are 1.
    [[nodiscard]] const float* weights_from(int k) const { return weights.size() > 0 ? &weights[k] : nullptr; }

    // (A x)_i in double precision, 0 for constants.
    [[nodiscard]] Vector3 row(const Points& x, int i) const {
        Vector3 sum = Vector3::Zero();
        for (int k = begin[i]; k < begin[i + 1]; ++k) sum += double{weight(k)} * (x.col(i) - x.col(columns[k]));
        return sum;
    }

    // The mean of the neighbours of vertex i by the weights.
    [[nodiscard]] Vector3 mean(const Points& x, int i) const { return x.col(i) - row(x, i) / double{diagonal[i]}; }

    // write(i, (A x)_i) for the first `rows` vertices.
    template <typename Write>
    void apply(const Points& x, int rows, const Write& write) const {
        for_ranges(rows, coarse_grain, [&](int first, int last) {
            for (int i = first; i < last; ++i) write(i, row(x, i));
        });
    }

    // The same in single precision for a field that is computed on access: x(j) at vertex j, a Vector4f.
    template <typename Field, typename Write>
    void apply_singles(const Field& x, int rows, const Write& write) const {
        for_ranges(rows, coarse_grain, [&](int first, int last) {
            for (int i = first; i < last; ++i)
                write(i, Eigen::Vector4f(diagonal[i] * x(i) - weighted_sum(x, begin[i], begin[i + 1])));
        });
    }

private:
    template <typename Field>
    [[nodiscard]] Eigen::Vector4f weighted_sum(const Field& x, int first, int last) const {
        Eigen::Vector4f sum = Eigen::Vector4f::Zero();
        if (weights.size() == 0) {
            for (int k = first; k < last; ++k) sum += x(columns[k]);
        } else {
            for (int k = first; k < last; ++k) sum += weights[k] * x(columns[k]);
        }
        return sum;
    }
};

// Sweeps of x_i ← the lifted mean of its neighbours by the weights, for the first `free_count` vertices, with the
// normals: smooths an interpolated surface. Unknown shape operators become the mean of their neighbours'.
void even_out(const RingMatrix& weights, int free_count, int sweeps, BentPoints& points);

}  // namespace fairing
