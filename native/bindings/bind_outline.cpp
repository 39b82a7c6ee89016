#include "bindings/convert.h"
#include "bindings/topics.h"
#include "outline/bad_outline.h"
#include "outline/feather.h"
#include "outline/mended_outline.h"
#include "outline/visible_join.h"

namespace fairing::bindings {

namespace {

py::array from_flags(const std::vector<char>& flags) {
    py::array_t<bool> result(static_cast<py::ssize_t>(flags.size()));
    for (std::size_t k = 0; k < flags.size(); ++k) result.mutable_at(static_cast<py::ssize_t>(k)) = flags[k] != 0;
    result.attr("flags").attr("writeable") = false;
    return std::move(result);
}

py::dict to_dict(const SurroundingNormals& result) {
    py::dict dict;
    dict["normals"] = from_points(result.normals);
    dict["fitted"] = from_flags(result.fitted);
    dict["errors"] = from_vector(result.errors);
    dict["curvatures"] = from_vector(result.curvatures);
    dict["curvature_errors"] = from_vector(result.curvature_errors);
    return dict;
}

py::dict surrounding_normal_arrays(const DoubleArray& vertices, const IntArray& triangles, const IntArray& where) {
    return to_dict(surrounding_normals(to_points(vertices), to_triangles(triangles), to_indices(where)));
}

py::array bad_outline_array(const DoubleArray& vertices, const IntArray& triangles, const IntArray& outline) {
    const Indices vertices_of_outline = to_indices(outline);
    Indices bad = bad_vertices(fit_surroundings(to_points(vertices), to_triangles(triangles), vertices_of_outline));
    for (int& place : bad) place = vertices_of_outline[at(place)];
    return from_indices(bad);
}

py::array feather_weight_array(const DoubleArray& vertices, const IntArray& inside, const IntArray& outside,
                               double width) {
    return from_vector(feather_weights(to_points(vertices), to_triangles(inside), to_triangles(outside), width));
}

py::dict mended_outline_arrays(const DoubleArray& vertices, const IntArray& triangles, const IntArray& outline) {
    const MendedOutline result = mend_outline(to_points(vertices), to_triangles(triangles), to_indices(outline));
    py::dict dict = to_dict(result.normals);
    dict["vertices"] = from_points(result.vertices);
    dict["moved"] = from_indices(result.moved);
    dict["held"] = from_indices(result.held);
    dict["noise"] = result.noise;
    return dict;
}

py::array visible_join_array(const DoubleArray& vertices, const IntArray& inside, const IntArray& outside,
                             const IntArray& outline, const std::optional<DoubleArray>& before) {
    const JoinedMesh mesh{to_points(vertices), to_triangles(inside), to_triangles(outside),
                          to_optional(before, to_points)};
    return from_vector(visible_join(mesh, to_indices(outline)));
}

}  // namespace

void bind_outline(py::module_& module) {
    module.def("surrounding_normals", &surrounding_normal_arrays, py::arg("vertices"), py::arg("triangles"),
               py::arg("at"));
    module.def("bad_outline", &bad_outline_array, py::arg("vertices"), py::arg("outside"), py::arg("outline"));
    module.def("mend_outline", &mended_outline_arrays, py::arg("vertices"), py::arg("outside"), py::arg("outline"));
    module.def("feather_weights", &feather_weight_array, py::arg("vertices"), py::arg("inside"), py::arg("outside"),
               py::arg("width"));
    module.def("visible_join", &visible_join_array, py::arg("vertices"), py::arg("inside"), py::arg("outside"),
               py::arg("outline"), py::arg("before"));
}

}  // namespace fairing::bindings
