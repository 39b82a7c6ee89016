#include <memory>

#include "api/fillet.h"
#include "api/fillet_rows.h"
#include "bindings/python_run.h"
#include "bindings/topics.h"
#include "fillet/profile.h"
#include "fillet/seam_room.h"
#include "fillet/solid_sides.h"

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

FilletInput input_of(const DoubleArray& vertices, const IntArray& triangles, const std::tuple<Pairs, Pairs>& edges,
                     const std::tuple<DoubleArray, DoubleArray>& widths, double spacing) {
    return {to_points(vertices),
            to_triangles(triangles),
            std::get<0>(edges),
            std::get<1>(edges),
            {to_vector(std::get<0>(widths)), to_vector(std::get<1>(widths))},
            spacing};
}

py::dict from_cut(const FilletCut& cut) {
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
    py::list eaten;
    for (const EatenPart& part : cut.eaten)
        eaten.append(py::make_tuple(from_indices(part.vertices), part.widest, part.held));
    dict["eaten"] = eaten;
    return dict;
}

py::dict cut_arrays(const DoubleArray& vertices, const IntArray& triangles, const std::tuple<Pairs, Pairs>& edges,
                    const std::tuple<DoubleArray, DoubleArray>& widths, double spacing, const py::object& callback) {
    PythonRun run(callback);
    const FilletInput input = input_of(vertices, triangles, edges, widths, spacing);
    return from_cut(run.without_gil([&](const ProgressCallback& progress) { return cut_fillet(input, progress); }));
}
// The usual width, and of each vertex the widest.
py::tuple room_arrays(const DoubleArray& vertices, const IntArray& triangles, const std::tuple<Pairs, Pairs>& edges) {
    PythonRun run;
    const Points points = to_points(vertices);
    const Triangles corners = to_triangles(triangles);
    const SeamRoom room = run.without_gil([&](const ProgressCallback&) {
        return seam_room(SeamMesh(points, corners, std::get<0>(edges), std::get<1>(edges)));
    });
    return py::make_tuple(room.usual, from_vector(room.widest));
}

py::array wrong_side_array(const DoubleArray& vertices, const IntArray& triangles, const Pairs& edges, double width,
                           const DoubleArray& before, const DoubleArray& after, const py::object& callback) {
    PythonRun run(callback);
    const Points points = to_points(vertices);
    const FilletPlaces places{to_points(before), to_points(after)};
    return from_indices(run.without_gil([&](const ProgressCallback& progress) {
        const Progress reported(progress);
        const Checkpoints checkpoints(reported);
        return on_wrong_side(points, to_triangles(triangles), edges, width, places);
    }));
}

// None where no rows fit. `surface`: vertices, triangles, fixed, normals, before.
py::object rows_arrays(const DoubleArray& vertices, const IntArray& triangles, const std::tuple<Pairs, Pairs>& edges,
                       const std::tuple<DoubleArray, DoubleArray>& widths, const std::tuple<double, double>& spacings,
                       const std::optional<Pairs>& counted,
                       const std::tuple<DoubleArray, IntArray, IntArray, DoubleArray, DoubleArray>& surface,
                       const py::object& callback) {
    PythonRun run(callback);
    const FilletInput input = input_of(vertices, triangles, edges, widths, std::get<0>(spacings));
    const WantedRows wanted{std::get<1>(spacings), counted};
    const SolvedFillet solved{to_points(std::get<0>(surface)), to_triangles(std::get<1>(surface)),
                              to_indices(std::get<2>(surface)), to_points(std::get<3>(surface)),
                              to_points(std::get<4>(surface))};
    const std::optional<FilletRows> rows =
        run.without_gil([&](const ProgressCallback& progress) { return fillet_rows(input, wanted, solved, progress); });
    if (!rows) return py::none();
    py::dict dict;
    py::array_t<int> quads({static_cast<py::ssize_t>(rows->quads.size()), py::ssize_t{4}});
    for (std::size_t k = 0; k < rows->quads.size(); ++k)
        std::copy_n(rows->quads[k].data(), 4, quads.mutable_data() + 4 * k);
    dict["cut"] = from_cut(rows->cut);
    dict["quads"] = quads;
    dict["places"] = from_points(rows->places);
    dict["solved"] = from_indices(rows->solved);
    dict["on_solved"] = from_points(rows->on_solved);
    dict["given"] = from_indices(rows->given);
    dict["on_given"] = from_points(rows->on_given);
    dict["on_seam"] = from_flags(rows->on_seam);
    return std::move(dict);
}

py::array drawn_arrays(const DoubleArray& points, const IntArray& triangles, const IntArray& fixed,
                       const DoubleArray& target, const DoubleArray& pull) {
    PythonRun run;
    const Points from = to_points(points);
    const Points to = to_points(target);
    return from_points(run.without_gil([&](const ProgressCallback&) {
        return drawn_to(from, to_triangles(triangles), to_indices(fixed), to, to_vector(pull));
    }));
}

}  // namespace

void bind_fillet(py::module_& module) {
    module.def("seam_room", &room_arrays, py::arg("vertices"), py::arg("triangles"), py::arg("edges"));
    module.def("on_wrong_side", &wrong_side_array, py::arg("vertices"), py::arg("triangles"), py::arg("edges"),
               py::arg("width"), py::arg("before"), py::arg("after"), py::arg("progress"));
    module.def("drawn_to", &drawn_arrays, py::arg("points"), py::arg("triangles"), py::arg("fixed"), py::arg("target"),
               py::arg("pull"));
    module.def("fillet_rows", &rows_arrays, py::arg("vertices"), py::arg("triangles"), py::arg("edges"),
               py::arg("widths"), py::arg("spacings"), py::arg("counted"), py::arg("surface"), py::arg("progress"));
    module.def("cut_fillet", &cut_arrays, py::arg("vertices"), py::arg("triangles"), py::arg("edges"),
               py::arg("widths"), py::arg("spacing"), py::arg("progress"));
}

}  // namespace fairing::bindings
