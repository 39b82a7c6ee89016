#include "api/shape.h"

#include "api/component.h"
#include "api/diagnose.h"
#include "mesh/pieces.h"

namespace fairing {

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

}  // namespace fairing
