#include "multigrid/ring_matrix.h"

namespace fairing {

void RingMatrix::set_pattern(const Patch& patch) {
    begin = {0};
    columns.clear();
    columns.reserve(at(2 * patch.edge_count()));
    for (int i = 0; i < patch.vertex_count(); ++i) {
        const auto ring = patch.ring(i).vertices;
        columns.insert(columns.end(), ring.begin(), ring.end());
        begin.push_back(static_cast<int>(columns.size()));
    }
    weights.resize(static_cast<Eigen::Index>(columns.size()));
    diagonal.resize(patch.vertex_count());
}

void RingMatrix::set_weights(const Patch& patch, const VectorX& edge_weights) {
    for (int i = 0; i < patch.vertex_count(); ++i) {
        const auto spokes = patch.ring(i).spokes;
        double sum = 0.0;
        int k = begin[at(i)];
        for (const int edge : spokes) {
            weights[k++] = edge_weights[edge];
            sum += edge_weights[edge];
        }
        diagonal[i] = sum;
    }
}

void RingMatrix::assemble(int vertex_count, const InnerWeights& edges) {
    begin.assign(at(vertex_count) + 1, 0);
    for (const auto& edge : edges) {
        ++begin[at(edge.i) + 1];
        ++begin[at(edge.j) + 1];
    }
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    columns.resize(at(begin.back()));
    weights.resize(begin.back());
    diagonal.setZero(vertex_count);
    Indices cursor(begin.begin(), begin.end() - 1);
    const auto add = [&](int i, int j, double weight) {
        columns[at(cursor[at(i)])] = j;
        weights[cursor[at(i)]++] = weight;
        diagonal[i] += weight;
    };
    for (const auto& [i, j, weight] : edges) {
        add(i, j, weight);
        add(j, i, weight);
    }
}

void even_out(const RingMatrix& weights, int free_count, int sweeps, Points& points, Points& normals) {
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        for (int i = 0; i < free_count; ++i) {
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
