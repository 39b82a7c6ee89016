#include "fairness/row_weights.h"

#include <stdexcept>

#include <Eigen/Geometry>

#include "base/progress.h"
#include "geometry/one_ring.h"
#include "geometry/triangle.h"

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

// The ring in the plane around the origin: lengths kept, angles scaled to 2π.
std::vector<Eigen::Vector2d> lay_out(const OneRing& ring) {
    const std::size_t m = ring.points.size();
    std::vector<double> turn(m + 1, 0.0);
    for (std::size_t k = 0; k < m; ++k) {
        turn[k + 1] = turn[k] + radians_between(ring.points[k] - ring.centre, ring.points[(k + 1) % m] - ring.centre);
    }
    std::vector<Eigen::Vector2d> flat(m);
    for (std::size_t k = 0; k < m; ++k) {
        const double angle = turn[k] * 2.0 * std::numbers::pi / turn[m];
        const double length = (ring.points[k] - ring.centre).norm();
        flat[k] = {length * std::cos(angle), length * std::sin(angle)};
    }
    return flat;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Adds the barycentric coordinates of the origin in the triangle of point k and the edge of the ring opposite to it.
void add_barycentric(const std::vector<Eigen::Vector2d>& flat, std::size_t k, std::vector<double>& weights) {
    const std::size_t m = flat.size();
    for (std::size_t s = 1; s + 1 < m; ++s) {
        const std::size_t a = (k + s) % m;
        const std::size_t b = (k + s + 1) % m;
        const double wk = cross(flat[a], flat[b]);
        const double wa = cross(flat[b], flat[k]);
        const double wb = cross(flat[k], flat[a]);
        const double sum = wk + wa + wb;
        const double slack = -1e-12 * std::abs(sum);
        if (!(sum > 0.0) || wk < slack || wa < slack || wb < slack) continue;
        weights[k] += std::max(wk, 0.0) / sum;
        weights[a] += std::max(wa, 0.0) / sum;
        weights[b] += std::max(wb, 0.0) / sum;
        return;
    }
}

// With sum 1; those of a ring without extent are all the same.
std::vector<double> weights_of(const OneRing& ring) {
    const std::vector<Eigen::Vector2d> flat = lay_out(ring);
    std::vector<double> weights(flat.size(), 0.0);
    for (std::size_t k = 0; k < flat.size(); ++k) {
        if (k % 64 == 63) checkpoint();  // of large rings: each search passes along all of it
        if (flat[k].allFinite()) add_barycentric(flat, k, weights);
    }
    double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (!(sum > 0.0)) {
        std::fill(weights.begin(), weights.end(), 1.0);
        sum = static_cast<double>(weights.size());
    }
    for (double& w : weights) w /= sum;
    return weights;
}

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

RowWeights shape_preserving_weights(const Patch& patch, const Points& reference) {
    RowWeights result;
    OneRingBuffer buffer;
    for (int i = 0; i < patch.free_count; ++i) {
        checkpoint(i);
        const std::vector<double> lambda = weights_of(buffer.gather(patch, reference, i));
        const auto neighbours = patch.ring(i).vertices;
        for (std::size_t k = 0; k < lambda.size(); ++k) append(result, neighbours[k], lambda[k]);
        close_row(result);
    }
    return result;
}

}  // namespace fairing
