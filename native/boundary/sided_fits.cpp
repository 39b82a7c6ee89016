#include "boundary/sided_fits.h"

#include <algorithm>
#include <utility>

#include "boundary/creased.h"
#include "mesh/collapsed.h"

namespace fairing {

// Those within so many rings of the vertices: fits reach Neighbourhood::most_rings, and what is usual around a hard
// edge three more.
Triangles triangles_near(const Triangles& triangles, const Indices& vertices, Eigen::Index count) {
    constexpr int rings = Neighbourhood::most_rings + 3;  // see above
    std::vector<char> reached(static_cast<std::size_t>(count), 0);
    for (int v : vertices) reached[v] = 1;
    std::vector<Eigen::Index> near;
    for (int ring = 0; ring < rings; ++ring) {
        near.clear();
        for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
            const auto corners = triangles.col(t);
            if (reached[corners[0]] || reached[corners[1]] || reached[corners[2]]) near.push_back(t);
        }
        for (const Eigen::Index t : near) {
            for (int v : triangles.col(t)) reached[v] = 1;
        }
    }
    return triangles(Eigen::all, near);
}

SidedFits::SidedFits(const Points& points, const Triangles& triangles, const Indices& at, const VertexPairs& marked,
                     const VertexPairs& elsewhere)
    : points_(points),
      near_(triangles_near(without_collapsed(triangles), at, points.cols())),
      hard_(hard_edges(points_, near_, marked)),
      side_of_(static_cast<std::size_t>(points.cols()), none),
      is_parted_(side_of_.size(), 0),
      whole_(std::make_unique<SurfaceFits>(points_, near_, Centre::free)) {
    if (hard_.empty()) return;
    BrokenSurface broken = broken_along(near_, static_cast<int>(points_.cols()), hard_);
    choose_sides(broken.triangles, broken.input_vertex, at, elsewhere);
    broken_ = std::move(broken.triangles);
    copies_ = points_(Eigen::all, broken.input_vertex);
    one_side_ = std::make_unique<SurfaceFits>(copies_, broken_, Centre::free);
}

void SidedFits::choose_sides(const Triangles& broken, const Indices& input_vertex, const Indices& at,
                             const VertexPairs& elsewhere) {
    constexpr int several = none - 1;  // beside `none`: more than one side
    const auto add = [&](int copy, Indices& sides) {
        int& side = sides[input_vertex[copy]];
        side = side == none || side == copy ? copy : several;
    };
    std::vector<char> asked(side_of_.size(), 0);
    for (int v : at) asked[v] = 1;
    Indices at_border(side_of_.size(), none);
    const EdgeTable edges = make_edges(near_, static_cast<int>(points_.cols()));
    for (int e = 0; e < edges.size(); ++e) {
        if (edges.side_count(e) != 1 || !asked[edges.ends[e][0]] || !asked[edges.ends[e][1]]) continue;
        if (std::binary_search(elsewhere.begin(), elsewhere.end(), edges.ends[e])) continue;
        const int side = edges.side(e, 0);
        add(side_tail(broken, side), at_border);
        add(side_head(broken, side), at_border);
    }
    for (int copy = 0; copy < static_cast<int>(input_vertex.size()); ++copy) add(copy, side_of_);
    for (std::size_t v = 0; v < side_of_.size(); ++v) {
        if (side_of_[v] != several) continue;
        is_parted_[v] = at_border[v] < 0 ? 1 : 0;
        side_of_[v] = is_parted_[v] ? none : at_border[v];
    }
}

std::optional<SlopeFit> SidedFits::at_vertex(int vertex) {
    const int side = side_of_[vertex];
    return side == none ? whole_->at_vertex(vertex) : one_side_->at_vertex(side);
}

Vector3 SidedFits::averaged(int vertex) const {
    const int side = side_of_[vertex];
    return side == none ? whole_->averaged(vertex) : one_side_->averaged(side);
}

}  // namespace fairing
