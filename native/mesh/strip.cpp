#include "mesh/strip.h"

namespace fairing {

namespace {

// Marks of the vertices that so many edges reach.
std::vector<char> reached(const Patch& patch, const Indices& seeds, int edges) {
    std::vector<char> marks(patch.vertex_count(), 0);
    for (const int v : seeds) marks[v] = 1;
    Indices front = seeds;
    for (int k = 0; k < edges; ++k) {
        Indices next;
        for (const int v : front) {
            for (const int u : patch.ring(v).vertices) {
                if (marks[u]) continue;
                marks[u] = 1;
                next.push_back(u);
            }
        }
        front = std::move(next);
    }
    return marks;
}

}  // namespace

Strip strip_around(const Patch& patch, const Indices& seeds, int edges) {
    const std::vector<char> near = reached(patch, seeds, edges);
    Indices kept;
    Strip strip;
    strip.local.assign(near.size(), none);
    for (int t = 0; t < patch.triangle_count(); ++t) {
        const auto corners = patch.triangles.col(t);
        if (!near[corners[0]] && !near[corners[1]] && !near[corners[2]]) continue;
        kept.push_back(t);
        for (const int v : corners) strip.local[v] = v;
    }
    for (int& place : strip.local) {
        if (place == none) continue;
        strip.vertices.push_back(place);
        place = static_cast<int>(strip.vertices.size()) - 1;
    }
    strip.triangles = patch.triangles(Eigen::all, kept);
    for (int& v : strip.triangles.reshaped()) v = strip.local[v];
    return strip;
}

}  // namespace fairing
