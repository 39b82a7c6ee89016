#include "api/fillet.h"
#include "api/fillet_rows.h"
#include "bindings/bind.h"
#include "bindings/topics.h"
#include "fillet/profile.h"
#include "fillet/seam_room.h"
#include "fillet/solid_sides.h"
#include "geometry/hard_edges.h"

namespace fairing::bindings {

namespace {

using namespace py::literals;
// The seams, edges that a fillet does not cross, and widths on the left and on the right.
using Edges = std::tuple<VertexPairs, VertexPairs>;
using Widths = std::tuple<VectorX, VectorX>;

FilletInput input_of(const Points& vertices, const Triangles& triangles, const Edges& edges, const Widths& widths,
                     double spacing, bool through = false) {
    return {vertices, triangles, std::get<0>(edges), std::get<1>(edges), {std::get<0>(widths), std::get<1>(widths)},
            through,  spacing};
}

py::dict from_cut(const FilletCut& cut) {
    py::list eaten;
    for (const EatenPart& part : cut.eaten) eaten.append(py::make_tuple(part.vertices, part.widest, part.held));
    return py::dict("points"_a = cut.mesh.points, "triangles"_a = cut.mesh.triangles, "parent"_a = cut.mesh.parent,
                    "inside"_a = cut.mesh.inside, "weights"_a = cut.weights, "seams"_a = cut.mesh.seams,
                    "line"_a = cut.mesh.line, "spacings"_a = cut.spacings, "boundary"_a = cut.boundary,
                    "normals"_a = cut.normals, "curvatures"_a = cut.curvatures, "corners"_a = cut.corners,
                    "eaten"_a = eaten);
}

py::object from_rows(const std::optional<FilletRows>& rows) {
    if (!rows) return py::none();
    return py::dict("cut"_a = from_cut(rows->cut), "quads"_a = rows->quads, "triangles"_a = rows->triangles,
                    "places"_a = rows->places, "solved"_a = rows->solved, "on_solved"_a = rows->on_solved,
                    "given"_a = rows->given, "on_given"_a = rows->on_given, "on_seam"_a = rows->on_seam);
}

// Vertices, triangles, fixed, normals, before, inside.
using Surface = std::tuple<Points, Triangles, Indices, Points, Points, std::vector<char>>;

}  // namespace

void bind_fillet(py::module_& module) {
    // The usual width, and of each vertex the widest.
    bind(
        module, "seam_room",
        [](const Points& vertices, const Triangles& triangles, const Edges& edges) {
            return seam_room(SeamMesh(vertices, triangles, std::get<0>(edges), std::get<1>(edges)));
        },
        [](const SeamRoom& room) { return py::make_tuple(room.usual, room.widest); });
    bind(module, "on_wrong_side",
         [](const ProgressCallback& progress, const Points& vertices, const Triangles& triangles,
            const VertexPairs& edges, double width, const Points& before, const Points& after) {
             const Progress reported(progress);
             const Checkpoints checkpoints(reported);
             return on_wrong_side(vertices, triangles, edges, width, {before, after});
         });
    bind(module, "drawn_to", &drawn_to);
    bind(module, "least_bent", &least_bent);
    // None where no rows fit.
    bind(
        module, "fillet_rows",
        [](const ProgressCallback& progress, const Points& vertices, const Triangles& triangles, const Edges& edges,
           const Widths& widths, const std::tuple<double, double>& spacings, const std::optional<VertexPairs>& counted,
           const Surface& surface) {
            const auto& [points, faces, fixed, normals, before, inside] = surface;
            return fillet_rows(input_of(vertices, triangles, edges, widths, std::get<0>(spacings)),
                               {std::get<1>(spacings), counted}, {points, faces, fixed, normals, before, inside},
                               progress);
        },
        &from_rows);
    bind(
        module, "cut_fillet",
        [](const ProgressCallback& progress, const Points& vertices, const Triangles& triangles, const Edges& edges,
           const Widths& widths, double spacing, bool through) {
            return cut_fillet(input_of(vertices, triangles, edges, widths, spacing, through), progress);
        },
        &from_cut);
}

}  // namespace fairing::bindings
