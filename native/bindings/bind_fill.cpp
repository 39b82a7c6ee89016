#include <algorithm>

#include "api/coarse_surface.h"
#include "api/interpolate.h"
#include "api/remesh.h"
#include "bindings/python_run.h"
#include "bindings/topics.h"
#include "bindings/words.h"
#include "fill/conformal_map.h"
#include "fill/joined_loops.h"
#include "fill/quads.h"

namespace fairing::bindings {

namespace {

py::dict fill_arrays(const DoubleArray& vertices, const std::vector<IntArray>& loops,
                     const std::vector<DoubleArray>& normals, bool bridge, const std::string& equation,
                     const py::object& callback) {
    PythonRun run(callback);
    OpenLoops input{to_points(vertices), {}, {}};
    for (const IntArray& loop : loops) input.loops.push_back(to_indices(loop));
    for (const DoubleArray& of_loop : normals) input.normals.push_back(to_points(of_loop));
    SolverOptions options;
    options.equation = equation_words.value(equation);
    const NewSurface result =
        run.without_gil([&](const ProgressCallback& progress) { return fill_loops(input, bridge, options, progress); });
    py::dict dict;
    dict["vertices"] = from_points(result.vertices);
    dict["triangles"] = from_triangles(result.triangles);
    dict["converged"] = result.converged;
    return dict;
}

// Spacing, least count, whether one length holds everywhere, and whether the old triangles are flat.
using Wanted = std::tuple<double, int, bool, bool>;

WantedLengths to_lengths(const Wanted& wanted) {
    const auto& [spacing, least_count, even, flat] = wanted;
    return {spacing, least_count, even ? Spread::equal : Spread::outline, flat};
}

MeshInput to_input(const DoubleArray& vertices, const IntArray& triangles, const std::optional<IntArray>& fixed,
                   const std::optional<DoubleArray>& fixed_normals) {
    return {view_points(vertices), to_triangles(triangles), to_optional(fixed, to_indices),
            to_optional(fixed_normals, to_points)};
}

// Fixed vertices on creases, and on smooth curves.
using FreeSlopes = std::pair<IntArray, IntArray>;

py::dict remesh_arrays(const DoubleArray& vertices, const IntArray& triangles, const std::optional<IntArray>& fixed,
                       const std::optional<DoubleArray>& fixed_normals, const FreeSlopes& free_slopes,
                       const VertexPairs& kept, const Wanted& wanted, int threads, const py::object& callback) {
    PythonRun run(callback);
    MeshInput input = to_input(vertices, triangles, fixed, fixed_normals);
    input.held.creases = to_indices(free_slopes.first);
    input.held.smooth_curves = to_indices(free_slopes.second);
    const NewMesh result = run.without_gil(
        [&](const ProgressCallback& progress) { return remesh(input, kept, to_lengths(wanted), threads, progress); });
    py::dict dict;
    dict["vertices"] = from_points(result.vertices);
    dict["normals"] = from_points(result.normals);
    dict["triangles"] = from_triangles(result.triangles);
    dict["triangle"] = from_indices(result.triangle);
    dict["weights"] = from_points(result.weights);
    dict["old"] = from_indices(result.old);
    return dict;
}

double expected_count_of(const DoubleArray& vertices, const IntArray& triangles, const std::optional<IntArray>& fixed,
                         const std::optional<DoubleArray>& fixed_normals, const Wanted& wanted) {
    return expected_remesh_count(to_input(vertices, triangles, fixed, fixed_normals), to_lengths(wanted));
}

Eigen::MatrixXd to_matrix(const DoubleArray& rows) {
    return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        rows.data(), rows.shape(0), rows.shape(1));
}

py::array from_matrix(const Eigen::MatrixXd& matrix) {
    return py::array_t<double>({matrix.rows(), matrix.cols()},
                               {sizeof(double), sizeof(double) * static_cast<std::size_t>(matrix.rows())},
                               matrix.data());
}

py::array interpolated(const DoubleArray& vertices, const IntArray& triangles, const IntArray& fixed,
                       const DoubleArray& values) {
    PythonRun run;
    const MeshInput input{view_points(vertices), to_triangles(triangles), to_indices(fixed), std::nullopt};
    const Eigen::MatrixXd columns = to_matrix(values);
    return from_matrix(run.without_gil([&](const ProgressCallback&) { return interpolate(input, columns); }));
}

py::array conformal_map_of(const DoubleArray& vertices, const IntArray& triangles, const IntArray& fixed,
                           const DoubleArray& places) {
    return from_matrix(
        conformal_map(to_points(vertices), to_triangles(triangles), to_indices(fixed), to_matrix(places)));
}

py::tuple quads_of(const DoubleArray& vertices, const IntArray& triangles, const VertexPairs& kept) {
    const PairedQuads result = paired_quads(to_points(vertices), to_triangles(triangles), kept);
    py::array_t<int> quads({result.quads.cols(), Eigen::Index{4}});
    std::copy_n(result.quads.data(), result.quads.size(), quads.mutable_data());
    py::array_t<int> pairs({static_cast<py::ssize_t>(result.pairs.size()), py::ssize_t{2}});
    for (std::size_t k = 0; k < result.pairs.size(); ++k)
        std::copy_n(result.pairs[k].data(), 2, pairs.mutable_data() + 2 * k);
    return py::make_tuple(quads, pairs, from_indices(result.rest));
}

py::array triangulated(const DoubleArray& vertices, const IntArray& corners, const IntArray& sizes) {
    return from_triangles(triangulated_faces(to_points(vertices), to_indices(corners), to_indices(sizes)));
}

}  // namespace

void bind_fill(py::module_& module) {
    module.def("interpolate", &interpolated, py::arg("vertices"), py::arg("triangles"), py::arg("fixed"),
               py::arg("values"));
    module.def("conformal_map", &conformal_map_of, py::arg("vertices"), py::arg("triangles"), py::arg("fixed"),
               py::arg("places"));
    module.def("triangulated", &triangulated, py::arg("vertices"), py::arg("corners"), py::arg("sizes"));
    module.def("paired_quads", &quads_of, py::arg("vertices"), py::arg("triangles"), py::arg("kept"));
    module.def("fill_loops", &fill_arrays, py::arg("vertices"), py::arg("loops"), py::arg("normals"), py::arg("bridge"),
               py::arg("equation"), py::arg("progress"));
    module.def("remesh", &remesh_arrays, py::arg("vertices"), py::arg("triangles"), py::arg("fixed"),
               py::arg("fixed_normals"), py::arg("free_slopes"), py::arg("kept"), py::arg("wanted"), py::arg("threads"),
               py::arg("progress"));
    module.def("expected_count", &expected_count_of, py::arg("vertices"), py::arg("triangles"), py::arg("fixed"),
               py::arg("fixed_normals"), py::arg("wanted"));
}

}  // namespace fairing::bindings
