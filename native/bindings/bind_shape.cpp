#include "api/shape.h"
#include "bindings/bind.h"
#include "bindings/topics.h"
#include "shape/kinks.h"
#include "shape/limits.h"
#include "shape/roughness.h"
#include "shape/rounded_edges.h"
#include "shape/visible_join.h"

namespace fairing::bindings {

namespace {

// Of the parts of a mesh.
void bind_parts(py::module_& module) {
    bind(module, "is_rougher", {"vertices", "inside", "outside"},
         [](const Points& vertices, const Triangles& inside, const Triangles& outside) {
             return is_rougher(vertices, inside, outside);
         });
    bind(module, "is_spoilt", {"vertices", "inside", "outside"},
         [](const Points& vertices, const Triangles& inside, const Triangles& outside) {
             return is_spoilt(vertices, inside, outside);
         });
    bind(module, "has_lost_grain", {"before", "after", "inside", "outside"},
         [](const Points& before, const Points& after, const Triangles& inside, const Triangles& outside) {
             return has_lost_grain({before, after, inside, outside});
         });
    bind(module, "seam_kinks", {"vertices", "triangles", "held", "limit"},
         [](const Points& vertices, const Triangles& triangles, const Indices& held, double limit) {
             return seam_kinks(vertices, triangles, held, limit);
         });
    bind(
        module, "needles", {"vertices", "triangles"},
        [](const Points& vertices, const Triangles& triangles) { return needles(vertices, triangles); },
        [](const Needles& found) { return py::make_tuple(found.all, found.seen); });
    bind(module, "rounded_edges", {"before", "after", "triangles", "moved", "marked"},
         [](const Points& before, const Points& after, const Triangles& triangles, const Indices& moved,
            const std::optional<VertexPairs>& marked) {
             const MovedMesh change{before, after, triangles, moved};
             return marked ? rounded_marks(change, *marked) : rounded_edges(change);
         });
    bind(
        module, "visible_join", {"vertices", "inside", "outside", "outline", "before"},
        [](const Points& vertices, const Triangles& inside, const Triangles& outside, const Indices& outline,
           const MaybePoints& before) { return visible_join({vertices, inside, outside, before}, outline); },
        [](const VisibleJoin& join) { return py::make_tuple(join.degrees, join.limit, join.seen); });
}

}  // namespace

void bind_shape(py::module_& module) {
    using namespace py::literals;
    // Those of shape/limits that Python asks by.
    module.attr("LIMITS") =
        py::dict("waist"_a = waist, "balloon"_a = balloon, "sunken"_a = sunken, "visible_kink"_a = visible_kink,
                 "steep_kink"_a = steep_kink, "turned_back"_a = turned_back, "off_slope"_a = off_slope);
    bind(
        module, "girth", {"vertices", "triangles", "fixed"},
        [](const Points& vertices, const Triangles& triangles, const MaybeIndices& fixed) {
            return girth({vertices, triangles, fixed, {}});
        },
        [](const std::optional<GirthRange>& found) -> py::object {
            if (!found) return py::none();
            return py::make_tuple(found->least, found->largest, found->thinnest, found->thickest);
        });
    bind(
        module, "knobs", {"vertices", "triangles", "fixed", "before"},
        [](const Points& vertices, const Triangles& triangles, const MaybeIndices& fixed, double before) {
            return knobs({vertices, triangles, fixed, {}}, before);
        },
        [](const Knobs& found) { return py::make_tuple(found.extent, found.tops); });
    bind(
        module, "sunken", {"vertices", "triangles", "normals", "fixed"},
        [](const Points& vertices, const Triangles& triangles, const Points& normals, const MaybeIndices& fixed) {
            return sunken_below({vertices, triangles, fixed, {}}, normals);
        },
        [](const Sunken& found) { return py::make_tuple(found.depth, found.deepest); });
    bind(
        module, "flank", {"vertices", "triangles", "around", "fixed"},
        [](const Points& vertices, const Triangles& triangles, const Triangles& around, const MaybeIndices& fixed) {
            return flank({vertices, triangles, fixed, {}}, around);
        },
        [](const std::optional<Flank>& found) -> py::object {
            if (!found) return py::none();
            return py::make_tuple(found->boundary, found->is_bump, found->width);
        });
    bind_parts(module);
}

}  // namespace fairing::bindings
