#include "api/fill.h"
#include "base/parallel.h"
#include "bindings/bind.h"
#include "bindings/fair_options.h"
#include "bindings/topics.h"
#include "fill/small_hole.h"
#include "mesh/hole_loops.h"

namespace fairing::bindings {

namespace {

// Loops; normals and curvatures of each, and by vertices; most edges and the greatest length.
using Named = std::tuple<std::vector<Indices>, std::vector<Points>, std::vector<VectorX>, Points, VectorX, int, double>;

// New vertices, loops with normals, vertices of creases, and edges that no quad runs across.
using Through = std::tuple<Points, std::vector<Indices>, std::vector<Points>, Indices, VertexPairs>;

template <typename Struct, typename Tuple>
Struct made_of(const Tuple& members) {
    return std::apply([](const auto&... member) { return Struct{member...}; }, members);
}

// The dictionary of a result, or the reason of a hole that stays open.
py::tuple from_filled(const FilledHole& hole) {
    if (hole.left_because) return py::make_tuple(hole.loops, *hole.left_because);
    py::dict dict = to_dict(hole.report);
    dict["vertices"] = hole.vertices;
    dict["triangles"] = hole.triangles;
    dict["cut"] = hole.is_cut;
    dict["along_curves"] = hole.along_curves;
    if (hole.pairs) dict["pairs"] = *hole.pairs;
    return py::make_tuple(hole.loops, dict);
}

// Bridge, rows, G2, spacing, whether it is the same everywhere, most vertices.
using Wishes = std::tuple<bool, bool, bool, double, bool, int>;

// The holes of a mesh, kept between finding and filling them.
class PythonHoles {
public:
    PythonHoles(Points vertices, const Triangles& triangles, const VertexPairs& hard, const Named& named, bool bridge,
                int threads)
        : vertices_(std::move(vertices)) {
        PythonRun run;
        run.without_gil([&](const ProgressCallback&) {
            const Threads team(threads);
            mesh_.emplace(BorderedMesh{vertices_, triangles, hard});
            found_ = find_holes(*mesh_, made_of<NamedLoops>(named), bridge);
            return 0;
        });
    }

    [[nodiscard]] py::list loops() const {
        py::list result;
        for (const Hole& hole : found_.holes) {
            py::list loops;
            for (const BoundaryLoop& loop : hole.loops) loops.append(loop.vertices);
            result.append(loops);
        }
        return result;
    }

    // Normals of lone loops, and whether edges may continue through them: not where one face closes the loop, nor where
    // the border passes a vertex several times, since an edge could end at either pass.
    [[nodiscard]] py::list slopes(double spacing) const {
        py::list result;
        for (const Hole& hole : found_.holes) {
            const BoundaryLoop& loop = hole.loops[0];
            const bool may = !loop.is_pinched && !takes_no_vertex(loop.shape, spacing);
            result.append(py::make_tuple(loop.shape.normals, may));
        }
        return result;
    }

    [[nodiscard]] py::list left() const {
        py::list result;
        for (const LeftOpen& each : found_.left) result.append(py::make_tuple(each.loop, each.reason, each.is_outer));
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
        return py::make_tuple(local.to_mesh, local.triangles);
    }

    [[nodiscard]] py::list fill(const std::vector<std::optional<Through>>& through, const Wishes& wishes,
                                const Options& given, const py::object& callback) const {
        PythonRun run(callback);
        const auto& [bridge, in_rows, joins, spacing, is_even, most] = wishes;
        FillOptions options{
            given.fair, given.held, joins, bridge, in_rows, spacing, is_even ? Spread::equal : Spread::boundary, most};
        std::vector<std::optional<CurvesThrough>> curves(through.size());
        for (std::size_t k = 0; k < through.size(); ++k) {
            if (through[k]) curves[k] = made_of<CurvesThrough>(*through[k]);
        }
        const std::vector<FilledHole> filled = run.without_gil([&](const ProgressCallback& progress) {
            return fairing::fill(*mesh_, found_.holes, curves, options, progress);
        });
        py::list result;
        for (const FilledHole& hole : filled) result.append(from_filled(hole));
        return result;
    }

private:
    Points vertices_;
    std::optional<HoledMesh> mesh_;
    Holes found_;
};

std::vector<LoopShape> shapes_of(const Points& vertices, const Triangles& triangles,
                                 const std::vector<Indices>& loops) {
    return loop_shapes(HoledMesh({vertices, triangles}), loops);
}

}  // namespace

void bind_holes(py::module_& module) {
    // `border`: the edges with one triangle, where they are known, the hole on their left.
    bind(
        module, "hole_loops", {"vertices", "triangles", "border"},
        [](const Points& vertices, const Triangles& triangles, const std::optional<BorderSides>& border) {
            return hole_loops(vertices, triangles,
                              border ? *border : border_sides(triangles, static_cast<int>(vertices.cols())));
        },
        [](const HoleLoops& found) { return py::make_tuple(found.loops, found.torn); });
    bind(module, "outer_borders", {"vertices", "triangles", "loops"},
         [](const Points& vertices, const Triangles& triangles, const std::vector<Indices>& loops) {
             std::vector<bool> result;
             for (const LoopShape& shape : shapes_of(vertices, triangles, loops)) result.push_back(is_outer(shape));
             return result;
         });
    bind(module, "expected_fill", {"vertices", "triangles", "loops", "bridge", "spacing"},
         [](const Points& vertices, const Triangles& triangles, const std::vector<Indices>& loops, bool bridge,
            double spacing) { return expected_count(shapes_of(vertices, triangles, loops), spacing, bridge); });
    py::class_<PythonHoles>(module, "Holes", py::module_local())
        .def(py::init<Points, const Triangles&, const VertexPairs&, const Named&, bool, int>(), py::arg("vertices"),
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
