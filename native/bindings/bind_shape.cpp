#include "api/shape.h"
#include "bindings/convert.h"
#include "bindings/topics.h"
#include "shape/grain.h"
#include "shape/kinks.h"
#include "shape/limits.h"
#include "shape/needles.h"
#include "shape/roughness.h"
#include "shape/rounded_edges.h"
#include "shape/visible_join.h"

namespace fairing::bindings {

namespace {

MeshInput input_of(const DoubleArray& vertices, const IntArray& triangles, const std::optional<IntArray>& fixed) {
    return {view_points(vertices), to_triangles(triangles), to_optional(fixed, to_indices), {}};
}

py::object girth_arrays(const DoubleArray& vertices, const IntArray& triangles, const std::optional<IntArray>& fixed) {
    const auto found = girth(input_of(vertices, triangles, fixed));
    if (!found) return py::none();
    return py::make_tuple(found->least, found->largest, from_indices(found->thinnest), from_indices(found->thickest));
}

py::tuple knob_arrays(const DoubleArray& vertices, const IntArray& triangles, const std::optional<IntArray>& fixed,
                      double before) {
    const Knobs found = knobs(input_of(vertices, triangles, fixed), before);
    return py::make_tuple(found.extent, from_indices(found.tops));
}

py::tuple sunken_arrays(const DoubleArray& vertices, const IntArray& triangles, const DoubleArray& normals,
                        const std::optional<IntArray>& fixed) {
    const Sunken found = sunken_below(input_of(vertices, triangles, fixed), to_points(normals));
    return py::make_tuple(found.depth, from_indices(found.deepest));
}

bool lost_grain_in(const DoubleArray& before, const DoubleArray& after, const IntArray& inside,
                   const IntArray& outside) {
    return has_lost_grain({to_points(before), to_points(after), to_triangles(inside), to_triangles(outside)});
}

bool rougher(const DoubleArray& vertices, const IntArray& inside, const IntArray& outside) {
    return is_rougher(to_points(vertices), to_triangles(inside), to_triangles(outside));
}

py::object flank_arrays(const DoubleArray& vertices, const IntArray& triangles, const IntArray& around,
                        const std::optional<IntArray>& fixed) {
    const auto found = flank(input_of(vertices, triangles, fixed), to_triangles(around));
    if (!found) return py::none();
    return py::make_tuple(from_indices(found->boundary), found->is_bump, found->width);
}

py::tuple needle_arrays(const DoubleArray& vertices, const IntArray& triangles) {
    const Needles found = needles(to_points(vertices), to_triangles(triangles));
    return py::make_tuple(from_indices(found.all), from_indices(found.seen));
}

py::array seam_kink_array(const DoubleArray& vertices, const IntArray& triangles, const IntArray& held, double limit) {
    return from_indices(seam_kinks(to_points(vertices), to_triangles(triangles), to_indices(held), limit));
}

bool spoilt(const DoubleArray& vertices, const IntArray& inside, const IntArray& outside) {
    return is_spoilt(to_points(vertices), to_triangles(inside), to_triangles(outside));
}

py::array rounded_array(const DoubleArray& before, const DoubleArray& after, const IntArray& triangles,
                        const IntArray& moved, const std::optional<IntArray>& marked) {
    const MovedMesh change{to_points(before), to_points(after), to_triangles(triangles), to_indices(moved)};
    return from_indices(marked ? rounded_marks(change, to_pairs(*marked)) : rounded_edges(change));
}

py::tuple visible_join_arrays(const DoubleArray& vertices, const IntArray& inside, const IntArray& outside,
                              const IntArray& outline, const std::optional<DoubleArray>& before) {
    const JoinedMesh mesh{to_points(vertices), to_triangles(inside), to_triangles(outside),
                          to_optional(before, to_points)};
    const VisibleJoin join = visible_join(mesh, to_indices(outline));
    return py::make_tuple(from_vector(join.degrees), join.limit, from_indices(join.seen));
}

// Those of shape/limits that Python asks by.
py::dict limits() {
    py::dict named;
    named["waist"] = waist;
    named["balloon"] = balloon;
    named["sunken"] = sunken;
    named["visible_kink"] = visible_kink;
    named["steep_kink"] = steep_kink;
    named["turned_back"] = turned_back;
    named["off_slope"] = off_slope;
    return named;
}

}  // namespace

void bind_shape(py::module_& module) {
    module.attr("LIMITS") = limits();
    module.def("girth", &girth_arrays, py::arg("vertices"), py::arg("triangles"), py::arg("fixed"));
    module.def("knobs", &knob_arrays, py::arg("vertices"), py::arg("triangles"), py::arg("fixed"), py::arg("before"));
    module.def("sunken", &sunken_arrays, py::arg("vertices"), py::arg("triangles"), py::arg("normals"),
               py::arg("fixed"));
    module.def("is_rougher", &rougher, py::arg("vertices"), py::arg("inside"), py::arg("outside"));
    module.def("has_lost_grain", &lost_grain_in, py::arg("before"), py::arg("after"), py::arg("inside"),
               py::arg("outside"));
    module.def("flank", &flank_arrays, py::arg("vertices"), py::arg("triangles"), py::arg("around"), py::arg("fixed"));
    module.def("needles", &needle_arrays, py::arg("vertices"), py::arg("triangles"));
    module.def("seam_kinks", &seam_kink_array, py::arg("vertices"), py::arg("triangles"), py::arg("held"),
               py::arg("limit"));
    module.def("is_spoilt", &spoilt, py::arg("vertices"), py::arg("inside"), py::arg("outside"));
    module.def("rounded_edges", &rounded_array, py::arg("before"), py::arg("after"), py::arg("triangles"),
               py::arg("moved"), py::arg("marked"));
    module.def("visible_join", &visible_join_arrays, py::arg("vertices"), py::arg("inside"), py::arg("outside"),
               py::arg("outline"), py::arg("before"));
}

}  // namespace fairing::bindings
