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

// A spoke shorter than this part of the longest one counts as that long: a finite weight in any ring.
constexpr double shortest_spoke = 1e-9;

void normalise_or_uniform(std::vector<double>& weights) {
    double sum = 0.0;
    for (double w : weights) sum += w;
    if (!(sum > 0.0) || !std::isfinite(sum)) return uniform_ring_weights(weights.size(), weights);
    for (double& w : weights) w /= sum;
}

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
bool add_barycentric(const std::vector<Eigen::Vector2d>& flat, std::size_t k, std::vector<double>& weights) {
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
        return true;
    }
    return false;
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

void uniform_ring_weights(std::size_t valence, std::vector<double>& result) {
    result.assign(valence, 1.0 / static_cast<double>(std::max<std::size_t>(valence, 1)));
}

void inverse_distance_ring_weights(const OneRing& ring, std::vector<double>& result) {
    result.clear();
    double longest = 0.0;
    for (const Vector3& p : ring.points) {
        result.push_back((p - ring.centre).norm());
        longest = std::max(longest, result.back());
    }
    for (double& w : result) w = 1.0 / std::max(w, shortest_spoke * longest);
    normalise_or_uniform(result);
}

void conformal_ring_weights(const OneRing& ring, std::vector<double>& result) {
    const std::size_t m = ring.points.size();
    result.assign(m, 0.0);
    for (std::size_t k = 0; k < m; ++k) {
        const Vector3& a = ring.points[k];
        const Vector3& b = ring.points[(k + 1) % m];
        result[(k + 1) % m] += cotangent(ring.centre - a, b - a);
        result[k] += cotangent(ring.centre - b, a - b);
    }
    for (double& w : result) w = std::max(w, 0.0);
    normalise_or_uniform(result);
}

void shape_preserving_ring_weights(const OneRing& ring, std::vector<double>& result) {
    const std::vector<Eigen::Vector2d> flat = lay_out(ring);
    result.assign(ring.points.size(), 0.0);
    for (std::size_t k = 0; k < flat.size(); ++k) {
        if (k % 64 == 63) checkpoint();  // of large rings: each search passes along all of it
        if (!flat[k].allFinite()) return uniform_ring_weights(flat.size(), result);
        add_barycentric(flat, k, result);
    }
    normalise_or_uniform(result);
}

void ring_weights(const OneRing& ring, InnerFairness kind, std::vector<double>& result) {
    switch (kind) {
        case InnerFairness::inverse_distance: return inverse_distance_ring_weights(ring, result);
        case InnerFairness::conformal: return conformal_ring_weights(ring, result);
        case InnerFairness::shape_preserving: return shape_preserving_ring_weights(ring, result);
        case InnerFairness::uniform:
        case InnerFairness::custom: return uniform_ring_weights(ring.points.size(), result);
    }
}

}  // namespace fairing
