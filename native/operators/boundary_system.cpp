#include "operators/boundary_system.h"

namespace fairing {

BoundarySystem::BoundarySystem(const Patch& patch, const Points& fixed_points)
    : length_(VectorX::Zero(fixed_points.cols())) {
    for (const auto& [i, j] : patch.edge_ends) {
        if (patch.is_free(i) || patch.is_free(j)) continue;
        const int a = i - patch.free_count;
        const int b = j - patch.free_count;
        const double length = (fixed_points.col(a) - fixed_points.col(b)).norm();
        if (!(length > 0.0)) continue;
        edges_.push_back({std::min(a, b), std::max(a, b), length});
        length_[a] += 0.5 * length;
        length_[b] += 0.5 * length;
    }
}

// Means with the neighbours on the boundary.
VectorX BoundarySystem::even(VectorX values) const {
    for (int sweep = 0; sweep < smoothing_sweeps; ++sweep) {
        VectorX sum = 2.0 * values;
        VectorX count = VectorX::Constant(values.size(), 2.0);
        for (const Edge& edge : edges_) {
            sum[edge.a] += values[edge.b];
            sum[edge.b] += values[edge.a];
            count[edge.a] += 1.0;
            count[edge.b] += 1.0;
        }
        values = sum.cwiseQuotient(count);
    }
    return values;
}

bool BoundarySystem::update(const VectorX& quarter_mass) {
    const auto alone = (length_.array() <= 0.0);  // pins
    const VectorX length = alone.select(quarter_mass.cwiseSqrt(), length_);
    const VectorX c = even(quarter_mass).cwiseQuotient(even(length));
    scale_ = length.cwiseProduct(c).cwiseSqrt().cwiseInverse().transpose();
    const VectorX factor = 0.5 * c.cwiseQuotient(length.cwiseSqrt());
    // The slowest wave around a loop; constants count as one, too.
    const double slowest = std::numbers::pi * c.mean() / length.sum();
    const double least = std::max(1e-14, slowest * slowest);
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve((static_cast<int>(length.size())) + 3 * edges_.size());
    for (int k = 0; k < static_cast<int>(length.size()); ++k) entries.emplace_back(k, k, least);
    for (const Edge& edge : edges_) {
        const double a = factor[edge.a];
        const double b = factor[edge.b];
        entries.emplace_back(edge.a, edge.a, a * a / edge.length);
        entries.emplace_back(edge.b, edge.b, b * b / edge.length);
        entries.emplace_back(edge.b, edge.a, -a * b / edge.length);
    }
    SparseMatrix lower(length.size(), length.size());
    lower.setFromTriplets(entries.begin(), entries.end());
    return half_order_.update(lower, least);
}

BoundarySystem::Row BoundarySystem::approximate_inverse(const Row& values) const {
    return half_order_.apply(values.cwiseProduct(scale_).transpose()).transpose().cwiseProduct(scale_);
}

BoundaryCoupling::BoundaryCoupling(const Patch& patch)
    : free_count_(patch.free_count), fixed_count_(patch.vertex_count() - patch.free_count) {
    for (int j = patch.free_count; j < patch.vertex_count(); ++j) {
        const RingView ring = patch.ring(j);
        for (std::size_t k = 0; k < ring.valence(); ++k) {
            if (patch.is_free(ring.vertices[k]))
                entries_.push_back({ring.vertices[k], j - patch.free_count, ring.spokes[k], 0.0});
        }
    }
}

void BoundaryCoupling::update(const Stiffness& stiffness) {
    for (Entry& entry : entries_) entry.weight = stiffness.weights[entry.edge];
}

VectorX BoundaryCoupling::spread(const BoundaryRow& boundary) const {
    VectorX field = VectorX::Zero(free_count_);
    for (const Entry& entry : entries_) field[entry.i] -= entry.weight * boundary[entry.j];
    return field;
}

BoundaryRow BoundaryCoupling::gather(const VectorX& field) const {
    BoundaryRow boundary = BoundaryRow::Zero(fixed_count_);
    for (const Entry& entry : entries_) boundary[entry.j] -= entry.weight * field[entry.i];
    return boundary;
}

Indices BoundaryCoupling::beside() const {
    Indices vertices;
    for (const Entry& entry : entries_) vertices.push_back(entry.i);
    return vertices;
}

}  // namespace fairing
