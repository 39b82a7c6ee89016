#include "mesh/topology.h"

#include "base/background_task.h"
#include "base/progress.h"
#include "mesh/fans.h"
#include "mesh/union_find.h"

namespace fairing {

namespace {

bool has_free_corner(const Triangles& triangles, int side, const VertexRoles& roles) {
    const auto corners = triangles.col(side / 3);
    return !(roles.fixed[corners[0]] && roles.fixed[corners[1]] && roles.fixed[corners[2]]);
}

bool is_between_fixed(const EdgeTable& edges, int edge, const VertexRoles& roles) {
    const auto [a, b] = edges.ends[edge];
    return roles.fixed[a] && roles.fixed[b];
}

bool is_smooth(const EdgeTable& edges, int edge, const VertexRoles& roles) {
    const auto [a, b] = edges.ends[edge];
    return roles.smooth[a] || roles.smooth[b];
}

// A two-sided edge between two border vertices with a triangle behind it that has no free vertex.
bool is_corner_chord(const Triangles& triangles, const EdgeTable& edges, int edge, const VertexRoles& roles) {
    const auto [a, b] = edges.ends[edge];
    if (!roles.border[a] || !roles.border[b]) return false;
    return !has_free_corner(triangles, edges.side(edge, 0), roles) ||
           !has_free_corner(triangles, edges.side(edge, 1), roles);
}

void check_edge_is_manifold(const EdgeTable& edges, int edge, const VertexRoles& roles, Indices& offenders) {
    // Being on the border is no excuse: the ends of a fin's attached edge always are, on the fin's own.
    const auto [a, b] = edges.ends[edge];
    if (edges.side_count(edge) <= 2 || (roles.given[a] && roles.given[b])) return;
    offenders.insert(offenders.end(), edges.ends[edge].begin(), edges.ends[edge].end());
}

// Nothing opens along a single edge whose ends lie inside the mesh: both its ends would keep their whole ring.
void keep_lone_edges(const EdgeTable& edges, const VertexRoles& roles, std::vector<char>& cut) {
    Indices degree(roles.fixed.size(), 0);
    for (int e = 0; e < edges.size(); ++e) {
        if (!cut[e]) continue;
        for (int v : edges.ends[e]) ++degree[v];
    }
    for (int e = 0; e < edges.size(); ++e) {
        const auto [a, b] = edges.ends[e];
        const bool inside = !roles.border[a] && !roles.border[b];
        if (cut[e] && inside && degree[a] == 1 && degree[b] == 1 && edges.side_count(e) == 2) cut[e] = 0;
    }
}

bool same_direction(const Triangles& triangles, int side_a, int side_b) {
    return side_tail(triangles, side_a) == side_tail(triangles, side_b);
}

void check_fans(const Fans& fans, const VertexRoles& roles) {
    Indices count(roles.fixed.size(), 0);
    Indices offenders;
    for (int v : fans.input_vertex) {
        if (++count[v] == 2 && !roles.fixed[v]) offenders.push_back(v);
    }
    if (offenders.empty()) return;
    const std::string more = offenders.size() > 1 ? " and " + std::to_string(offenders.size() - 1) + " more" : "";
    throw MeshError(about(Code::nonmanifold_vertex,
                          "triangles touch only in free vertex " + std::to_string(offenders.front()) + more +
                              ": split it, or add it to `fixed`",
                          offenders, ElementKind::vertex, "vertices"));
}

// Union of triangles across edges; parity records the windings.
struct Windings {
    UnionFind pieces;       // across uncut edges
    UnionFind orientation;  // across all two-sided edges, uncut ones first
    Indices conflicts;      // triangles at uncut edges where the windings can't agree
};

Windings join_windings(const Triangles& triangles, const EdgeTable& edges, const std::vector<char>& cut) {
    const int count = static_cast<int>(triangles.cols());
    Windings windings{UnionFind(count), UnionFind(count), {}};
    for (const bool across_cuts : {false, true}) {
        for (int e = 0; e < edges.size(); ++e) {
            checkpoint(e);
            if (edges.side_count(e) != 2 || (cut[e] != 0) != across_cuts) continue;
            const int a = edges.side(e, 0);
            const int b = edges.side(e, 1);
            if (!across_cuts) windings.pieces.join(a / 3, b / 3);
            const bool agrees = windings.orientation.join(a / 3, b / 3, same_direction(triangles, a, b));
            if (!agrees && !across_cuts) windings.conflicts.insert(windings.conflicts.end(), {a / 3, b / 3});
        }
    }
    return windings;
}

// Flags of triangles in pieces with a free vertex.
std::vector<char> moving_triangles(const Triangles& triangles, Windings& windings, const VertexRoles& roles) {
    const auto count = static_cast<int>(triangles.cols());
    std::vector<char> piece_moves(count, 0);
    for (int t = 0; t < count; ++t) {
        if (has_free_corner(triangles, 3 * t, roles)) piece_moves[windings.pieces.root(t)] = 1;
    }
    std::vector<char> moves(count, 0);
    for (int t = 0; t < count; ++t) moves[t] = piece_moves[windings.pieces.root(t)];
    return moves;
}

Indices select(const Indices& items, const std::vector<char>& marked) {
    Indices result;
    std::copy_if(items.begin(), items.end(), std::back_inserter(result), [&](int item) { return marked[item]; });
    return result;
}

void check_orientable(const Indices& twisted, const Indices& input_triangle) {
    Indices offenders;
    for (int t : twisted) offenders.push_back(input_triangle[t]);
    if (offenders.empty()) return;
    std::sort(offenders.begin(), offenders.end());
    throw MeshError(about(Code::not_orientable,
                          "the mesh has a single side (a Möbius strip) through triangle " +
                              std::to_string(offenders.front()) + ": cut it open, or fair a part that has two sides",
                          offenders, ElementKind::triangle, "triangles"));
}

void check_doubled(const Triangles& triangles, const Indices& doubled) {
    Indices offenders;
    for (int t : doubled) {
        for (int k = 0; k < 3; ++k) offenders.insert(offenders.end(), {triangles(k, t), triangles((k + 1) % 3, t)});
    }
    if (offenders.empty()) return;
    throw MeshError({Code::nonmanifold_edge,
                     "two triangles lie on the same three vertices " + std::to_string(offenders[0]) + ", " +
                         std::to_string(offenders[2]) + ", " + std::to_string(offenders[4]) + ": delete one of them",
                     offenders,
                     ElementKind::vertex,
                     {{"doubled_triangles", size_of(doubled)}}});
}

// Connects triangles across the edges that are not cut.
struct Joints {
    Twins twins;
    Fans fans;
    Windings windings;
};

Joints join_triangles(const Triangles& triangles, const EdgeTable& edges, const std::vector<char>& cut) {
    Joints joints{twins_across(edges, cut), {}, {UnionFind(0), UnionFind(0), {}}};
    BackgroundTask winding([&] { joints.windings = join_windings(triangles, edges, cut); });
    joints.fans = join_corners(triangles, joints.twins);
    winding.finish();
    return joints;
}

// Turns flipped triangles round: their first side becomes the last one.
void turn_round(CutMesh& mesh) {
    if (std::find(mesh.flipped.begin(), mesh.flipped.end(), 1) == mesh.flipped.end()) return;
    for (int& twin : mesh.twins) {
        if (twin != none && mesh.flipped[twin / 3]) twin += 2 - 2 * (twin % 3);
    }
    for (int t = 0; t < mesh.triangles.cols(); ++t) {
        if (!mesh.flipped[t]) continue;
        std::swap(mesh.triangles(1, t), mesh.triangles(2, t));
        std::swap(mesh.twins[3 * t], mesh.twins[3 * t + 2]);
    }
}

// Takes pieces that can't be joined apart into single triangles where nothing in them moves; throws where it does.
Joints join_or_take_apart(const Triangles& triangles, const EdgeTable& edges, const Indices& input_triangle,
                          const VertexRoles& roles) {
    std::vector<char> cut = find_cut_edges(triangles, edges, roles);
    checkpoint();
    Joints joints = join_triangles(triangles, edges, cut);
    check_fans(joints.fans, roles);
    const Indices doubled = doubled_triangles(triangles, edges, joints.fans);
    Indices defects = joints.windings.conflicts;
    defects.insert(defects.end(), doubled.begin(), doubled.end());
    if (defects.empty()) return joints;
    const std::vector<char> moves = moving_triangles(triangles, joints.windings, roles);
    check_doubled(triangles, select(doubled, moves));
    check_orientable(select(joints.windings.conflicts, moves), input_triangle);
    std::vector<char> cut_open(static_cast<int>(triangles.cols()), 0);
    for (int t : defects) cut_open[joints.windings.pieces.root(t)] = 1;
    for (std::size_t s = 0; s < edges.edge_of_side.size(); ++s) {
        if (cut_open[joints.windings.pieces.root(static_cast<int>(s) / 3)]) cut[edges.edge_of_side[s]] = 1;
    }
    return join_triangles(triangles, edges, cut);
}

// Those that move and have an edge of the boundary.
std::vector<char> boundary_triangles(const Triangles& triangles, const VertexRoles& roles) {
    std::vector<char> marks;
    for (const auto t : triangles.colwise()) {
        const auto fixed = std::count_if(t.begin(), t.end(), [&](int v) { return roles.fixed[v]; });
        marks.push_back(fixed == 2 ? 1 : 0);
    }
    return marks;
}

// Triangles to reverse so that each piece follows the majority of those that `vote`, or of all where that is a tie.
std::vector<char> minority_triangles(const std::vector<char>& vote, UnionFind& orientation) {
    struct Balance {
        int voters = 0;
        int all = 0;
        [[nodiscard]] bool reversed() const { return voters != 0 ? voters < 0 : all < 0; }
    };
    const auto count = static_cast<int>(vote.size());
    std::vector<Balance> balances(vote.size());
    for (int t = 0; t < count; ++t) {
        const auto [root, opposite] = orientation.find(t);
        Balance& balance = balances[root];
        balance.all += opposite ? -1 : 1;
        if (vote[t]) balance.voters += opposite ? -1 : 1;
    }
    std::vector<char> flipped(vote.size(), 0);
    for (int t = 0; t < count; ++t) {
        const auto [root, opposite] = orientation.find(t);
        flipped[t] = balances[root].reversed() != opposite;
    }
    return flipped;
}

void warn_of_windings(const CutMesh& mesh, Diagnostics& warnings) {
    Indices offenders;
    for (std::size_t t = 0; t < mesh.flipped.size(); ++t) {
        if (mesh.flipped[t]) offenders.push_back(mesh.input_triangle[t]);
    }
    if (offenders.empty()) return;
    std::sort(offenders.begin(), offenders.end());
    warnings.push_back(about(
        Code::inconsistent_winding,
        counted(offenders.size(), "triangle is wound against the others", "triangles are wound against the others") +
            "; solved on a copy with one winding",
        offenders, ElementKind::triangle, "triangles"));
}

// Numbers pieces by the lowest input triangle; the order of triangles here may differ.
void number_pieces(CutMesh& mesh, UnionFind& pieces) {
    const int count = static_cast<int>(mesh.triangles.cols());
    Indices lowest(count, none);  // lowest input triangle of the piece with this root
    Indices roots;
    for (int t = 0; t < count; ++t) {
        const int root = pieces.root(t);
        const int input = mesh.input_triangle[t];
        if (lowest[root] == none) roots.push_back(root);
        if (lowest[root] == none || input < lowest[root]) lowest[root] = input;
    }
    std::sort(roots.begin(), roots.end(), [&](int a, int b) { return lowest[a] < lowest[b]; });
    mesh.piece_count = static_cast<int>(roots.size());
    Indices number(count, none);
    for (int k = 0; k < mesh.piece_count; ++k) number[roots[k]] = k;
    mesh.piece.resize(count);
    for (int t = 0; t < count; ++t) mesh.piece[t] = number[pieces.root(t)];
}

}  // namespace

Triangles drop_collapsed_triangles(const Triangles& triangles, Indices& kept, Diagnostics& warnings) {
    Indices dropped;
    for (int t = 0; t < triangles.cols(); ++t) {
        const auto c = triangles.col(t);
        const bool collapsed = c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
        (collapsed ? dropped : kept).push_back(t);
    }
    Triangles result(3, static_cast<Eigen::Index>(kept.size()));
    for (std::size_t k = 0; k < kept.size(); ++k) result.col(static_cast<Eigen::Index>(k)) = triangles.col(kept[k]);
    if (!dropped.empty()) {
        warnings.push_back(about(Code::degenerate_face,
                                 counted(dropped.size(), "triangle names a vertex twice and was left out",
                                         "triangles name a vertex twice and were left out"),
                                 dropped, ElementKind::triangle, "repeated"));
    }
    return result;
}

VertexRoles classify_vertices(const EdgeTable& edges, const GivenRoles& given) {
    const std::size_t count = given.fixed.size();
    const std::vector<char> nowhere(count, 0);
    VertexRoles roles{given.fixed, given.fixed, nowhere, {}, nowhere, nowhere, nowhere, nowhere};
    for (int e = 0; e < edges.size(); ++e) {
        for (int v : edges.ends[e]) {
            roles.used[v] = 1;
            if (edges.side_count(e) == 1) roles.fixed[v] = roles.border[v] = 1;
        }
    }
    roles.pin = roles.fixed;
    for (int e = 0; e < edges.size(); ++e) {
        if (!is_between_fixed(edges, e, roles)) continue;
        for (int v : edges.ends[e]) roles.pin[v] = 0;
    }
    for (std::size_t v = 0; v < count; ++v) {
        roles.smooth[v] = !given.smooth.empty() && given.smooth[v] && roles.used[v];
        roles.faired[v] = given.fair_border && roles.border[v] && !given.fixed[v];
        roles.free_slope[v] =
            roles.smooth[v] || roles.faired[v] || (!given.crease.empty() && given.crease[v] && roles.used[v]);
        roles.pin[v] = roles.free_slope[v] || (roles.pin[v] && roles.used[v]);
    }
    return roles;
}

std::vector<char> find_cut_edges(const Triangles& triangles, const EdgeTable& edges, const VertexRoles& roles) {
    std::vector<char> cut(edges.size(), 0);
    Indices offenders;
    for (int e = 0; e < edges.size(); ++e) {
        check_edge_is_manifold(edges, e, roles, offenders);
        if (!is_between_fixed(edges, e, roles) || edges.side_count(e) < 2) continue;
        const bool many = edges.side_count(e) > 2;
        const bool beside_free =
            has_free_corner(triangles, edges.side(e, 0), roles) || has_free_corner(triangles, edges.side(e, 1), roles);
        cut[e] = many || (beside_free && !is_smooth(edges, e, roles) && !is_corner_chord(triangles, edges, e, roles));
    }
    if (!offenders.empty()) {
        throw MeshError({Code::nonmanifold_edge,
                         "more than two triangles meet at the edge " + std::to_string(offenders[0]) + "–" +
                             std::to_string(offenders[1]) + ": delete some, or add both ends to `fixed`",
                         offenders,
                         ElementKind::vertex,
                         {{"edges", size_of(offenders) / 2}}});
    }
    keep_lone_edges(edges, roles, cut);
    return cut;
}

CutMesh cut_mesh(const Triangles& triangles, const EdgeTable& edges, const Indices& input_triangle,
                 const VertexRoles& roles, Diagnostics& warnings) {
    auto [twins, fans, windings] = join_or_take_apart(triangles, edges, input_triangle, roles);

    CutMesh mesh;
    mesh.input_triangle = input_triangle;
    mesh.input_vertex = std::move(fans.input_vertex);
    checkpoint();
    // The boundary's normals are meant for the triangles there, and continue what surrounds them.
    const std::vector<char> along_boundary = boundary_triangles(triangles, roles);
    mesh.flipped = minority_triangles(along_boundary, windings.orientation);
    warn_of_windings(mesh, warnings);
    mesh.triangles.resize(3, triangles.cols());
    for (int c = 0; c < 3 * triangles.cols(); ++c) mesh.triangles(c % 3, c / 3) = fans.of_corner[c];
    mesh.twins = std::move(twins);
    turn_round(mesh);
    checkpoint();
    number_pieces(mesh, windings.pieces);
    return mesh;
}

}  // namespace fairing
