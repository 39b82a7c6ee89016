#include "boundary/boundary_fit.h"

#include "base/progress.h"
#include "geometry/triangle.h"
#include "mesh/twins.h"

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

// Indices into `vertices` of those whose boundary edges are all in `chosen`.
Indices places_between(const VertexPairs& chosen, const VertexPairs& boundary, const Indices& vertices,
                       Eigen::Index count) {
    const Indices all = counts_at(boundary, count);
    const Indices own = counts_at(chosen, count);
    Indices places;
    for (int k = 0; k < static_cast<int>(vertices.size()); ++k) {
        const int v = vertices[k];
        if (own[v] > 0 && own[v] == all[v]) places.push_back(k);
    }
    return places;
}

void take(SidedFits& side, const Indices& vertices, const Indices& places, SurroundingFit& fit) {
    for (int k : places) {
        checkpoint();
        fit.fits[k] = side.at_vertex(vertices[k]);
        fit.averaged.col(k) = side.averaged(vertices[k]);
    }
}

// Whether the patch's own slopes are to be relied on: those of a dome are, those of noise or of a pocket's wall not.
bool is_clean(const SurroundingFit& own, const SurroundingFit& film, const Indices& places) {
    constexpr double most_uncertain = 0.01;  // radians
    constexpr double most_apart = 5.0;       // degrees off the adjacent triangles: beyond, it has too few rows
    const auto clean = std::count_if(places.begin(), places.end(), [&](int k) {
        const auto& fit = own.fits[k];
        return fit && fit->error < most_uncertain && degrees_between(fit->normal, own.averaged.col(k)) < most_apart &&
               degrees_between(fit->normal, film.averaged.col(k)) < hard_bend;
    });
    return 2 * clean > static_cast<std::ptrdiff_t>(places.size());
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
    const VertexPairs boundary = boundary_edges(mesh);
    SurroundingFit fit = blank_fit(points, beyond, vertices, size);
    fit.fits.resize(vertices.size());
    Indices all(vertices.size());
    std::iota(all.begin(), all.end(), 0);
    SidedFits outside(points, beyond, vertices, creases);
    take(outside, vertices, all, fit);
    const bool is_automatic = rule == SideRule::automatic;
    const Walls walls = is_automatic ? walls_of(mesh, vertices, outside.hard()) : Walls{boundary, points};
    BoundaryNormals result;
    result.from_inside.assign(vertices.size(), 0);
    if (!walls.edges.empty()) {
        const Indices places = places_between(walls.edges, boundary, vertices, points.cols());
        for (int k : places) result.from_inside[k] = 1;
        SidedFits rest(points, beyond, vertices, creases, walls.edges);
        take(rest, vertices, all, fit);
        const VertexPairs others = without(boundary, walls.edges);
        SurroundingFit film = fit;
        SidedFits free(walls.film, within, vertices, creases, others);
        take(free, vertices, places, film);
        SidedFits own(points, within, vertices, creases, others);
        take(own, vertices, places, fit);
        if (is_automatic && !is_clean(fit, film, places)) fit = std::move(film);
    }
    result.normals = normals_of(fit);
    return result;
}

}  // namespace fairing
