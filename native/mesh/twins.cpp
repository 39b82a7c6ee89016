#include "mesh/twins.h"

#include <tuple>

#include "base/progress.h"
#include "mesh/union_find.h"

namespace fairing {

namespace {

struct BorderSide {
    std::array<int, 2> ends;  // ascending
    int side;
};

std::vector<BorderSide> border_sides(const Triangles& triangles, const Twins& twins) {
    std::vector<BorderSide> sides;
    for (int s = 0; s < static_cast<int>(twins.size()); ++s) {
        if (twins[s] != none) continue;
        const int tail = side_tail(triangles, s);
        const int head = side_head(triangles, s);
        sides.push_back({{std::min(tail, head), std::max(tail, head)}, s});
    }
    std::sort(sides.begin(), sides.end(), [](const BorderSide& a, const BorderSide& b) {
        return std::tie(a.ends, a.side) < std::tie(b.ends, b.side);
    });
    return sides;
}

// The sides that leave each vertex, as far as they were met.
class Outgoing {
public:
    Outgoing(const Triangles& triangles, int vertex_count) : begin_(vertex_count + 1, 0) {
        for (const int v : triangles.reshaped()) ++begin_[v + 1];
        for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
        end_.assign(begin_.begin(), begin_.end() - 1);
        sides_.resize(begin_.back());
    }

    [[nodiscard]] int find(int tail, int head) const {
        for (int s = begin_[tail]; s < end_[tail]; ++s) {
            if (sides_[s].head == head) return sides_[s].side;
        }
        return none;
    }

    void add(int side, int tail, int head) { sides_[end_[tail]++] = {head, side}; }

private:
    struct Side {
        int head;
        int side;
    };

    Indices begin_;
    Indices end_;
    std::vector<Side> sides_;
};

}  // namespace

Twins twins_across(const EdgeTable& edges, const std::vector<char>& cut) {
    Twins twins(edges.edge_of_side.size(), none);
    for (int e = 0; e < edges.size(); ++e) {
        checkpoint(e);
        if (cut[e] || edges.side_count(e) != 2) continue;
        twins[edges.side(e, 0)] = edges.side(e, 1);
        twins[edges.side(e, 1)] = edges.side(e, 0);
    }
    return twins;
}

Misfit join_borders(const Triangles& triangles, Twins& twins) {
    const std::vector<BorderSide> sides = border_sides(triangles, twins);
    for (std::size_t k = 1; k < sides.size(); ++k) {
        if (sides[k].ends != sides[k - 1].ends) continue;
        const int a = sides[k - 1].side;
        const int b = sides[k].side;
        if (twins[a] != none || side_tail(triangles, a) == side_tail(triangles, b)) return b;
        twins[a] = b;
        twins[b] = a;
    }
    return std::nullopt;
}

Misfit find_twins(const Triangles& triangles, int vertex_count, Twins& twins) {
    twins.assign(static_cast<std::size_t>(triangles.size()), none);
    Outgoing met(triangles, vertex_count);
    for (int side = 0; side < static_cast<int>(twins.size()); ++side) {
        checkpoint(side);
        const int tail = side_tail(triangles, side);
        const int head = side_head(triangles, side);
        const int twin = met.find(head, tail);
        if (twin == none ? met.find(tail, head) != none : twins[twin] != none) return side;
        if (twin != none) {
            twins[side] = twin;
            twins[twin] = side;
        }
        met.add(side, tail, head);
    }
    return std::nullopt;
}

Indices turned_triangles(const Triangles& triangles, int vertex_count) {
    const int count = static_cast<int>(triangles.cols());
    const EdgeTable edges = make_edges(triangles, vertex_count);
    UnionFind pieces(count);
    Indices twisted;  // a triangle of each edge at which a piece disagrees with itself
    for (int e = 0; e < edges.size(); ++e) {
        if (edges.side_count(e) != 2) continue;
        const int a = edges.side(e, 0);
        const int b = edges.side(e, 1);
        const bool opposite = side_tail(triangles, a) == side_tail(triangles, b);
        if (!pieces.join(a / 3, b / 3, opposite)) twisted.push_back(a / 3);
    }
    Indices votes(static_cast<std::size_t>(count), 0);  // of each piece: for its first triangle's winding
    for (int t = 0; t < count; ++t) {
        const auto [piece, against] = pieces.find(t);
        votes[piece] += against ? -1 : 1;
    }
    std::vector<char> one_sided(static_cast<std::size_t>(count), 0);
    for (const int t : twisted) one_sided[pieces.root(t)] = 1;
    Indices turned;
    for (int t = 0; t < count; ++t) {
        const auto [piece, against] = pieces.find(t);
        if (one_sided[piece] == 0 && against != (votes[piece] < 0)) turned.push_back(t);
    }
    return turned;
}

Triangles without_collapsed(const Triangles& triangles) {
    std::vector<Eigen::Index> kept;
    for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
        const auto corners = triangles.col(t);
        if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]) kept.push_back(t);
    }
    return triangles(Eigen::all, kept);
}

}  // namespace fairing
