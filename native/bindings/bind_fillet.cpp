#include "api/fillet.h"
#include "bindings/python_run.h"
#include "bindings/topics.h"

namespace fairing::bindings {

namespace {

using Pairs = std::vector<VertexPair>;

py::array from_pairs(const Pairs& pairs) {
    py::array_t<int> result({static_cast<py::ssize_t>(pairs.size()), py::ssize_t{2}});
    for (std::size_t k = 0; k < pairs.size(); ++k) std::copy_n(pairs[k].data(), 2, result.mutable_data() + 2 * k);
    return std::move(result);
}

py::array from_flags(const std::vector<char>& flags) {
    py::array_t<bool> result(static_cast<py::ssize_t>(flags.size()));
    for (std::size_t k = 0; k < flags.size(); ++k) result.mutable_at(static_cast<py::ssize_t>(k)) = flags[k] != 0;
    return std::move(result);
}

py::dict cut_arrays(const DoubleArray& vertices, const IntArray& triangles, const Pairs& seams, const Pairs& walls,
                    const std::tuple<DoubleArray, DoubleArray>& widths, double spacing, const py::object& callback) {
    PythonRun run(callback);
    const FilletInput input{to_points(vertices),
                            to_triangles(triangles),
                            seams,
                            walls,
                            {to_vector(std::get<0>(widths)), to_vector(std::get<1>(widths))},
                            spacing};
    const FilletCut cut =
        run.without_gil([&](const ProgressCallback& progress) { return cut_fillet(input, progress); });
    py::dict dict;
    dict["points"] = from_points(cut.mesh.points);
    dict["triangles"] = from_triangles(cut.mesh.triangles);
    dict["parent"] = from_indices(cut.mesh.parent);
    dict["inside"] = from_flags(cut.mesh.inside);
    dict["weights"] = from_points(cut.weights);
    dict["seams"] = from_pairs(cut.mesh.seams);
    dict["line"] = from_pairs(cut.mesh.line);
    dict["boundary"] = from_indices(cut.boundary);
    dict["normals"] = from_points(cut.normals);
    dict["curvatures"] = from_vector(cut.curvatures);
    dict["corners"] = from_indices(cut.corners);
    dict["swallowed"] = from_indices(cut.swallowed);
    return dict;
}

}  // namespace

void bind_fillet(py::module_& module) {
    module.def("cut_fillet", &cut_arrays, py::arg("vertices"), py::arg("triangles"), py::arg("seams"), py::arg("walls"),
               py::arg("widths"), py::arg("spacing"), py::arg("progress"));
}

}  // namespace fairing::bindings
