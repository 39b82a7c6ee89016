#include "multigrid/ring_matrix.h"

#include "base/progress.h"

namespace fairing {

RingMatrix::RingMatrix(int vertex_count, const InnerWeights& edges) : begin(vertex_count + 1, 0) {
    double most = 1e-300;
    for (const auto& edge : edges) {
        checkpoint(edge.i);
        most = std::max(most, edge.weight);
        ++begin[edge.i + 1];
        ++begin[edge.j + 1];
    }
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    columns.resize(begin.back());
    diagonal.setZero(vertex_count);
    if (!edges.empty()) largest = most;
    const bool uniform =
        std::all_of(edges.begin(), edges.end(), [&](const WeightedEdge& edge) { return edge.weight == largest; });
    if (!uniform) weights.resize(begin.back());
    Indices cursor(begin.begin(), begin.end() - 1);
    const auto add = [&](int i, int j, float weight) {
        columns[cursor[i]] = j;
        if (!uniform) weights[cursor[i]] = weight;
        ++cursor[i];
        diagonal[i] += weight;
    };
    for (const auto& [i, j, weight] : edges) {
        checkpoint(i);
        const auto share = static_cast<float>(weight / largest);
        add(i, j, share);
        add(j, i, share);
    }
}

namespace {

void fill_in(const RingMatrix& weights, ShapeOperators& shapes) {
    for (int i = 0; i < static_cast<int>(shapes.cols()); ++i) {
        if (!std::isnan(shapes(0, i))) continue;
        const int first = weights.begin[i];
        const int count = weights.begin[i + 1] - first;
        shapes.col(i) = mean_shape(shapes, &weights.columns[first], weights.weights_from(first), count);
    }
}

}  // namespace

void even_out(const RingMatrix& weights, int free_count, int sweeps, BentPoints& points) {
    fill_in(weights, points.shapes);
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        for (int i = 0; i < free_count; ++i) {
            checkpoint(i);
            const int first = weights.begin[i];
            const int count = weights.begin[i + 1] - first;
            const int* around = &weights.columns[first];
            const LiftedMean lifted = lifted_mean(points, around, weights.weights_from(first), count);
            points.points.col(i) = lifted.point;
            points.normals.col(i) = lifted.normal;
        }
    }
}

}  // namespace fairing
