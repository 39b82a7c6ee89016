// Kinks along a line of edges: what its vertices have of them, and where they are seen.
#pragma once

#include "base/types.h"
#include "problem/problem.h"
#include "shape/girth.h"

namespace fairing {

// Length-weighted means at the ends of edges.
class EdgeMeans {
public:
    explicit EdgeMeans(Eigen::Index vertex_count)
        : sum_(VectorX::Zero(vertex_count)), weight_(VectorX::Zero(vertex_count)) {}

    void add(const std::array<int, 2>& ends, double value, double length) {
        for (int v : ends) {
            sum_[v] += value * length;
            weight_[v] += length;
        }
    }

    // 0 where no edge ends.
    [[nodiscard]] double operator[](Eigen::Index v) const { return weight_[v] > 0.0 ? sum_[v] / weight_[v] : 0.0; }

private:
    VectorX sum_;
    VectorX weight_;
};

// The places along a line whose degrees are above the limit, ascending; none where these are no more than `kink_share`
// of all: the eye forgives a corner.
Indices seen_along(const VectorX& degrees, double limit);

// Vertices at seams within a surface whose two sides are held in the same places, each with vertices of its own, as
// doubled vertices are: where these places show a kink beyond the bends that are usual around. Ascending. `held`:
// vertices that stay; `limit`: degrees from which a kink is seen (shape/visible_join).
Indices seam_kinks(const Points& points, const Triangles& triangles, const Indices& held, double limit);

// Vertices of a patch, each at most once in a list.
struct Blemishes {
    Indices torn;    // of triangles that cross others or are turned over
    Indices bent;    // where |H| is beyond `sharp_bend` of the largest on the boundary and the largest nearby before
    Indices narrow;  // of cross-sections that are thinner than `waist` of what they come from (shape/limits)
    Indices wide;    // likewise, thicker than `balloon`

    [[nodiscard]] bool absent() const { return all().empty(); }
    // One after the other; a vertex may be there more than once.
    [[nodiscard]] Indices all() const;
};

// Finds them by comparison with one shape. A cross-section (shape/girth) comes from two radii: its own before, and the
// one that the first and the last cross-section before make expect there. So neither a swelling that is to go nor a
// waist counts as usual.
class BlemishFinder {
public:
    // `before`: 3 × local vertices, over the problem's boundary.
    BlemishFinder(const Problem& problem, const Points& before);

    [[nodiscard]] Blemishes in(const Points& points) const;

private:
    [[nodiscard]] Indices torn(const Points& points) const;
    [[nodiscard]] Indices bent(const Points& points) const;
    void add_uneven(const Points& points, Blemishes& found) const;

    const Problem& problem_;
    Indices crossing_before_;  // triangles
    Indices turned_before_;
    VectorX bent_before_;  // largest |H| around each vertex
    std::optional<CrossSections> sections_;
    std::vector<VectorX> lesser_;  // of the two radii, for each loop
    std::vector<VectorX> larger_;
};

}  // namespace fairing
