#include "fill/loop_check.h"

#include <map>
#include <set>

#include "fill/loop_sides.h"
#include "geometry/segments.h"

namespace fairing {

namespace {

using Triple = std::array<int, 3>;

void refuse(Code code, const std::string& text, Indices vertices, Figures figures = {}) {
    throw MeshError(at_vertices(code, text, std::move(vertices), std::move(figures)));
}

Indices once(Indices vertices) {
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

void check_loop(const Indices& loop, bool is_bare) {
    std::map<int, int> uses;
    for (const int v : loop) ++uses[v];
    if (uses.size() < 3)
        refuse(Code::not_a_loop,
               "a loop of " + std::to_string(loop.size()) + " vertices bounds nothing: three are needed", loop);
    if (!is_bare || uses.size() == loop.size()) return;
    Indices twice;
    for (const auto& [v, count] : uses) {
        if (count > 1) twice.push_back(v);
    }
    const std::string text = "a loop without triangles touches itself at " + listed(twice) + ": split these vertices";
    const double pinches = size_of(twice);
    refuse(Code::nonmanifold_vertex, text, std::move(twice), {{"pinches", pinches}});
}

void check_places(const std::vector<Indices>& loops, const View<Points>& points) {
    Indices broken;
    Indices same;
    for (const Indices& loop : loops) {
        for (const int v : loop) {
            if (!points.col(v).allFinite()) broken.push_back(v);
        }
    }
    if (!broken.empty()) refuse(Code::nonfinite, "coordinates are not finite at " + listed(broken), broken);
    for (const Indices& loop : loops) {
        for (const auto& [a, b] : edges_around(loop)) {
            if (points.col(a) == points.col(b)) same.push_back(a);
        }
    }
    if (!same.empty())
        refuse(Code::not_a_loop, "an edge of a loop has no length at " + listed(same) + ": merge these vertices", same);
}

void refuse_on_edges(const std::vector<Triple>& on_edges) {
    const auto [a, b, first] = on_edges.front();
    Indices here;
    Indices all{a, b};
    for (const auto& [c, d, v] : on_edges) {
        if (c == a && d == b) here.push_back(v);
        all.push_back(v);
    }
    const auto lying = once({all.begin() + 2, all.end()}).size();
    const bool is_one = here.size() == 1;
    const std::string more = lying > here.size() ? " (" + std::to_string(lying) + " on edges in all)" : "";
    const std::string text = listed(here) + " of a boundary " + (is_one ? "lies on its" : "lie on its") + " edge " +
                             std::to_string(a) + "-" + std::to_string(b) + more + ": dissolve " +
                             (is_one ? "it" : "them") + ", or split that edge there and merge";
    refuse(Code::nonmanifold_vertex, text, std::move(all),
           {{lying == 1 ? "on_edge" : "on_edges", static_cast<double>(lying)}});
}

void refuse_touches(const VertexPairs& edges, const View<Points>& points, bool may_cross) {
    const Touches found = touching_edges(edges, points);
    if (!found.on_edges.empty()) refuse_on_edges(found.on_edges);
    Indices meeting;
    for (const auto& pair : found.pairs) meeting.insert(meeting.end(), pair.begin(), pair.end());
    meeting = once(std::move(meeting));
    if (!meeting.empty()) {
        const double count = size_of(meeting);
        const std::string text = "a boundary passes through one place several times, with " + listed(meeting) +
                                 ": merge them where the mesh is torn, move them apart where the boundary touches "
                                 "itself";
        refuse(Code::nonmanifold_vertex, text, std::move(meeting), {{"meeting", count}});
    }
    if (may_cross) return;
    Indices crossing;
    for (const auto& ends : crossing_edges(edges, points)) crossing.insert(crossing.end(), ends.begin(), ends.end());
    crossing = once(std::move(crossing));
    if (crossing.empty()) return;
    const double count = size_of(crossing);
    const std::string text = "edges of a boundary cross each other at " + listed(crossing) + ": move them apart";
    refuse(Code::nonmanifold_vertex, text, std::move(crossing), {{"crossing", count}});
}

}  // namespace

Diagnostic at_vertices(Code code, const std::string& text, Indices vertices, Figures figures) {
    figures.emplace("vertices", size_of(vertices));
    return {code, text, std::move(vertices), ElementKind::vertex, std::move(figures)};
}

void check_boundary(const std::vector<Indices>& loops, const std::vector<char>& is_bare, const View<Points>& points,
                    bool may_cross) {
    VertexPairs edges;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        check_loop(loops[l], is_bare[l] != 0);
        const VertexPairs around = edges_around(loops[l]);
        edges.insert(edges.end(), around.begin(), around.end());
    }
    check_places(loops, points);
    refuse_touches(edges, points, may_cross);
}

void refuse_shared_edges(const std::vector<Indices>& loops) {
    std::set<std::array<int, 2>> seen;
    std::set<int> twice;
    for (const Indices& loop : loops) {
        for (const auto& [a, b] : edges_around(loop)) {
            if (!seen.insert({std::min(a, b), std::max(a, b)}).second) twice.insert({a, b});
        }
    }
    if (twice.empty()) return;
    Indices vertices(twice.begin(), twice.end());
    const std::string text = "loops: an edge is passed twice at " + listed(vertices) + ": name it once";
    refuse(Code::not_a_loop, text, std::move(vertices));
}

}  // namespace fairing
