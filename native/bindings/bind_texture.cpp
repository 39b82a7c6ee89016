#include <algorithm>

#include "bindings/convert.h"
#include "bindings/python_run.h"
#include "bindings/topics.h"
#include "texture/graded_mesh.h"
#include "texture/harmonic_extension.h"
#include "texture/texel_owners.h"

namespace fairing::bindings {

namespace {

using FlagArray = py::array_t<bool, py::array::c_style | py::array::forcecast>;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

py::tuple graded(const DoubleArray& vertices, const IntArray& triangles, const FlagArray& chosen, double finest) {
    PythonRun run;
    const Points points = to_points(vertices);
    const Triangles faces = to_triangles(triangles);
    const ChosenSides sides = Eigen::Map<const ChosenSides>(chosen.data(), 3, chosen.shape(0));
    const GradedMesh mesh =
        run.without_gil([&](const ProgressCallback&) { return graded_mesh(points, faces, sides, finest); });
    py::array_t<bool> flags({mesh.chosen.cols(), Eigen::Index{3}});
    std::copy_n(mesh.chosen.data(), mesh.chosen.size(), flags.mutable_data());
    return py::make_tuple(from_points(mesh.points), from_triangles(mesh.triangles), from_indices(mesh.parent),
                          from_points(mesh.weights), flags);
}

py::array extended(const DoubleArray& vertices, const IntArray& triangles, const IntArray& known,
                   const DoubleArray& values) {
    PythonRun run;
    const Points points = to_points(vertices);
    const Triangles faces = to_triangles(triangles);
    const Indices held = to_indices(known);
    const Eigen::MatrixXd given = Eigen::Map<const Rows>(values.data(), values.shape(0), values.shape(1));
    const Rows found =
        run.without_gil([&](const ProgressCallback&) { return harmonic_extension(points, faces, held, given); });
    return py::array_t<double>({found.rows(), found.cols()}, found.data());
}

py::tuple owners(const DoubleArray& corners, int width, int height) {
    PythonRun run;
    const Eigen::Matrix2Xd places = Eigen::Map<const Eigen::Matrix2Xd>(corners.data(), 2, corners.size() / 2);
    const TexelOwners found =
        run.without_gil([&](const ProgressCallback&) { return texel_owners(places, {width, height}); });
    return py::make_tuple(py::array_t<int>({height, width}, found.owner.data()), found.count);
}

py::array colours(const DoubleArray& corners, const DoubleArray& values, int width, int height) {
    PythonRun run;
    const Eigen::Matrix2Xd places = Eigen::Map<const Eigen::Matrix2Xd>(corners.data(), 2, corners.size() / 2);
    const Eigen::MatrixXd own =
        Eigen::Map<const Eigen::MatrixXd>(values.data(), values.shape(2), values.shape(0) * values.shape(1));
    const Eigen::MatrixXf found =
        run.without_gil([&](const ProgressCallback&) { return texel_values(places, own, {width, height}); });
    return py::array_t<float>({static_cast<py::ssize_t>(height), static_cast<py::ssize_t>(width), values.shape(2)},
                              found.data());
}

}  // namespace

void bind_texture(py::module_& module) {
    module.def("graded_mesh", &graded, py::arg("vertices"), py::arg("triangles"), py::arg("chosen"), py::arg("finest"));
    module.def("harmonic_extension", &extended, py::arg("vertices"), py::arg("triangles"), py::arg("known"),
               py::arg("values"));
    module.def("texel_values", &colours, py::arg("corners"), py::arg("values"), py::arg("width"), py::arg("height"));
    module.def("texel_owners", &owners, py::arg("corners"), py::arg("width"), py::arg("height"));
}

}  // namespace fairing::bindings
