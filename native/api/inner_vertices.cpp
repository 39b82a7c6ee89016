#include "api/inner_vertices.h"

#include <set>

#include "api/measure.h"
#include "base/columns.h"
#include "mesh/edges.h"
#include "mesh/loops.h"

namespace fairing {

namespace {

constexpr int halvings = 4;  // some hundred free vertices then: lengths grow over ten edges and more

struct Corner {
    int vertex;
    Vector3 weights;  // on the given triangle
    bool is_middle = false;
};

// The triangles of one whose sides have middles, in its winding: first a corner between two middles is cut off, or the
// one behind the first middle.
std::vector<std::array<Corner, 3>> cut(std::vector<Corner> around) {
    std::vector<std::array<Corner, 3>> pieces;
    while (around.size() > 3) {
        const std::size_t count = around.size();
        std::size_t at = count;
        for (std::size_t k = 0; k < count && at == count; ++k)
            if (!around[k].is_middle && around[(k + count - 1) % count].is_middle && around[(k + 1) % count].is_middle)
                at = k;
        if (at == count)
            at = (static_cast<std::size_t>(std::ranges::find_if(around, &Corner::is_middle) - around.begin()) + 1) %
                 count;
        pieces.push_back({around[(at + count - 1) % count], around[at], around[(at + 1) % count]});
        around.erase(around.begin() + static_cast<std::ptrdiff_t>(at));
    }
    pieces.push_back({around[0], around[1], around[2]});
    return pieces;
}

class Halving {
public:
    Halving(const RefinedPatch& whole, const std::set<std::array<int, 2>>& kept)
        : whole_(whole), edges_(make_edges(whole.triangles, static_cast<int>(whole.vertices.cols()))) {
        for (const auto point : whole.vertices.colwise()) points_.emplace_back(point);
        middle_.assign(static_cast<std::size_t>(edges_.size()), none);
        for (int e = 0; e < edges_.size(); ++e)
            if (edges_.side_count(e) == 2 && !kept.contains(edges_.ends[e])) middle_[e] = unmade;
    }

    RefinedPatch halved() {
        for (int t = 0; t < static_cast<int>(whole_.triangles.cols()); ++t) divide(t);
        return {as_columns(points_), as_columns(triangles_), parents_, as_columns(corners_)};
    }

private:
    static constexpr int unmade = -2;  // no vertex, nor `none`: to be made when it is first asked for

    int added(const Vector3& place) {
        points_.push_back(place);
        return static_cast<int>(points_.size()) - 1;
    }

    void divide(int t) {
        std::vector<Corner> around;
        for (int k = 0; k < 3; ++k) {
            around.push_back({side_tail(whole_.triangles, 3 * t + k), whole_.corners.col(3 * t + k)});
            int& middle = middle_[edges_.edge_of_side[3 * t + k]];
            if (middle == none) continue;
            const auto& [a, b] = edges_.ends[edges_.edge_of_side[3 * t + k]];
            if (middle == unmade) middle = added(0.5 * (points_[a] + points_[b]));
            const Vector3 next = whole_.corners.col(3 * t + (k + 1) % 3);
            around.push_back({middle, 0.5 * (around.back().weights + next), true});
        }
        if (around.size() > 3) {
            for (const auto& piece : cut(std::move(around))) add(t, piece);
            return;
        }
        const auto mean = [](const Vector3& a, const Vector3& b, const Vector3& c) -> Vector3 {
            return (a + b + c) / 3.0;
        };
        const Corner hub{added(mean(points_[around[0].vertex], points_[around[1].vertex], points_[around[2].vertex])),
                         mean(around[0].weights, around[1].weights, around[2].weights)};
        for (std::size_t k = 0; k < 3; ++k) add(t, {around[k], around[(k + 1) % 3], hub});
    }

    void add(int t, const std::array<Corner, 3>& piece) {
        triangles_.emplace_back(piece[0].vertex, piece[1].vertex, piece[2].vertex);
        parents_.push_back(whole_.parent[t]);
        for (const Corner& corner : piece) corners_.push_back(corner.weights);
    }

    const RefinedPatch& whole_;
    EdgeTable edges_;
    Indices middle_;  // of each edge; `none`: it stays
    std::vector<Vector3> points_;
    std::vector<Eigen::Vector3i> triangles_;
    Indices parents_;
    std::vector<Vector3> corners_;
};

bool all_on_border(const Triangles& triangles, int vertex_count) {
    std::vector<char> on_border(static_cast<std::size_t>(vertex_count), 0);
    for (const Indices& loop : boundary_loops(triangles, vertex_count))
        for (const int v : loop) on_border[v] = 1;
    return std::ranges::all_of(triangles.reshaped(), [&](int v) { return on_border[v] != 0; });
}

}  // namespace

std::optional<RefinedPatch> with_inner_vertices(const Points& points, const Triangles& triangles,
                                                const std::optional<Indices>& fixed, const VertexPairs& kept) {
    const auto count = static_cast<int>(points.cols());
    if (triangles.cols() == 0) return std::nullopt;
    const Indices component = component_of_triangles(triangles, fixed, count);
    if (std::ranges::any_of(component, [](int number) { return number != none; })) return std::nullopt;
    if (!all_on_border(triangles, count)) return std::nullopt;
    RefinedPatch whole{points, triangles, Indices(component.size()), {}};
    std::iota(whole.parent.begin(), whole.parent.end(), 0);
    whole.corners = Eigen::Matrix3d::Identity().replicate(1, triangles.cols());
    std::set<std::array<int, 2>> held;
    for (const auto& [a, b] : kept) held.insert({std::min(a, b), std::max(a, b)});
    for (int k = 0; k < halvings; ++k) {
        RefinedPatch next = Halving(whole, held).halved();
        whole = std::move(next);
    }
    return whole;
}

}  // namespace fairing
