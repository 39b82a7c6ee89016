#include "api/new_patch.h"
#include "bindings/bind.h"
#include "bindings/fair_options.h"
#include "bindings/topics.h"
#include "boundary/hard_paths.h"
#include "fill/wire_cells.h"
#include "fillet/first_mesh.h"

namespace fairing::bindings {

namespace {

// Vertices, triangles, fixed vertices with normals and curvatures, triangles outside.
using GivenPatch = std::tuple<Points, Triangles, MaybeIndices, MaybePoints, std::optional<VectorX>, Triangles>;
// Spacing, whether it is the same everywhere, quads, most vertices.
using Wishes = std::tuple<double, bool, bool, int>;

py::dict from_patch(const NewPatch& made) {
    py::dict dict = to_dict(made.report);
    dict["vertices"] = made.vertices;
    dict["triangles"] = made.triangles;
    dict["cut"] = made.is_cut;
    dict["origin"] = py::make_tuple(made.triangle, made.weights);
    dict["old"] = made.old;
    dict["pairs"] = made.pairs;
    return dict;
}

}  // namespace

void bind_meshing(py::module_& module) {
    bind(
        module, "new_patch",
        [](const ProgressCallback& progress, const GivenPatch& given, const VertexPairs& kept, const Options& options,
           const Wishes& wishes) {
            const auto& [vertices, triangles, fixed, normals, curvatures, outside] = given;
            const MeshInput input{vertices, triangles, fixed, normals, curvatures, outside, options.held};
            const auto& [spacing, is_even, in_rows, most] = wishes;
            return new_patch(input, kept,
                             {options.fair, {spacing, 0, is_even ? Spread::equal : Spread::boundary}, in_rows, most},
                             progress);
        },
        &from_patch);
    bind(
        module, "first_mesh",
        [](const Points& vertices, const Triangles& triangles, const std::vector<char>& inside,
           const VertexPairs& seams,
           const VectorX& spacings) { return first_mesh({vertices, triangles, inside, seams}, spacings); },
        [](const FirstMesh& first) {
            return py::make_tuple(first.inside, first.pieces, first.triangles, first.lines);
        });
    bind(module, "wire_cells", &cells_of, [](const WireCells& cells) {
        return py::make_tuple(cells.loops, cells.normals, cells.left_open, cells.rims);
    });
    bind(module, "cells_of_triangles", &cells_of_triangles);
    bind(module, "hard_ways", &hard_paths);
}

}  // namespace fairing::bindings
