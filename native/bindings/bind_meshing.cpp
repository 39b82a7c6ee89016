#include <algorithm>

#include "api/new_patch.h"
#include "bindings/fair_options.h"
#include "bindings/python_run.h"
#include "bindings/topics.h"
#include "boundary/hard_ways.h"
#include "fill/wire_cells.h"
#include "fillet/first_mesh.h"

namespace fairing::bindings {

namespace {

py::list from_loops(const std::vector<Indices>& loops) {
    py::list result;
    for (const Indices& loop : loops) result.append(from_indices(loop));
    return result;
}

py::array from_pairs(const VertexPairs& pairs) {
    py::array_t<int> result({static_cast<py::ssize_t>(pairs.size()), py::ssize_t{2}});
    for (std::size_t k = 0; k < pairs.size(); ++k) std::copy_n(pairs[k].data(), 2, result.mutable_data() + 2 * k);
    return std::move(result);
}

py::tuple wire_cell_arrays(const IntArray& wires, const DoubleArray& vertices, bool closed) {
    const WireCells cells = cells_of(to_pairs(wires), view_points(vertices), closed);
    return py::make_tuple(from_loops(cells.loops), from_points(cells.normals), from_loops(cells.left_open),
                          from_pairs(cells.rims));
}

py::array cell_array(const IntArray& triangles, const std::vector<Indices>& loops, int vertex_count) {
    return from_indices(cells_of_triangles(to_triangles(triangles), loops, vertex_count));
}

py::array hard_way_array(const DoubleArray& vertices, const IntArray& edges, const IntArray& hard,
                         const std::vector<Indices>& ends) {
    PythonRun run;
    const View<Points> points = view_points(vertices);
    const VertexPairs usable = to_pairs(edges);
    const VertexPairs hard_ones = to_pairs(hard);
    return from_pairs(
        run.without_gil([&](const ProgressCallback&) { return hard_ways(points, usable, hard_ones, ends); }));
}

// Vertices, triangles, fixed vertices with normals and curvatures, triangles outside.
using GivenPatch = std::tuple<DoubleArray, IntArray, std::optional<IntArray>, std::optional<DoubleArray>,
                              std::optional<DoubleArray>, IntArray>;
// Spacing, whether it is the same everywhere, quads, most vertices.
using Wishes = std::tuple<double, bool, bool, int>;

py::dict new_patch_arrays(const GivenPatch& given, const VertexPairs& kept, const Options& options,
                          const Wishes& wishes, const py::object& callback) {
    PythonRun run(callback);
    const auto& [vertices, triangles, fixed, normals, curvatures, outside] = given;
    const MeshInput input{view_points(vertices),
                          to_triangles(triangles),
                          to_optional(fixed, to_indices),
                          to_optional(normals, to_points),
                          to_optional(curvatures, to_vector),
                          to_triangles(outside),
                          options.held};
    const auto& [spacing, is_even, in_rows, most] = wishes;
    const NewPatchOptions wanted{options.fair, {spacing, 0, is_even ? Spread::equal : Spread::outline}, in_rows, most};
    const NewPatch made =
        run.without_gil([&](const ProgressCallback& progress) { return new_patch(input, kept, wanted, progress); });
    py::dict dict = to_dict(made.report);
    dict["vertices"] = from_points(made.vertices);
    dict["triangles"] = from_triangles(made.triangles);
    dict["cut"] = made.is_cut;
    dict["origin"] = py::make_tuple(from_indices(made.triangle), from_points(made.weights));
    dict["old"] = from_indices(made.old);
    dict["pairs"] = made.pairs ? py::object(from_pairs(*made.pairs)) : py::none();
    return dict;
}

py::tuple first_mesh_arrays(const DoubleArray& vertices, const IntArray& triangles, const py::array_t<bool>& inside,
                            const IntArray& seams, double spacing) {
    PythonRun run;
    const Points points = to_points(vertices);
    const Triangles faces = to_triangles(triangles);
    CutPieces cut{points, faces, {inside.data(), inside.data() + inside.size()}, to_pairs(seams)};
    const FirstMesh first =
        run.without_gil([&](const ProgressCallback&) { return first_mesh(std::move(cut), spacing); });
    py::array_t<bool> marks(static_cast<py::ssize_t>(first.inside.size()));
    std::ranges::copy(first.inside, marks.mutable_data());
    return py::make_tuple(marks, from_indices(first.pieces), from_triangles(first.triangles), from_pairs(first.lines));
}

}  // namespace

void bind_meshing(py::module_& module) {
    module.def("new_patch", &new_patch_arrays, py::arg("patch"), py::arg("kept"), py::arg("options"), py::arg("wishes"),
               py::arg("progress"));
    module.def("first_mesh", &first_mesh_arrays, py::arg("vertices"), py::arg("triangles"), py::arg("inside"),
               py::arg("seams"), py::arg("spacing"));
    module.def("wire_cells", &wire_cell_arrays, py::arg("wires"), py::arg("vertices"), py::arg("closed"));
    module.def("cells_of_triangles", &cell_array, py::arg("triangles"), py::arg("loops"), py::arg("vertex_count"));
    module.def("hard_ways", &hard_way_array, py::arg("vertices"), py::arg("edges"), py::arg("hard"), py::arg("ends"));
}

}  // namespace fairing::bindings
