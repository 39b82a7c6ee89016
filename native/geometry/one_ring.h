// The points around a vertex, and around two of them at once.
#pragma once

#include "base/lanes.h"
#include "mesh/patch.h"

namespace fairing {

// A vertex and the points around it, counter-clockwise; `closed` when the last is followed by the first.
struct OneRing {
    using Scalar = double;

    Vector3 centre;
    std::span<const Vector3> points;
    bool closed = true;

    [[nodiscard]] std::size_t size() const { return points.size(); }
    [[nodiscard]] double valence() const { return static_cast<double>(points.size()); }
    // Offset of a point from the centre.
    [[nodiscard]] Vector3 offset(std::size_t k) const { return points[k] - centre; }
    // Offset of the first point's predecessor; of the first itself on an open ring.
    [[nodiscard]] Vector3 offset_before() const { return (closed ? points.back() : points.front()) - centre; }
};

// The rings of two vertices in SIMD lanes. The shorter one is padded with its centre, which adds nothing to any sum.
class RingPair {
public:
    using Scalar = Lanes;

    // `points`: of the patch. Every vertex has neighbours.
    void gather(const Patch& patch, const Points& points, LaneIndices vertices) {
        const std::array<RingView, 2> rings{patch.ring(vertices[0]), patch.ring(vertices[1])};
        centres_ = {points.col(vertices[0]).data(), points.col(vertices[1]).data()};
        centre_ = side_by_side(centres_[0], centres_[1]);
        valence_ = {static_cast<double>(rings[0].valence()), static_cast<double>(rings[1].valence())};
        offsets_.clear();
        append(points, {rings[0].vertices, rings[1].vertices});
        const auto before = [&](const RingView& ring) {
            return points.col(ring.closed() ? ring.vertices.back() : ring.vertices.front()).data();
        };
        before_ = side_by_side(before(rings[0]), before(rings[1])) - centre_;
    }

    // Appends the points of the rim edges of the rings gathered last. `virtual_points`: of all edges.
    void append_virtual(const Patch& patch, const Points& virtual_points, LaneIndices vertices) {
        append(virtual_points, {patch.ring(vertices[0]).rim, patch.ring(vertices[1]).rim});
    }

    [[nodiscard]] std::size_t size() const { return offsets_.size(); }
    [[nodiscard]] Lanes valence() const { return valence_; }
    [[nodiscard]] const Vector3Of<Lanes>& offset(std::size_t k) const { return offsets_[k]; }
    [[nodiscard]] const Vector3Of<Lanes>& offset_before() const { return before_; }

private:
    void append(const Points& points, std::array<std::span<const int>, Lanes::count> columns) {
        const auto point = [&](std::size_t lane, std::size_t k) {
            return k < columns[lane].size() ? points.col(columns[lane][k]).data() : centres_[lane];
        };
        const std::size_t size = std::max(columns[0].size(), columns[1].size());
        for (std::size_t k = 0; k < size; ++k) offsets_.emplace_back(side_by_side(point(0, k), point(1, k)) - centre_);
    }

    std::array<const double*, Lanes::count> centres_{};
    Vector3Of<Lanes> centre_;
    Vector3Of<Lanes> before_;
    Lanes valence_;
    std::vector<Vector3Of<Lanes>> offsets_;
};

// Gathers the points around a vertex of a patch into contiguous scratch memory.
class OneRingBuffer {
public:
    // Valid until the next call.
    OneRing gather(const Patch& patch, const Points& points, int vertex) {
        const RingView ring = patch.ring(vertex);
        points_.clear();
        for (int v : ring.vertices) points_.emplace_back(points.col(v));
        return {points.col(vertex), points_, ring.closed()};
    }

    // Appends virtual_point(edge) for each rim edge of the ring gathered last.
    template <typename VirtualPoint>
    std::span<const Vector3> with_virtual(const Patch& patch, int vertex, const VirtualPoint& virtual_point) {
        for (int edge : patch.ring(vertex).rim) points_.emplace_back(virtual_point(edge));
        return points_;
    }

private:
    std::vector<Vector3> points_;
};

}  // namespace fairing
