// Symmetric matrices with the pattern of a graph.
#pragma once

#include "multigrid/transfer.h"

namespace fairing {

// (A x)_i = Σ_j w_ij (x_i − x_j), rows of all vertices.
struct RingMatrix {
    Indices begin;
    Indices columns;
    VectorX weights;
    VectorX diagonal;

    RingMatrix(int vertex_count, const InnerWeights& weights);

    // y_i for the first `rows` vertices.
    template <int Rows>
    void apply(const Field<Rows>& x, Field<Rows>& y, int rows) const {
        for (int i = 0; i < rows; ++i) {
            Eigen::Matrix<double, Rows, 1> sum = diagonal[i] * x.col(i);
            for (int k = begin[at(i)]; k < begin[at(i) + 1]; ++k) sum -= weights[k] * x.col(columns[at(k)]);
            y.col(i) = sum;
        }
    }
};

// Sweeps of x_i ← the lifted mean of its neighbours by the weights, for the first `free_count` vertices, normals
// alongside: evens out an interpolated surface.
void even_out(const RingMatrix& weights, int free_count, int sweeps, Points& points, Points& normals);

}  // namespace fairing
