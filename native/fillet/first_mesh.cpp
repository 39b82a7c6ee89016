#include "fillet/first_mesh.h"

#include <set>

#include "geometry/triangle.h"
#include "mesh/edges.h"
#include "mesh/loops.h"

namespace fairing {

namespace {

using Pair = std::array<int, 2>;

// Shares of the spacing.
constexpr double tiny = 0.02;               // edges that short are closed
constexpr double sliver = 0.1;              // lower triangles would stay as low between edges that stay
constexpr double crushed = 0.1;             // of its area before: a triangle that loses more may lie on an edge
constexpr double brief = 0.5;               // edges of seams that short are closed; the new mesh would be as fine
constexpr std::size_t most_of_speck = 200;  // triangles

double extent(const Points& points, const Indices& vertices) {
    const Points some = points(Eigen::all, vertices);
    return (some.rowwise().maxCoeff() - some.rowwise().minCoeff()).maxCoeff();
}

Triangles those(const Triangles& triangles, const std::vector<char>& marks, Indices& rows) {
    for (int t = 0; t < static_cast<int>(marks.size()); ++t)
        if (marks[t] != 0) rows.push_back(t);
    return triangles(Eigen::all, rows);
}

// Adds to `inside` what lies around small loops, where all of it is as small.
void take_specks(CutPieces& cut, const VectorX& spacings) {
    Indices rows;
    const auto count = static_cast<int>(cut.points.cols());
    std::vector<Indices> loops = boundary_loops(those(cut.triangles, cut.inside, rows), count);
    std::erase_if(loops, [&](const Indices& loop) { return !(extent(cut.points, loop) < spacings[loop[0]]); });
    if (loops.empty()) return;
    const EdgeTable edges = make_edges(cut.triangles, count);
    const auto outside_at = [&](int edge) {
        std::vector<int> found;
        for (int k = 0; k < edges.side_count(edge); ++k)
            if (cut.inside[edges.side(edge, k) / 3] == 0) found.push_back(edges.side(edge, k) / 3);
        return found;
    };
    for (const Indices& loop : loops) {
        std::set<int> found;
        Indices waiting;
        const auto reach = [&](int edge) {
            for (const int t : outside_at(edge))
                if (found.insert(t).second) waiting.push_back(t);
        };
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const auto [low, high] = std::minmax(loop[k], loop[(k + 1) % loop.size()]);
            const auto at = std::ranges::lower_bound(edges.ends, Pair{low, high});
            if (at != edges.ends.end() && *at == Pair{low, high}) reach(static_cast<int>(at - edges.ends.begin()));
        }
        while (!waiting.empty() && found.size() <= most_of_speck) {
            const int t = waiting.back();
            waiting.pop_back();
            for (int k = 0; k < 3; ++k) reach(edges.edge_of_side[3 * t + k]);
        }
        if (found.empty() || found.size() > most_of_speck) continue;
        Indices corners;
        for (const int t : found)
            corners.insert(corners.end(), {cut.triangles(0, t), cut.triangles(1, t), cut.triangles(2, t)});
        if (!(extent(cut.points, corners) < spacings[loop[0]])) continue;
        for (const int t : found) cut.inside[t] = 1;
    }
}

// The vertex that each becomes where edges shorter than `least`, of each vertex, are closed, the shortest first.
// Vertices that stay are no ends of the same edge.
Indices merged(const std::vector<Pair>& lines, const Points& points, const std::vector<char>& stays,
               const VectorX& least) {
    Indices into(static_cast<std::size_t>(points.cols()));
    std::iota(into.begin(), into.end(), 0);
    const auto top = [&](int v) {
        while (into[v] != v) v = into[v];
        return v;
    };
    const auto length = [&](const Pair& ends) { return (points.col(ends[0]) - points.col(ends[1])).norm(); };
    std::vector<Pair> brief_ones;
    const auto is_brief = [&](const Pair& ends) { return length(ends) < std::min(least[ends[0]], least[ends[1]]); };
    std::ranges::copy_if(lines, std::back_inserter(brief_ones), is_brief);
    std::ranges::stable_sort(brief_ones, {}, length);
    for (const auto& [one, other] : brief_ones) {
        const int a = top(one);
        const int b = top(other);
        if (a == b || (stays[a] != 0 && stays[b] != 0) || !is_brief({a, b})) continue;
        (stays[b] != 0 ? into[a] : into[b]) = stays[b] != 0 ? b : a;
    }
    for (int& v : into) v = top(v);
    return into;
}

// Whether triangles would lose nearly all of their area: their corners stay then.
bool hold_crushed(const Triangles& triangles, const Points& points, const Indices& into, std::vector<char>& stays) {
    bool any = false;
    for (const auto t : triangles.colwise()) {
        const Eigen::Vector3i to(into[t[0]], into[t[1]], into[t[2]]);
        const Vector3 before = area_vector(points, t);
        const bool gone = to[0] == to[1] || to[1] == to[2] || to[2] == to[0];
        if (gone || !(area_vector(points, to).dot(before) < crushed * before.squaredNorm())) continue;
        for (const int v : t) any = (into[v] != v && std::exchange(stays[v], 1) == 0) || any;
    }
    return any;
}

// Whether no side is there twice, and the boundary loops and Euler's number are still those of all triangles.
bool is_like(const Triangles& closed, const Triangles& triangles, int count) {
    std::set<Pair> sides;
    for (int side = 0; side < static_cast<int>(closed.size()); ++side)
        if (!sides.insert({side_tail(closed, side), side_head(closed, side)}).second) return false;
    const auto euler = [&](const Triangles& list) {
        const std::set<int> used(list.reshaped().begin(), list.reshaped().end());
        return static_cast<std::ptrdiff_t>(used.size()) - make_edges(list, count).size() + list.cols();
    };
    return euler(closed) == euler(triangles) &&
           boundary_loops(closed, count).size() == boundary_loops(triangles, count).size();
}

// Those that are edges of two triangles, both of them higher than slivers.
std::vector<Pair> between(const std::vector<Pair>& lines, const Triangles& triangles, const Points& points,
                          const VectorX& spacings) {
    const EdgeTable edges = make_edges(triangles, static_cast<int>(points.cols()));
    const auto is_high = [&](int side) {
        const double length = (points.col(side_tail(triangles, side)) - points.col(side_head(triangles, side))).norm();
        return area_vector(points, triangles.col(side / 3)).norm() >
               sliver * spacings[side_tail(triangles, side)] * length;
    };
    std::vector<Pair> found;
    for (const auto& [a, b] : lines) {
        const Pair ends{std::min(a, b), std::max(a, b)};
        const auto at = std::ranges::lower_bound(edges.ends, ends);
        if (at == edges.ends.end() || *at != ends) continue;
        const auto e = static_cast<int>(at - edges.ends.begin());
        int high = 0;
        for (int k = 0; k < edges.side_count(e); ++k) high += is_high(edges.side(e, k)) ? 1 : 0;
        if (high == 2) found.push_back({a, b});
    }
    return found;
}

}  // namespace

FirstMesh first_mesh(CutPieces cut, const VectorX& spacings) {
    take_specks(cut, spacings);
    const auto count = static_cast<int>(cut.points.cols());
    FirstMesh first;
    first.triangles = those(cut.triangles, cut.inside, first.pieces);
    std::vector<char> stays(static_cast<std::size_t>(count), 0);
    for (const Indices& loop : boundary_loops(first.triangles, count))
        for (const int v : loop) stays[v] = 1;
    Indices uses(stays.size(), 0);  // where seams branch, they stay
    for (const auto& [a, b] : cut.seams)
        for (const int v : {a, b})
            if (++uses[v] > 2) stays[v] = 1;
    std::vector<Pair> all;
    for (const auto& ends : make_edges(first.triangles, count).ends)
        if ((cut.points.col(ends[0]) - cut.points.col(ends[1])).norm() < tiny * spacings[ends[0]]) all.push_back(ends);
    all.insert(all.end(), cut.seams.begin(), cut.seams.end());
    Indices into;
    do {
        into = merged(all, cut.points, stays, brief * spacings);
    } while (hold_crushed(first.triangles, cut.points, into, stays));
    const Triangles moved = first.triangles.unaryExpr([&](int v) { return into[v]; });
    Indices rows;
    for (int t = 0; t < static_cast<int>(moved.cols()); ++t)
        if (moved(0, t) != moved(1, t) && moved(1, t) != moved(2, t) && moved(2, t) != moved(0, t)) rows.push_back(t);
    const Triangles closed = moved(Eigen::all, rows);
    if (is_like(closed, first.triangles, count)) {
        std::set<Pair> ends;
        for (const auto& [a, b] : cut.seams)
            if (into[a] != into[b]) ends.insert({std::min(into[a], into[b]), std::max(into[a], into[b])});
        cut.seams.assign(ends.begin(), ends.end());
        for (int& row : rows) row = first.pieces[row];
        first.pieces = std::move(rows);
        first.triangles = closed;
    }
    first.lines = between(cut.seams, first.triangles, cut.points, spacings);
    first.inside = std::move(cut.inside);
    return first;
}

}  // namespace fairing
