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
struct PythonHoles {
    Points vertices;
    HoledMesh mesh;
    Holes found;

    PythonHoles(Points points, const Triangles& triangles, const VertexPairs& marked, const Named& named, bool bridge)
        : vertices(std::move(points)),
          mesh(BorderedMesh{vertices, triangles, marked}),
          found(find_holes(mesh, made_of<NamedLoops>(named), bridge)) {}
};

py::list loops_of(const PythonHoles& of) {
    py::list result;
    for (const Hole& hole : of.found.holes) {
        py::list loops;
        for (const BoundaryLoop& loop : hole.loops) loops.append(loop.vertices);
        result.append(loops);
    }
    return result;
}

// Normals of lone loops, the hard edges around, and whether these may continue through them: not where one face closes
// the loop, nor where the border passes a vertex several times, since an edge could end at either pass.
py::list slopes(const PythonHoles& of, double spacing) {
    py::list result;
    for (const Hole& hole : of.found.holes) {
        const BoundaryLoop& loop = hole.loops[0];
        const bool may = !loop.is_pinched && !takes_no_vertex(loop.shape, spacing);
        result.append(py::make_tuple(loop.shape.normals, hole.hard, may));
    }
    return result;
}

py::list left_open(const PythonHoles& of) {
    py::list result;
    for (const LeftOpen& each : of.found.left) result.append(py::make_tuple(each.loop, each.reason, each.is_outer));
    return result;
}

// The warning about outer borders that stay open, if there are any.
std::optional<Diagnostic> outer_left(const PythonHoles& of) {
    std::vector<Indices> loops;
    for (const LeftOpen& each : of.found.left) {
        if (each.is_outer) loops.push_back(each.loop);
    }
    return loops.empty() ? std::nullopt : std::optional(outer_borders_left(loops));
}

std::vector<FilledHole> filled(const ProgressCallback& progress, const PythonHoles* of,
                               const std::vector<std::optional<Through>>& through, const Wishes& wishes,
                               const Options& given) {
    const auto& [bridge, in_rows, joins, spacing, is_even, most] = wishes;
    const FillOptions options{
        given.fair, given.held, joins, bridge, in_rows, spacing, is_even ? Spread::equal : Spread::boundary, most};
    std::vector<std::optional<CurvesThrough>> curves(through.size());
    for (std::size_t k = 0; k < through.size(); ++k) {
        if (through[k]) curves[k] = made_of<CurvesThrough>(*through[k]);
    }
    return fill(of->mesh, of->found.holes, curves, options, progress);
}

py::list all_filled(const std::vector<FilledHole>& holes) {
    py::list result;
    for (const FilledHole& hole : holes) result.append(from_filled(hole));
    return result;
}

std::vector<LoopShape> shapes_of(const Points& vertices, const Triangles& triangles,
                                 const std::vector<Indices>& loops) {
    return loop_shapes(HoledMesh({vertices, triangles}), loops);
}

}  // namespace

void bind_holes(py::module_& module) {
    // `border`: the edges with one triangle, where they are known, the hole on their left.
    bind(
        module, "hole_loops",
        [](const Points& vertices, const Triangles& triangles, const std::optional<BorderSides>& border) {
            return hole_loops(vertices, triangles,
                              border ? *border : border_sides(triangles, static_cast<int>(vertices.cols())));
        },
        [](const HoleLoops& found) { return py::make_tuple(found.loops, found.torn); });
    bind(module, "outer_borders",
         [](const Points& vertices, const Triangles& triangles, const std::vector<Indices>& loops) {
             std::vector<bool> result;
             for (const LoopShape& shape : shapes_of(vertices, triangles, loops)) result.push_back(is_outer(shape));
             return result;
         });
    bind(module, "expected_fill",
         [](const Points& vertices, const Triangles& triangles, const std::vector<Indices>& loops, bool bridge,
            double spacing) { return expected_count(shapes_of(vertices, triangles, loops), spacing, bridge); });
    py::class_<PythonHoles>(module, "Holes", py::module_local())
        .def(py::init(in_run(
            [](const Points& vertices, const Triangles& triangles, const VertexPairs& marked, const Named& named,
               bool bridge, int threads) {
                const Threads team(threads);
                return std::make_unique<PythonHoles>(vertices, triangles, marked, named, bridge);
            },
            ForInit{})))
        .def_property_readonly("loops", &loops_of)
        .def("slopes", &slopes)
        .def_property_readonly("left", &left_open)
        .def_property_readonly("outer", &outer_left)
        // Vertices of the mesh, ascending, and the triangles around a hole in numbers of these.
        .def("around",
             in_run([](const PythonHoles* of,
                       std::size_t hole) { return of->mesh.around(of->found.holes.at(hole).loops[0].vertices); },
                    [](const LocalMesh& local) { return py::make_tuple(local.to_mesh, local.triangles); }))
        .def("fill", in_run(&filled, &all_filled));
}

}  // namespace fairing::bindings
