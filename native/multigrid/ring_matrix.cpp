#include "multigrid/ring_matrix.h"

#include <algorithm>

#include "base/progress.h"

namespace fairing {

RingMatrix::RingMatrix(int vertex_count, const InnerWeights& edges)
    : begin(at(vertex_count) + 1, 0), diagonal(VectorX::Zero(vertex_count)) {
    for (const auto& edge : edges) {
        checkpoint(edge.i);
        ++begin[at(edge.i) + 1];
        ++begin[at(edge.j) + 1];
    }
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    columns.resize(at(begin.back()));
    weights.resize(begin.back());
    Indices cursor(begin.begin(), begin.end() - 1);
    const auto add = [&](int i, int j, double weight) {
        columns[at(cursor[at(i)])] = j;
        weights[cursor[at(i)]++] = weight;
        diagonal[i] += weight;
    };
    for (const auto& [i, j, weight] : edges) {
        checkpoint(i);
        add(i, j, weight);
        add(j, i, weight);
    }
}

SingleRingMatrix::SingleRingMatrix(const RingMatrix& matrix)
    : matrix_(matrix),
      largest_(matrix.weights.size() > 0 ? std::max(matrix.weights.maxCoeff(), 1e-300) : 1.0),
      weights_((matrix.weights / largest_).cast<float>()),
      diagonal_((matrix.diagonal / largest_).cast<float>()) {}

void even_out(const RingMatrix& weights, int free_count, int sweeps, Points& points, Points& normals) {
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        for (int i = 0; i < free_count; ++i) {
            checkpoint(i);
            const int first = weights.begin[at(i)];
            const int count = weights.begin[at(i) + 1] - first;
            const int* around = &weights.columns[at(first)];
            points.col(i) = lifted_mean(points, normals, around, &weights.weights[first], count);
            Vector3 normal = Vector3::Zero();
            for (int k = 0; k < count; ++k) normal += weights.weights[first + k] * normals.col(around[k]);
            normals.col(i) = normal.normalized();
        }
    }
}

}  // namespace fairing
