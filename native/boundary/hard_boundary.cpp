#include "boundary/hard_boundary.h"

#include <algorithm>
#include <map>

#include "base/direction.h"
#include "boundary/closing.h"
#include "geometry/angle.h"
#include "geometry/area_vector.h"
#include "mesh/edges.h"
#include "mesh/union_find.h"

namespace fairing {

namespace {

// With one triangle on either side: sides 3 t + k of the two lists.
struct Meeting {
    std::array<int, 2> ends;
    int inside;
    int outside;
};

std::vector<Meeting> meetings(const PatchInMesh& mesh) {
    const auto count = static_cast<int>(mesh.points.cols());
    const EdgeTable inside = make_edges(mesh.inside, count);
    const EdgeTable outside = make_edges(mesh.outside, count);
    std::vector<Meeting> found;
    for (int i = 0, o = 0; i < inside.size() && o < outside.size();) {
        if (inside.ends[i] < outside.ends[o]) {
            ++i;
        } else if (outside.ends[o] < inside.ends[i]) {
            ++o;
        } else {
            if (inside.side_count(i) == 1 && outside.side_count(o) == 1)
                found.push_back({inside.ends[i], inside.side(i, 0), outside.side(o, 0)});
            ++i, ++o;
        }
    }
    return found;
}

Vector3 normal_of(const Points& points, const Triangles& triangles, int side) {
    return direction(area_vector(points, triangles.col(side / 3)));
}

struct HardMeeting {
    std::array<int, 2> ends;
    std::array<bool, 2> goes_on;  // whether a hard edge outside begins at that end
    double leans_in;              // degrees by which the closing surface is clearly nearer to the inside, times length
};

// Marks of the patch's vertices from which hard edges lead outside.
std::vector<char> ends_outside(const VertexPairs& edges, const PatchInMesh& mesh) {
    std::vector<char> own(static_cast<std::size_t>(mesh.points.cols()), 0);
    for (const int v : mesh.inside.reshaped()) own[v] = 1;
    std::vector<char> marks(own.size(), 0);
    for (const auto& [a, b] : edges) {
        if (own[a] != own[b]) marks[own[a] ? a : b] = 1;
    }
    return marks;
}

std::vector<HardMeeting> hard_meetings(const PatchInMesh& mesh, const VertexPairs& creases,
                                       const std::vector<char>& held) {
    std::vector<Meeting> all = meetings(mesh);
    Triangles both(3, mesh.inside.cols() + mesh.outside.cols());
    both << mesh.inside, mesh.outside;
    const VertexPairs edges = hard_edges(mesh.points, both, creases);
    std::erase_if(all, [&](const Meeting& edge) { return !std::binary_search(edges.begin(), edges.end(), edge.ends); });
    if (all.empty()) return {};
    const std::vector<char> goes_on = ends_outside(edges, mesh);
    const Points closed = closing_surface(mesh.points, mesh.whole, held);
    std::vector<HardMeeting> result;
    for (const Meeting& edge : all) {
        const bool alike = side_tail(mesh.inside, edge.inside) == side_tail(mesh.outside, edge.outside);
        const Vector3 inside = normal_of(mesh.points, mesh.inside, edge.inside);
        const Vector3 outside = (alike ? -1.0 : 1.0) * normal_of(mesh.points, mesh.outside, edge.outside);
        const Vector3 leaves = normal_of(closed, mesh.inside, edge.inside);
        const double length = (mesh.points.col(edge.ends[0]) - mesh.points.col(edge.ends[1])).norm();
        const double nearer = degrees_between(leaves, outside) - degrees_between(leaves, inside) - fading_bend;
        result.push_back({edge.ends, {goes_on[edge.ends[0]] != 0, goes_on[edge.ends[1]] != 0}, length * nearer});
    }
    return result;
}

// Which of the edges decide together: those that hang together. A dent that ends in a crease leans here to the one side
// and there to the other one.
UnionFind rows_of(const std::vector<HardMeeting>& edges) {
    std::map<int, int> at_vertex;
    UnionFind rows(static_cast<int>(edges.size()));
    for (int k = 0; k < static_cast<int>(edges.size()); ++k) {
        for (int v : edges[k].ends) {
            const auto [place, is_first] = at_vertex.try_emplace(v, k);
            if (!is_first) rows.join(place->second, k);
        }
    }
    return rows;
}

}  // namespace

VertexPairs outline_edges(const PatchInMesh& mesh) {
    VertexPairs result;
    for (const Meeting& edge : meetings(mesh)) result.push_back(edge.ends);
    return result;
}

VertexPairs inward_edges(const PatchInMesh& mesh, const VertexPairs& creases, const std::vector<char>& held) {
    const std::vector<HardMeeting> edges = hard_meetings(mesh, creases, held);
    UnionFind rows = rows_of(edges);
    std::map<int, int> uses;
    for (const HardMeeting& edge : edges) {
        for (int v : edge.ends) ++uses[v];
    }
    VectorX sums = VectorX::Zero(static_cast<Eigen::Index>(edges.size()));
    std::vector<char> ends_loose(edges.size(), 0);
    for (int k = 0; k < static_cast<int>(edges.size()); ++k) {
        const int row = rows.root(k);
        sums[row] += edges[k].leans_in;
        for (std::size_t end : {0, 1}) {
            if (uses[edges[k].ends[end]] == 1 && !edges[k].goes_on[end]) ends_loose[row] = 1;
        }
    }
    VertexPairs inward;
    for (int k = 0; k < static_cast<int>(edges.size()); ++k) {
        const int row = rows.root(k);
        if (sums[row] > 0.0 && !ends_loose[row]) inward.push_back(edges[k].ends);
    }
    return inward;
}

}  // namespace fairing
