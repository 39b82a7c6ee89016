#include "boundary/boundary_fit.h"

#include <algorithm>

#include "base/progress.h"
#include "boundary/sided_fits.h"
#include "mesh/collapsed.h"

namespace fairing {

namespace {

// How many of these edges end at each vertex.
Indices counts_at(const VertexPairs& edges, Eigen::Index count) {
    Indices result(static_cast<std::size_t>(count), 0);
    for (const auto& ends : edges) {
        for (int v : ends) ++result[v];
    }
    return result;
}

VertexPairs without(const VertexPairs& all, const VertexPairs& some) {
    VertexPairs rest;
    std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(rest));
    return rest;
}

}  // namespace

BoundaryNormals boundary_normals(const Surroundings& given, const Indices& vertices, const VertexPairs& creases,
                                 SideRule rule) {
    const Triangles whole = without_collapsed(given.patch);
    const Triangles within = triangles_near(whole, vertices, given.points.cols());
    const Triangles beyond = triangles_near(without_collapsed(given.outside), vertices, given.points.cols());
    Triangles both(3, whole.cols() + given.outside.cols());
    both << whole, given.outside;
    const auto [points, size] = to_unit_size(given.points, both);
    const PatchInMesh mesh{points, within, beyond, whole};
    const VertexPairs outline = outline_edges(mesh);
    std::vector<char> held(static_cast<std::size_t>(points.cols()), 0);
    for (int v : vertices) held[v] = 1;
    const VertexPairs inward = rule == SideRule::inside ? outline : inward_edges(mesh, creases, held);
    SidedFits inside(points, within, vertices, creases, without(outline, inward));
    SidedFits outside(points, beyond, vertices, creases, inward);
    const Indices all = counts_at(outline, points.cols());
    const Indices own = counts_at(inward, points.cols());
    BoundaryNormals result;
    SurroundingFit fit = blank_fit(points, beyond, vertices, size);
    for (std::size_t k = 0; k < vertices.size(); ++k) {
        checkpoint();
        const int v = vertices[k];
        result.from_inside.push_back(own[v] > 0 && own[v] == all[v] ? 1 : 0);
        SidedFits& side = result.from_inside.back() ? inside : outside;
        fit.fits.push_back(side.at_vertex(v));
        fit.averaged.col(static_cast<Eigen::Index>(k)) = side.averaged(v);
    }
    result.normals = normals_of(fit);
    return result;
}

}  // namespace fairing
