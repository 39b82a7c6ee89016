#include "api/prepared_fillet.h"

#include <map>
#include <set>

#include "fillet/limits.h"
#include "fillet/seam_sides.h"
#include "geometry/flips.h"

namespace fairing {

namespace {

constexpr double apart = 1e-7;  // of the distance to the next vertex: far more than roundoff, far less than is seen

std::vector<VertexPair> joined(const std::vector<VertexPair>& a, const std::vector<VertexPair>& b) {
    std::vector<VertexPair> both = a;
    both.insert(both.end(), b.begin(), b.end());
    return both;
}

// A seam that is a cap's longest side becomes the two sides over it, likewise a wall.
void part_edges(const TurnedCap& turned, std::vector<VertexPair>& edges) {
    const int a = turned.ends[0];
    const int b = turned.ends[1];
    const auto at = std::find_if(edges.begin(), edges.end(),
                                 [&](const VertexPair& e) { return e == VertexPair{a, b} || e == VertexPair{b, a}; });
    if (at == edges.end()) return;
    const VertexPair first{(*at)[0], turned.over};
    const VertexPair second{turned.over, (*at)[1]};
    const auto is_there = [&](const VertexPair& e) {
        return std::find(edges.begin(), edges.end(), e) != edges.end() ||
               std::find(edges.begin(), edges.end(), VertexPair{e[1], e[0]}) != edges.end();
    };
    *at = is_there(first) ? second : first;
    if (!is_there(first)) edges.push_back(first);
    if (!is_there(second)) edges.push_back(second);
}

// An edge without length, as booleans leave them, has no direction in which a distance could be counted: for the cut
// its ends go apart, along the seam, so that planes stay plane; those between them by halves.
void part_doubled(FilletInput& input) {
    std::set<int> doubled;
    const auto is_one = [&](int a, int b) { return input.vertices.col(a) == input.vertices.col(b); };
    for (const auto& [a, b] : input.seams) {
        if (is_one(a, b)) doubled.insert({a, b});
    }
    std::map<int, Vector3> offsets;
    for (bool changed = !doubled.empty(); changed;) {
        changed = false;
        for (const auto& [a, b] : input.seams) {
            for (const auto& [from, to] : {VertexPair{a, b}, VertexPair{b, a}}) {
                if (!doubled.contains(from) || offsets.contains(from)) continue;
                const bool is_end = !is_one(from, to);
                if (!is_end && !offsets.contains(to)) continue;
                offsets[from] = is_end ? Vector3(apart * (input.vertices.col(to) - input.vertices.col(from)))
                                       : Vector3(0.5 * offsets.at(to));
                changed = true;
            }
        }
    }
    for (const auto& [v, offset] : offsets) input.vertices.col(v) += offset;
}

double width_of(const FilletInput& input, bool largest) {
    double result = largest ? 0.0 : input.widths.largest();
    for (const auto& [a, b] : input.seams) {
        for (const int v : {a, b}) {
            const auto [less, more] = std::minmax(input.widths.left[v], input.widths.right[v]);
            result = largest ? std::max(result, more) : std::min(result, less);
        }
    }
    return result;
}

// So that seams have no triangles without area beside them. `plane`: of each triangle, one in whose plane it is.
void turn_caps_at_seams(FilletInput& input, Indices& plane) {
    std::vector<char> on_seam(static_cast<std::size_t>(input.vertices.cols()), 0);
    for (const auto& [a, b] : input.seams) on_seam[a] = on_seam[b] = 1;
    std::vector<char> at_seam(plane.size(), 0);
    for (std::size_t t = 0; t < plane.size(); ++t) {
        const auto corners = input.triangles.col(static_cast<Eigen::Index>(t));
        at_seam[t] = on_seam[corners[0]] + on_seam[corners[1]] + on_seam[corners[2]] > 1 ? 1 : 0;
    }
    const std::vector<char> all(plane.size(), 1);
    for (const TurnedCap& turned :
         turn_caps(input.vertices, at_seam, all, snap * finest_spacing(input), input.triangles)) {
        plane[turned.cap] = plane[turned.beside];
        for (auto* widths : {&input.widths.left, &input.widths.right}) {
            double& width = (*widths)[turned.over];
            if (on_seam[turned.over] == 0) width = 0.5 * ((*widths)[turned.ends[0]] + (*widths)[turned.ends[1]]);
        }
        on_seam[turned.over] = 1;
        part_edges(turned, input.seams);
        part_edges(turned, input.walls);
    }
}

FilletInput with_parted(FilletInput input) {
    part_doubled(input);
    return input;
}

Indices turned(FilletInput& input) {
    Indices plane(static_cast<std::size_t>(input.triangles.cols()));
    std::iota(plane.begin(), plane.end(), 0);
    turn_caps_at_seams(input, plane);
    return plane;
}

SeamMesh& directed_mesh(SeamMesh& mesh, const std::vector<VertexPair>& seams) {
    mesh.redirect(directed(mesh, seams));
    return mesh;
}

}  // namespace

double finest_spacing(const FilletInput& input) {
    return input.spacing * width_of(input, false) / width_of(input, true);
}

PreparedFillet::PreparedFillet(const FilletInput& given)
    : input(with_parted(given)),
      plane(turned(input)),
      mesh(input.vertices, input.triangles, input.seams, input.walls),
      largest_width(width_of(input, true)),
      distance(directed_mesh(mesh, input.seams), input.widths, largest_width + input.spacing, input.through),
      sides(mesh, joined(input.seams, input.walls)) {
    Indices near;
    for (int t = 0; t < mesh.triangles.cols(); ++t)
        if (distance.reaches(t)) near.push_back(t);
    sides.find_at(near);
}

}  // namespace fairing
