#include "api/shape.h"

#include "api/component.h"
#include "api/diagnose.h"
#include "geometry/surface_fit.h"
#include "mesh/pieces.h"

namespace fairing {

namespace {

bool is_surrounded(const Patch& patch, const std::vector<char>& is_around) {
    const auto fixed = fixed_vertices(patch);
    return std::all_of(fixed.begin(), fixed.end(), [&](int v) { return is_around[v]; });
}

}  // namespace

GirthRange by_input(const Patch& patch, GirthRange range) {
    for (Indices* places : {&range.thinnest, &range.thickest}) {
        for (int& v : *places) v = patch.to_input[v];
        std::sort(places->begin(), places->end());
    }
    return range;
}

std::optional<GirthRange> girth(const MeshInput& input) {
    std::optional<GirthRange> worst;
    const CheckedMesh mesh = check_mesh(input);
    for_each_piece(mesh.cut, mesh.roles, input.vertices, [&](const Patch& patch, const Points& points) {
        const auto own = girth_range(patch, points);
        if (own) worst = worst_of(worst.value_or(GirthRange{}), by_input(patch, *own));
    });
    return worst;
}

Knobs knobs(const MeshInput& input, double before) {
    Knobs all;
    const CheckedMesh mesh = check_mesh(input);
    for_each_piece(mesh.cut, mesh.roles, input.vertices, [&](const Patch& patch, const Points& points) {
        const Knobs found = knobs_of(patch, points, before);
        all.extent = std::max(all.extent, found.extent);
        for (const int v : found.tops) all.tops.push_back(patch.to_input[v]);
    });
    return all;
}

std::optional<Flank> flank(const MeshInput& input, const Triangles& around) {
    std::vector<char> is_around(static_cast<std::size_t>(input.vertices.cols()), 0);
    for (const int v : around.reshaped()) is_around[v] = 1;
    std::optional<Flank> first;
    const CheckedMesh mesh = check_mesh(input);
    for_each_piece(mesh.cut, mesh.roles, input.vertices, [&](const Patch& patch, const Points& points) {
        if (first || !is_surrounded(patch, is_around)) return;
        first = flank_of(patch, points, {input.vertices, around});
        if (!first) return;
        for (int& v : first->boundary) v = patch.to_input[v];
    });
    return first;
}

Sunken sunken_below(const MeshInput& input, const Points& normals) {
    Sunken deepest;
    const CheckedMesh mesh = check_mesh(input);
    for_each_piece(mesh.cut, mesh.roles, input.vertices, [&](const Patch& patch, const Points& points) {
        Sunken found = sunken_of(patch, points,
                                 gather(normals, patch.to_input).rightCols(patch.vertex_count() - patch.free_count));
        if (found.depth <= deepest.depth) return;
        for (int& v : found.deepest) v = patch.to_input[v];
        deepest = std::move(found);
    });
    return deepest;
}

}  // namespace fairing
