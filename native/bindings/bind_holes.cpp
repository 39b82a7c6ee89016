#include "api/fill.h"
#include "base/parallel.h"
#include "bindings/fair_options.h"
#include "bindings/python_run.h"
#include "bindings/topics.h"
#include "fill/small_hole.h"
#include "geometry/segments.h"
#include "mesh/hole_loops.h"

namespace fairing::bindings {

namespace {

template <typename Array, typename Convert>
auto each(const std::vector<Array>& arrays, Convert convert) {
    std::vector<decltype(convert(arrays[0]))> result;
    result.reserve(arrays.size());
    for (const Array& array : arrays) result.push_back(convert(array));
    return result;
}

// Loops; normals and curvatures of each, and by vertices; most edges and the greatest length.
using Named = std::tuple<std::vector<IntArray>, std::vector<DoubleArray>, std::vector<DoubleArray>, DoubleArray,
                         DoubleArray, int, double>;

NamedLoops to_named(const Named& named) {
    const auto& [loops, normals, curvatures, vertex_normals, vertex_curvatures, longest, longest_length] = named;
    return {each(loops, to_indices),
            each(normals, to_points),
            each(curvatures, to_vector),
            to_points(vertex_normals),
            to_vector(vertex_curvatures),
            longest,
            longest_length};
}

template <std::size_t Size>
py::array from_rows(const std::vector<std::array<int, Size>>& rows) {
    py::array_t<int> result({static_cast<py::ssize_t>(rows.size()), static_cast<py::ssize_t>(Size)});
    for (std::size_t k = 0; k < rows.size(); ++k) std::copy_n(rows[k].data(), Size, result.mutable_data() + Size * k);
    return std::move(result);
}

// New vertices, loops with normals, vertices of creases, and edges that no quad runs across.
using Through = std::tuple<DoubleArray, std::vector<IntArray>, std::vector<DoubleArray>, IntArray, IntArray>;

std::optional<CurvesThrough> to_curves(const std::optional<Through>& given) {
    if (!given) return std::nullopt;
    const auto& [added, loops, normals, creases, edges] = *given;
    return CurvesThrough{to_points(added), each(loops, to_indices), each(normals, to_points), to_indices(creases),
                         to_pairs(edges)};
}

py::list from_loops(const std::vector<Indices>& loops) {
    py::list result;
    for (const Indices& loop : loops) result.append(from_indices(loop));
    return result;
}

// The dictionary of a result, or the reason of a hole that stays open.
py::tuple from_filled(const FilledHole& hole) {
    if (hole.left_because) return py::make_tuple(from_loops(hole.loops), from_diagnostic(*hole.left_because));
    py::dict dict = to_dict(hole.report);
    dict["vertices"] = from_points(hole.vertices);
    dict["triangles"] = from_triangles(hole.triangles);
    dict["cut"] = hole.is_cut;
    dict["along_curves"] = hole.along_curves;
    if (hole.pairs) dict["pairs"] = from_rows(*hole.pairs);
    return py::make_tuple(from_loops(hole.loops), dict);
}

// Bridge, rows, G2, spacing, whether it is the same everywhere, most vertices.
using Wishes = std::tuple<bool, bool, bool, double, bool, int>;

// The holes of a mesh, kept between finding and filling them.
class PythonHoles {
public:
    PythonHoles(DoubleArray vertices, const IntArray& triangles, const IntArray& hard, const Named& named, bool bridge,
                int threads)
        : vertices_(std::move(vertices)) {
        PythonRun run;
        BorderedMesh mesh{view_points(vertices_), to_triangles(triangles), to_pairs(hard)};
        const NamedLoops loops = to_named(named);
        run.without_gil([&](const ProgressCallback&) {
            const Threads team(threads);
            mesh_.emplace(std::move(mesh));
            found_ = find_holes(*mesh_, loops, bridge);
            return 0;
        });
    }

    [[nodiscard]] py::list loops() const {
        py::list result;
        for (const Hole& hole : found_.holes) {
            py::list loops;
            for (const BoundaryLoop& loop : hole.loops) loops.append(from_indices(loop.vertices));
            result.append(loops);
        }
        return result;
    }

    // Of lone loops: normals, and whether edges may run on through them. Not where one face closes them, nor where the
    // border passes a vertex several times: which pass an edge ends at is not known.
    [[nodiscard]] py::list slopes(double spacing) const {
        py::list result;
        for (const Hole& hole : found_.holes) {
            const BoundaryLoop& loop = hole.loops[0];
            const bool may = !loop.is_pinched && !is_single_face(loop.shape, spacing);
            result.append(py::make_tuple(from_points(loop.shape.normals), may));
        }
        return result;
    }

    [[nodiscard]] py::list left() const {
        py::list result;
        for (const LeftOpen& each : found_.left)
            result.append(py::make_tuple(from_indices(each.loop), from_diagnostic(each.reason), each.is_outer));
        return result;
    }

    // The warning about outer borders that stay open, if there are any.
    [[nodiscard]] py::object outer() const {
        std::vector<Indices> loops;
        for (const LeftOpen& each : found_.left) {
            if (each.is_outer) loops.push_back(each.loop);
        }
        return loops.empty() ? py::none() : from_diagnostic(outer_borders_left(loops));
    }

    // Vertices of the mesh, ascending, and the triangles around a hole in numbers of these.
    [[nodiscard]] py::tuple around(std::size_t hole) const {
        const LocalMesh local = mesh_->around(found_.holes.at(hole).loops[0].vertices);
        return py::make_tuple(from_indices(local.to_mesh), from_triangles(local.triangles));
    }

    [[nodiscard]] py::list fill(const std::vector<std::optional<Through>>& through, const Wishes& wishes,
                                const Options& given, const py::object& callback) const {
        PythonRun run(callback);
        const auto& [bridge, in_rows, joins, spacing, is_even, most] = wishes;
        FillOptions options{
            given.fair, given.held, joins, bridge, in_rows, spacing, is_even ? Spread::equal : Spread::outline, most};
        const auto curves = each(through, to_curves);
        const std::vector<FilledHole> filled = run.without_gil([&](const ProgressCallback& progress) {
            return fairing::fill(*mesh_, found_.holes, curves, options, progress);
        });
        py::list result;
        for (const FilledHole& hole : filled) result.append(from_filled(hole));
        return result;
    }

private:
    DoubleArray vertices_;
    std::optional<HoledMesh> mesh_;
    Holes found_;
};

// The edges with one triangle, where they are known, the hole on their left.
py::tuple hole_loops_of(const DoubleArray& vertices, const IntArray& triangles, const std::optional<IntArray>& border) {
    PythonRun run;
    const View<Points> points = view_points(vertices);
    const Triangles faces = to_triangles(triangles);
    const auto given = to_optional(border, to_pairs);
    const HoleLoops found = run.without_gil([&](const ProgressCallback&) {
        return hole_loops(points, faces, given ? *given : border_sides(faces, static_cast<int>(points.cols())));
    });
    return py::make_tuple(from_loops(found.loops), from_loops(found.torn));
}

std::vector<LoopShape> shapes_of(const DoubleArray& vertices, const IntArray& triangles,
                                 const std::vector<IntArray>& loops) {
    PythonRun run;
    BorderedMesh mesh{view_points(vertices), to_triangles(triangles)};
    const std::vector<Indices> named = each(loops, to_indices);
    return run.without_gil([&](const ProgressCallback&) { return loop_shapes(HoledMesh(std::move(mesh)), named); });
}

std::vector<bool> outer_borders(const DoubleArray& vertices, const IntArray& triangles,
                                const std::vector<IntArray>& loops) {
    return each(shapes_of(vertices, triangles, loops), is_outer);
}

double expected_fill(const DoubleArray& vertices, const IntArray& triangles, const std::vector<IntArray>& loops,
                     bool bridge, double spacing) {
    return expected_count(shapes_of(vertices, triangles, loops), spacing, bridge);
}

py::array crossing_edge_array(const IntArray& edges, const DoubleArray& vertices) {
    return from_rows(crossing_edges(to_pairs(edges), view_points(vertices)));
}

py::tuple touching_edge_arrays(const IntArray& edges, const DoubleArray& vertices) {
    const Touches found = touching_edges(to_pairs(edges), view_points(vertices));
    return py::make_tuple(from_rows(found.on_edges), from_rows(found.pairs));
}

}  // namespace

void bind_holes(py::module_& module) {
    module.def("hole_loops", &hole_loops_of, py::arg("vertices"), py::arg("triangles"), py::arg("border"));
    module.def("outer_borders", &outer_borders, py::arg("vertices"), py::arg("triangles"), py::arg("loops"));
    module.def("expected_fill", &expected_fill, py::arg("vertices"), py::arg("triangles"), py::arg("loops"),
               py::arg("bridge"), py::arg("spacing"));
    module.def("crossing_edges", &crossing_edge_array, py::arg("edges"), py::arg("vertices"));
    module.def("touching_edges", &touching_edge_arrays, py::arg("edges"), py::arg("vertices"));
    py::class_<PythonHoles>(module, "Holes", py::module_local())
        .def(py::init<DoubleArray, const IntArray&, const IntArray&, const Named&, bool, int>(), py::arg("vertices"),
             py::arg("triangles"), py::arg("hard"), py::arg("named"), py::arg("bridge"), py::arg("threads"))
        .def_property_readonly("loops", &PythonHoles::loops)
        .def("slopes", &PythonHoles::slopes, py::arg("spacing"))
        .def_property_readonly("left", &PythonHoles::left)
        .def_property_readonly("outer", &PythonHoles::outer)
        .def("around", &PythonHoles::around, py::arg("hole"))
        .def("fill", &PythonHoles::fill, py::arg("through"), py::arg("wishes"), py::arg("options"),
             py::arg("progress"));
}

}  // namespace fairing::bindings
