#include "variation/stencil.h"

namespace fairing {

namespace {

// The corner of a triangle that does not lie on the edge.
int apex(const Patch& patch, int triangle, int edge) {
    for (int k = 0; k < 3; ++k) {
        if (patch.triangle_edges(k, triangle) == edge) return patch.triangles(k, triangle);
    }
    return none;
}

int across(const Patch& patch, int triangle, int edge) {
    const auto [first, second] = patch.edge_triangles[edge];
    const int other = first == triangle ? second : first;
    return other == none ? none : apex(patch, other, edge);
}

}  // namespace

std::vector<Stencil> stencils(const Patch& patch) {
    std::vector<Stencil> result;
    result.reserve(patch.triangle_count());
    for (int t = 0; t < patch.triangle_count(); ++t) {
        Stencil stencil{};
        for (int k = 0; k < 3; ++k) {
            stencil[k] = patch.triangles(k, t);
            stencil[3 + k] = across(patch, t, patch.triangle_edges(k, t));
        }
        result.push_back(stencil);
    }
    return result;
}

}  // namespace fairing
