#include "boundary/hard_boundary.h"

#include <algorithm>
#include <map>

#include "base/direction.h"
#include "boundary/closing.h"
#include "geometry/angle.h"
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
    const auto corners = triangles.col(side / 3);
    const Vector3 a = points.col(corners[0]);
    return direction((points.col(corners[1]) - a).cross(Vector3(points.col(corners[2]) - a)));
}

struct HardMeeting {
    std::array<int, 2> ends;
    Vector3 inside;  // unit normals, in the winding of the patch
    Vector3 outside;
    double leans_in;  // degrees by which the closing surface is nearer to the inside, times the length
};

std::vector<HardMeeting> hard_meetings(const PatchInMesh& mesh, const VertexPairs& creases,
                                       const std::vector<char>& held) {
    std::vector<Meeting> all = meetings(mesh);
    Triangles both(3, mesh.inside.cols() + mesh.outside.cols());
    both << mesh.inside, mesh.outside;
    const VertexPairs edges = hard_edges(mesh.points, both, creases);
    std::erase_if(all, [&](const Meeting& edge) { return !std::binary_search(edges.begin(), edges.end(), edge.ends); });
    if (all.empty()) return {};
    const Points closed = closing_surface(mesh.points, mesh.whole, held);
    std::vector<HardMeeting> result;
    for (const Meeting& edge : all) {
        const bool alike = side_tail(mesh.inside, edge.inside) == side_tail(mesh.outside, edge.outside);
        HardMeeting hard{edge.ends, normal_of(mesh.points, mesh.inside, edge.inside),
                         (alike ? -1.0 : 1.0) * normal_of(mesh.points, mesh.outside, edge.outside), 0.0};
        const Vector3 leaves = normal_of(closed, mesh.inside, edge.inside);
        const double length = (mesh.points.col(edge.ends[0]) - mesh.points.col(edge.ends[1])).norm();
        hard.leans_in = length * (degrees_between(leaves, hard.outside) - degrees_between(leaves, hard.inside));
        result.push_back(hard);
    }
    return result;
}

// Which of the edges decide together: neighbours between whose triangles there is no hard edge on either side.
UnionFind rows_of(const std::vector<HardMeeting>& edges) {
    std::map<int, Indices> at_vertex;
    for (int k = 0; k < static_cast<int>(edges.size()); ++k) {
        for (int v : edges[k].ends) at_vertex[v].push_back(k);
    }
    UnionFind rows(static_cast<int>(edges.size()));
    for (const auto& [vertex, here] : at_vertex) {
        if (here.size() != 2) continue;
        const HardMeeting& a = edges[here[0]];
        const HardMeeting& b = edges[here[1]];
        const double turn = std::max(degrees_between(a.inside, b.inside), degrees_between(a.outside, b.outside));
        if (turn < hard_bend) rows.join(here[0], here[1]);
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
    VectorX sums = VectorX::Zero(static_cast<Eigen::Index>(edges.size()));
    for (int k = 0; k < static_cast<int>(edges.size()); ++k) sums[rows.root(k)] += edges[k].leans_in;
    VertexPairs inward;
    for (int k = 0; k < static_cast<int>(edges.size()); ++k) {
        if (sums[rows.root(k)] > 0.0) inward.push_back(edges[k].ends);
    }
    return inward;
}

}  // namespace fairing
