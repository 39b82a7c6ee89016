#include "api/loops_meant.h"

#include <cstdio>
#include <set>

#include "base/errors.h"
#include "fill/loop_check.h"
#include "geometry/segments.h"
#include "mesh/hole_loops.h"

namespace fairing {

namespace {

// Whether a triangle has the directed side.
bool has_side(const HoledMesh& mesh, int tail, int head) {
    const Triangles& triangles = mesh.mesh().triangles;
    const auto around = mesh.stars().at(tail);
    return std::any_of(around.begin(), around.end(), [&](int t) {
        for (int k = 0; k < 3; ++k) {
            if (triangles(k, t) == tail && triangles((k + 1) % 3, t) == head) return true;
        }
        return false;
    });
}

// The ends of some edges of a loop.
Indices ends_where(const Indices& loop, const std::vector<char>& chosen) {
    std::set<int> ends;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        if (chosen[k]) ends.insert({loop[k], loop[(k + 1) % loop.size()]});
    }
    return {ends.begin(), ends.end()};
}

// Turns a loop so that the mesh lies on its right. Throws NOT_A_LOOP where it is no border.
void orient(const HoledMesh& mesh, BoundaryLoop& loop) {
    const Indices& at = loop.vertices;
    if (at.size() < 3) return;  // refused later
    std::vector<char> along;
    std::vector<char> against;
    std::vector<char> both;
    for (std::size_t k = 0; k < at.size(); ++k) {
        along.push_back(has_side(mesh, at[k], at[(k + 1) % at.size()]) ? 1 : 0);
        against.push_back(has_side(mesh, at[(k + 1) % at.size()], at[k]) ? 1 : 0);
        both.push_back(along.back() && against.back() ? 1 : 0);
    }
    const auto count = [](const std::vector<char>& flags) { return std::count(flags.begin(), flags.end(), 1); };
    const auto refuse = [&](const std::string& text, const std::vector<char>& where) {
        Indices ends = ends_where(at, where);
        const std::string message = text + listed(ends);
        throw MeshError(at_vertices(Code::not_a_loop, message, std::move(ends)));
    };
    const auto others = [](std::vector<char> flags) {
        for (char& flag : flags) flag = flag ? 0 : 1;
        return flags;
    };
    const auto size = static_cast<std::ptrdiff_t>(at.size());
    if (count(both) > 0) refuse("edges of a loop are no border, faces lie on both sides: ", both);
    if (count(along) > 0 && count(along) < size)
        refuse("a loop leaves the border of the mesh, or the triangles' windings differ along it: ", others(along));
    if (count(against) > 0 && count(against) < size)
        refuse("a loop leaves the border of the mesh at ", others(against));
    loop.is_bare = count(along) + count(against) == 0;
    if (count(along) == size) loop.turn();
}

double length_of(const View<Points>& points, const Indices& loop) {
    double length = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k)
        length += (points.col(loop[(k + 1) % loop.size()]) - points.col(loop[k])).norm();
    return length;
}

std::string short_number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.4g", value);
    return text.data();
}

// Why no loop is short enough.
Diagnostic nothing(const View<Points>& points, const std::vector<Indices>& loops, const NamedLoops& named) {
    std::string text = "the mesh has no border: there is nothing to fill";
    if (!loops.empty()) {
        double shortest = length_of(points, loops[0]);
        std::size_t fewest = loops[0].size();
        for (const Indices& loop : loops) {
            shortest = std::min(shortest, length_of(points, loop));
            fewest = std::min(fewest, loop.size());
        }
        const bool by_edges = named.longest > 0 && fewest > static_cast<std::size_t>(named.longest);
        text = by_edges ? "no border loop has " + std::to_string(named.longest) + " edges or fewer; the shortest has " +
                              std::to_string(fewest)
                        : "no border loop is " + short_number(named.longest_length) +
                              " long or shorter; the shortest is " + short_number(shortest) + " long";
    }
    return {Code::no_boundary, text, {}, ElementKind::vertex, {{"loops", static_cast<double>(loops.size())}}};
}

Diagnostic torn(const Indices& chain) {
    const std::set<int> both{chain.front(), chain.back()};
    Indices ends(both.begin(), both.end());
    const std::string text = "three triangles share an edge, or two face opposite ways, at " + listed(ends) +
                             ": remove the third, or make their winding the same";
    return at_vertices(Code::not_a_loop, text, std::move(ends), {{"torn", 1.0}});
}

// A loop along the mesh in parts where it touches itself, as around holes: by itself, whatever is named besides.
std::vector<BoundaryLoop> parted(const HoledMesh& mesh, BoundaryLoop loop) {
    const std::set<int> once(loop.vertices.begin(), loop.vertices.end());
    if (loop.is_bare || once.size() == loop.vertices.size()) return {std::move(loop)};
    std::vector<BoundaryLoop> parts;
    for (Indices& vertices : parted_loop(loop.vertices, mesh.mesh().vertices, mesh.mesh().triangles))
        parts.push_back({std::move(vertices), {}});
    return parts;
}

}  // namespace

Holes found_loops(const HoledMesh& mesh, const NamedLoops& named) {
    const Triangles& triangles = mesh.mesh().triangles;
    const View<Points>& points = mesh.mesh().vertices;
    const HoleLoops all = hole_loops(points, triangles, border_sides(triangles, static_cast<int>(points.cols())));
    Holes result;
    for (const Indices& chain : all.torn) result.left.push_back({chain, torn(chain)});
    for (Indices loop : all.loops) {
        const bool has_many = named.longest > 0 && loop.size() > static_cast<std::size_t>(named.longest);
        const bool is_long = named.longest_length > 0.0 && !(length_of(points, loop) <= named.longest_length);
        if (has_many || is_long) continue;
        result.holes.push_back({{BoundaryLoop{std::move(loop), {}}}});
    }
    if (!result.holes.empty()) return result;
    if (all.loops.empty() && !result.left.empty()) throw MeshError(result.left[0].reason);
    throw MeshError(nothing(points, all.loops, named));
}

Holes named_loops(const HoledMesh& mesh, const NamedLoops& named, bool bridge, bool are_parted) {
    refuse_shared_edges(named.loops);
    Holes result;
    std::vector<BoundaryLoop> loops;
    for (std::size_t l = 0; l < named.loops.size(); ++l) {
        BoundaryLoop loop{named.loops[l], {}};
        if (!named.normals.empty()) loop.shape.normals = named.normals[l];
        if (!named.curvatures.empty()) loop.curvatures = named.curvatures[l];
        try {
            orient(mesh, loop);
        } catch (const MeshError& error) {
            if (bridge) throw;
            result.left.push_back({named.loops[l], error.diagnostic()});
            continue;
        }
        if (are_parted && named.are_parted()) {
            for (BoundaryLoop& part : parted(mesh, std::move(loop))) loops.push_back(std::move(part));
        } else {
            loops.push_back(std::move(loop));
        }
    }
    if (bridge) {  // in whatever order they are named
        std::ranges::sort(loops, {}, [](const BoundaryLoop& loop) {
            return loop.vertices.empty() ? none : std::ranges::min(loop.vertices);
        });
        result.holes.push_back({std::move(loops)});
        return result;
    }
    for (BoundaryLoop& loop : loops) result.holes.push_back({{std::move(loop)}});
    return result;
}

}  // namespace fairing
