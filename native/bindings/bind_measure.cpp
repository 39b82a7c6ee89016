#include "api/measure.h"
#include "bindings/convert.h"
#include "bindings/topics.h"
#include "bindings/words.h"
#include "geometry/nearest_point.h"
#include "geometry/self_intersection.h"
#include "mesh/loops.h"
#include "mesh/turned.h"

namespace fairing::bindings {

namespace {

py::array mean_curvature_array(const DoubleArray& vertices, const IntArray& triangles,
                               const std::optional<IntArray>& fixed, const std::optional<DoubleArray>& fixed_normals,
                               const std::string& normals) {
    const MeshInput input{view_points(vertices), to_triangles(triangles), to_optional(fixed, to_indices),
                          to_optional(fixed_normals, to_points)};
    return from_vector(mean_curvature(input, normal_words.value(normals)));
}

py::array vertex_normals_array(const DoubleArray& vertices, const IntArray& triangles, const std::string& normals) {
    return from_points(
        vertex_normals({view_points(vertices), to_triangles(triangles), {}, {}}, normal_words.value(normals)));
}

py::tuple cotan_laplacian_arrays(const DoubleArray& vertices, const IntArray& triangles) {
    const MatrixEntries entries = cotan_laplacian(to_points(vertices), to_triangles(triangles));
    const VectorX values =
        Eigen::Map<const VectorX>(entries.values.data(), static_cast<Eigen::Index>(entries.values.size()));
    return py::make_tuple(from_indices(entries.rows), from_indices(entries.columns), from_vector(values));
}

py::list boundary_loop_arrays(const IntArray& triangles) {
    const Triangles list = to_triangles(triangles);
    const int count = list.size() > 0 ? list.maxCoeff() + 1 : 0;
    py::list loops;
    for (const Indices& loop : boundary_loops(list, count)) loops.append(from_indices(loop));
    return loops;
}

py::array turned_array(const IntArray& triangles, int vertex_count) {
    return from_indices(turned_triangles(to_triangles(triangles), vertex_count));
}

py::array component_array(const IntArray& triangles, const std::optional<IntArray>& fixed, int vertex_count) {
    return from_indices(component_of_triangles(to_triangles(triangles), to_optional(fixed, to_indices), vertex_count));
}

py::array flipped_array(const DoubleArray& vertices, const IntArray& triangles, const std::optional<IntArray>& fixed) {
    return from_indices(
        flipped_triangles({view_points(vertices), to_triangles(triangles), to_optional(fixed, to_indices), {}}));
}

py::array crossing_array(const DoubleArray& vertices, const IntArray& triangles, const std::optional<IntArray>& near) {
    const Triangles list = to_triangles(triangles);
    const Points points = to_points(vertices);
    return from_indices(near ? crossings_with(list, points, to_indices(*near)) : crossing_triangles(list, points));
}

py::array conformal_distortion_array(const DoubleArray& reference, const DoubleArray& vertices,
                                     const IntArray& triangles) {
    return from_vector(conformal_distortion(to_points(reference), to_points(vertices), to_triangles(triangles)));
}

py::array signed_distance_array(const DoubleArray& at, const DoubleArray& reference, const IntArray& triangles) {
    return from_vector(signed_distances(to_points(at), to_points(reference), to_triangles(triangles)));
}

}  // namespace

void bind_measure(py::module_& module) {
    module.def("mean_curvature", &mean_curvature_array, py::arg("vertices"), py::arg("triangles"), py::arg("fixed"),
               py::arg("fixed_normals"), py::arg("normals"));
    module.def("vertex_normals", &vertex_normals_array, py::arg("vertices"), py::arg("triangles"), py::arg("normals"));
    module.def("cotan_laplacian", &cotan_laplacian_arrays, py::arg("vertices"), py::arg("triangles"));
    module.def("components", &component_array, py::arg("triangles"), py::arg("fixed"), py::arg("vertex_count"));
    module.def("boundary_loops", &boundary_loop_arrays, py::arg("triangles"));
    module.def("turned_triangles", &turned_array, py::arg("triangles"), py::arg("vertex_count"));
    module.def("flipped_triangles", &flipped_array, py::arg("vertices"), py::arg("triangles"), py::arg("fixed"));
    module.def("self_intersections", &crossing_array, py::arg("vertices"), py::arg("triangles"), py::arg("near"));
    module.def("conformal_distortion", &conformal_distortion_array, py::arg("reference"), py::arg("vertices"),
               py::arg("triangles"));
    module.def("signed_distances", &signed_distance_array, py::arg("at"), py::arg("reference"), py::arg("triangles"));
}

}  // namespace fairing::bindings
