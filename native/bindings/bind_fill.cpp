#include "api/remesh.h"
#include "bindings/bind.h"
#include "bindings/topics.h"
#include "bindings/words.h"
#include "fill/conformal_map.h"
#include "fill/joined_loops.h"
#include "fill/proportion.h"
#include "fill/quads.h"

namespace fairing::bindings {

namespace {

using namespace py::literals;

// Spacing, or one of each vertex; whether one length holds everywhere, and whether the old triangles are flat.
using Wanted = std::tuple<std::variant<double, VectorX>, bool, bool>;

WantedLengths to_lengths(const Wanted& wanted) {
    const auto& [spacing, even, flat] = wanted;
    const Spread spread = even ? Spread::equal : Spread::boundary;
    if (const auto* each = std::get_if<VectorX>(&spacing)) return {0.0, 0, spread, *each, flat};
    return {std::get<double>(spacing), 0, spread, {}, flat};
}

// Fixed vertices on creases, and on smooth curves.
using FreeSlopes = std::pair<Indices, Indices>;

}  // namespace

void bind_fill(py::module_& module) {
    bind(
        module, "remesh",
        [](const ProgressCallback& progress, const Points& vertices, const Triangles& triangles,
           const MaybeIndices& fixed, const MaybePoints& fixed_normals, const FreeSlopes& free_slopes,
           const VertexPairs& kept, const Wanted& wanted, int threads) {
            const MeshInput input{
                vertices, triangles, fixed, fixed_normals, {}, {}, {free_slopes.first, free_slopes.second}};
            return remesh(input, kept, to_lengths(wanted), threads, progress);
        },
        [](const NewMesh& mesh) {
            return py::dict("vertices"_a = mesh.vertices, "normals"_a = mesh.normals, "triangles"_a = mesh.triangles,
                            "triangle"_a = mesh.triangle, "weights"_a = mesh.weights, "old"_a = mesh.old);
        });
    bind(module, "expected_count",
         [](const Points& vertices, const Triangles& triangles, const MaybeIndices& fixed,
            const MaybePoints& fixed_normals, const Wanted& wanted) {
             return expected_remesh_count({vertices, triangles, fixed, fixed_normals}, to_lengths(wanted));
         });
    bind(module, "refuse_large", [](double count, double flat, int most, const Indices& around) {
        Limit::of(flat, most).check(count, around);
        return count;
    });
    bind(
        module, "fill_loops",
        [](const ProgressCallback& progress, const Points& vertices, const std::vector<Indices>& loops,
           const std::vector<Points>& normals, bool bridge, const std::string& equation) {
            SolverOptions options;
            options.equation = equation_words.value(equation);
            return fill_loops({vertices, loops, normals}, bridge, options, progress);
        },
        [](const NewSurface& surface) {
            return py::dict("vertices"_a = surface.vertices, "triangles"_a = surface.triangles,
                            "converged"_a = surface.converged);
        });
    bind(module, "conformal_map", &conformal_map);
    bind(module, "triangulated", &triangulated_faces);
    bind(module, "paired_quads", &paired_quads,
         [](const PairedQuads& paired) { return py::make_tuple(paired.quads, paired.pairs, paired.rest); });
}

}  // namespace fairing::bindings
