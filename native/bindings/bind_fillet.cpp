#include <memory>

#include "api/fillet.h"
#include "api/fillet_rows.h"
#include "bindings/python_run.h"
#include "bindings/topics.h"
#include "fillet/profile.h"

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

// Vertex, edge and triangle of each point, places, ways along edges; segments.
LevelLine line_of(const py::tuple& arrays) {
    const auto numbers = arrays[0].cast<std::vector<std::array<int, 3>>>();
    const auto places = arrays[1].cast<std::vector<std::array<double, 3>>>();
    const auto along = arrays[2].cast<std::vector<double>>();
    LevelLine line;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        const auto [vertex, edge, triangle] = numbers[k];
        line.points.push_back({Vector3(places[k].data()), vertex, edge, along[k], triangle, Vector3::Zero()});
    }
    for (const auto& [from, to, triangle] : arrays[3].cast<std::vector<std::array<int, 3>>>())
        line.segments.push_back({from, to, triangle});
    return line;
}

py::dict line_arrays(const DoubleArray& vertices, const IntArray& triangles, const std::tuple<Pairs, Pairs>& edges,
                     const std::tuple<DoubleArray, DoubleArray>& widths, double spacing, const py::object& callback) {
    PythonRun run(callback);
    const FilletInput input = input_of(vertices, triangles, edges, widths, spacing);
    const FilletLine found =
        run.without_gil([&](const ProgressCallback& progress) { return fillet_line(input, progress); });
    const std::size_t count = found.line.points.size();
    Points places(3, static_cast<Eigen::Index>(count));
    std::vector<std::array<int, 3>> numbers;
    std::vector<double> along;
    Pairs feet;
    std::vector<double> foot_along;
    std::vector<char> corner;
    for (std::size_t k = 0; k < count; ++k) {
        const LinePoint& point = found.line.points[k];
        places.col(static_cast<Eigen::Index>(k)) = point.place;
        numbers.push_back({point.vertex, point.edge, point.triangle});
        along.push_back(point.along);
        feet.push_back(found.feet[k].half_edge);
        foot_along.push_back(found.feet[k].along);
        corner.push_back(found.feet[k].corner ? 1 : 0);
    }
    std::vector<std::array<int, 3>> segments;
    segments.reserve(found.line.segments.size());
    for (const LineSegment& segment : found.line.segments)
        segments.push_back({segment.from, segment.to, segment.triangle});
    std::vector<std::array<int, 5>> walls;
    walls.reserve(found.walls.size());
    for (const ReachedWall& wall : found.walls)
        walls.push_back({wall.edge, wall.tail, wall.head, wall.triangle, wall.corner});
    py::dict dict;
    dict["places"] = from_points(places);
    dict["numbers"] = py::cast(numbers);
    dict["along"] = py::cast(along);
    dict["ends"] = from_pairs(found.ends);
    dict["feet"] = from_pairs(feet);
    dict["foot_along"] = py::cast(foot_along);
    dict["corner"] = from_flags(corner);
    dict["segments"] = py::cast(segments);
    dict["seams"] = from_pairs(found.seams);
    dict["walls"] = py::cast(walls);
    return dict;
}

py::dict cut_arrays(const DoubleArray& vertices, const IntArray& triangles, const std::tuple<Pairs, Pairs>& edges,
                    const std::tuple<DoubleArray, DoubleArray>& widths, double spacing,
                    const std::optional<py::tuple>& line, const py::object& callback) {
    PythonRun run(callback);
    const FilletInput input = input_of(vertices, triangles, edges, widths, spacing);
    std::optional<LevelLine> along;
    if (line) along = line_of(*line);
    const FilletCut cut =
        run.without_gil([&](const ProgressCallback& progress) { return cut_fillet(input, along, progress); });
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

py::dict from_places(const PlacesOnFillet& found) {
    py::dict dict;
    dict["places"] = from_points(found.places);
    dict["triangle"] = from_indices(found.triangle);
    dict["weights"] = from_points(found.weights);
    dict["found"] = from_flags(found.found);
    return dict;
}

std::unique_ptr<FilletSurface> surface_of(const DoubleArray& vertices, const IntArray& triangles, const IntArray& fixed,
                                          const DoubleArray& normals) {
    PythonRun run;
    return run.without_gil([&](const ProgressCallback&) {
        return std::make_unique<FilletSurface>(to_points(vertices), to_triangles(triangles), to_indices(fixed),
                                               to_points(normals));
    });
}

py::dict sections_of(const FilletSurface& surface, const DoubleArray& starts, const DoubleArray& ends,
                     const DoubleArray& normals, int rows) {
    PythonRun run;
    const Points from = to_points(starts);
    const Points to = to_points(ends);
    const Points normal = to_points(normals);
    std::vector<Section> sections;
    sections.reserve(static_cast<std::size_t>(from.cols()));
    for (Eigen::Index k = 0; k < from.cols(); ++k) sections.push_back({from.col(k), to.col(k), normal.col(k)});
    return from_places(run.without_gil([&](const ProgressCallback&) { return surface.sections(sections, rows); }));
}

py::dict relaxed_of(const FilletSurface& surface, const std::vector<std::array<int, 4>>& quads,
                    const DoubleArray& points, int held, int sweeps) {
    PythonRun run;
    const Points from = to_points(points);
    QuadPattern pattern;
    pattern.boundary_count = held;
    pattern.vertex_count = static_cast<int>(from.cols());
    pattern.quads = quads;
    return from_places(
        run.without_gil([&](const ProgressCallback&) { return surface.relaxed(pattern, from, sweeps); }));
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
    module.def("drawn_to", &drawn_arrays, py::arg("points"), py::arg("triangles"), py::arg("fixed"), py::arg("target"),
               py::arg("pull"));
    py::class_<FilletSurface>(module, "FilletSurface", py::module_local())
        .def(py::init(&surface_of), py::arg("vertices"), py::arg("triangles"), py::arg("fixed"), py::arg("normals"))
        .def("sections", &sections_of, py::arg("starts"), py::arg("ends"), py::arg("normals"), py::arg("rows"))
        .def("relaxed", &relaxed_of, py::arg("quads"), py::arg("points"), py::arg("held"), py::arg("sweeps"));
    module.def("fillet_line", &line_arrays, py::arg("vertices"), py::arg("triangles"), py::arg("edges"),
               py::arg("widths"), py::arg("spacing"), py::arg("progress"));
    module.def("cut_fillet", &cut_arrays, py::arg("vertices"), py::arg("triangles"), py::arg("edges"),
               py::arg("widths"), py::arg("spacing"), py::arg("line"), py::arg("progress"));
}

}  // namespace fairing::bindings
