#include "api/quad_mesh.h"
#include "bindings/python_run.h"
#include "bindings/topics.h"

namespace fairing::bindings {

namespace {

template <std::size_t Corners>
py::array_t<int> from_faces(const std::vector<std::array<int, Corners>>& faces) {
    py::array_t<int> result({static_cast<py::ssize_t>(faces.size()), static_cast<py::ssize_t>(Corners)});
    for (std::size_t k = 0; k < faces.size(); ++k)
        std::copy_n(faces[k].data(), Corners, result.mutable_data() + Corners * k);
    return result;
}

py::dict quad_mesh_of(const DoubleArray& vertices, const IntArray& triangles, const std::optional<IntArray>& fixed,
                      const std::optional<DoubleArray>& fixed_normals, const py::object& callback) {
    PythonRun run(callback);
    const MeshInput input{view_points(vertices), to_triangles(triangles), to_optional(fixed, to_indices),
                          to_optional(fixed_normals, to_points)};
    const QuadMesh result =
        run.without_gil([&](const ProgressCallback& progress) { return quad_mesh(input, progress); });
    py::dict dict;
    dict["boundary"] = from_indices(result.boundary);
    dict["quads"] = from_faces(result.pattern.quads);
    dict["triangles"] = from_faces(result.pattern.triangles);
    dict["vertices"] = from_points(result.vertices);
    dict["normals"] = from_points(result.normals);
    dict["triangle"] = from_indices(result.triangle);
    dict["weights"] = from_points(result.weights);
    dict["shapes"] = py::make_tuple(result.shapes.angle_error, result.shapes.size_error, result.shapes.unfit,
                                    result.shapes.widest, result.shapes.concave);
    dict["poles"] = result.poles;
    dict["least_poles"] = result.least_poles;
    return dict;
}

}  // namespace

void bind_quads(py::module_& module) {
    module.def("quad_mesh", &quad_mesh_of, py::arg("vertices"), py::arg("triangles"), py::arg("fixed"),
               py::arg("fixed_normals"), py::arg("progress"));
}

}  // namespace fairing::bindings
