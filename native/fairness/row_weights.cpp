#include "fairness/row_weights.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "base/progress.h"
#include "fairness/ring_weights.h"
#include "geometry/one_ring_buffer.h"

namespace fairing {

namespace {

template <typename Entry>
std::span<const Entry> row_of(const Indices& begin, const std::vector<Entry>& entries, int row) {
    return std::span(entries).subspan(begin[row], begin[row + 1] - begin[row]);
}

void append(RowWeights& rows, int column, double value) {
    rows.columns.push_back(column);
    rows.values.push_back(value);
}

// The first free vertex from which no chain of positive weights leads to a fixed one; `none` if there is none.
int first_adrift(const Patch& patch, const RowWeights& rows) {
    std::vector<Indices> pulled_by(patch.vertex_count());
    for (int i = 0; i < patch.free_count; ++i) {
        checkpoint(i);
        const auto columns = rows.columns_of(i);
        const auto values = rows.values_of(i);
        for (std::size_t k = 0; k < columns.size(); ++k) {
            if (values[k] > 0.0) pulled_by[columns[k]].push_back(i);
        }
    }
    std::vector<char> held(patch.vertex_count(), 0);
    Indices front;
    for (int v = patch.free_count; v < patch.vertex_count(); ++v) front.push_back(v);
    while (!front.empty()) {
        const int j = front.back();
        front.pop_back();
        for (int i : pulled_by[j]) {
            if (held[i]) continue;
            held[i] = 1;
            front.push_back(i);
        }
    }
    const auto end = held.begin() + patch.free_count;
    const auto adrift = std::find(held.begin(), end, 0);
    return adrift == end ? none : static_cast<int>(adrift - held.begin());
}

void close_row(RowWeights& rows) { rows.begin.push_back(static_cast<int>(rows.columns.size())); }

}  // namespace

std::span<const int> RowWeights::columns_of(int row) const { return row_of(begin, columns, row); }

std::span<const double> RowWeights::values_of(int row) const { return row_of(begin, values, row); }

Vector3 RowWeights::mean(int row, const Points& points) const {
    Vector3 sum = Vector3::Zero();
    for (int k = begin[row]; k < begin[row + 1]; ++k) sum += values[k] * points.col(columns[k]);
    return sum;
}

RowWeights row_weights(const Patch& patch, const std::vector<DirectedWeight>& weights, const char* what) {
    std::vector<std::vector<std::pair<int, double>>> rows(patch.free_count);
    for (const DirectedWeight& entry : weights) {
        if (patch.is_free(entry.i) && entry.i != entry.j) rows[entry.i].emplace_back(entry.j, entry.weight);
    }
    RowWeights result;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        checkpoint(static_cast<int>(i));
        double sum = 0.0;
        for (const auto& [j, weight] : rows[i]) sum += weight;
        if (!(sum > 0.0) || !std::isfinite(sum)) {
            throw std::invalid_argument(std::string(what) + ": vertex " + std::to_string(patch.to_input[i]) +
                                        " is free and needs a row of weights with a positive sum");
        }
        for (const auto& [j, weight] : rows[i]) append(result, j, weight / sum);
        close_row(result);
    }
    if (const int adrift = first_adrift(patch, result); adrift != none) {
        throw std::invalid_argument(std::string(what) + ": no chain of positive weights leads from vertex " +
                                    std::to_string(patch.to_input[adrift]) + " to a fixed one");
    }
    return result;
}

RowWeights row_weights(const Patch& patch, const InnerWeights& weights, const char* what) {
    std::vector<DirectedWeight> directed;
    directed.reserve(2 * weights.size());
    for (const WeightedEdge& edge : weights) {
        directed.push_back({edge.i, edge.j, edge.weight});
        directed.push_back({edge.j, edge.i, edge.weight});
    }
    return row_weights(patch, directed, what);
}

bool is_uniform(const Lambda& weights) {
    if (std::holds_alternative<UniformWeights>(weights)) return true;
    const auto* edges = std::get_if<InnerWeights>(&weights);
    return edges && std::all_of(edges->begin(), edges->end(),
                                [&](const WeightedEdge& edge) { return edge.weight == edges->front().weight; });
}

InnerWeights symmetrised(const RowWeights& rows) {
    InnerWeights weights;
    for (int i = 0; i + 1 < static_cast<int>(rows.begin.size()); ++i) {
        const auto columns = rows.columns_of(i);
        const auto values = rows.values_of(i);
        for (std::size_t k = 0; k < columns.size(); ++k) {
            if (values[k] > 0.0) weights.push_back({i, columns[k], values[k]});
        }
    }
    return weights;
}

RowWeights row_weights(const Patch& patch, const Points& reference, InnerFairness kind) {
    if (kind == InnerFairness::conformal) return row_weights(patch, conformal_weights(patch, reference), "reference");
    RowWeights result;
    OneRingBuffer buffer;
    std::vector<double> lambda;
    for (int i = 0; i < patch.free_count; ++i) {
        checkpoint(i);
        ring_weights(buffer.gather(patch, reference, i), kind, lambda);
        const auto neighbours = patch.ring(i).vertices;
        for (std::size_t k = 0; k < lambda.size(); ++k) append(result, neighbours[k], lambda[k]);
        close_row(result);
    }
    return result;
}

}  // namespace fairing
