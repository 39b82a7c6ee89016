#include "api/hole_job.h"
#include "api/soft_base.h"
#include "base/parallel.h"
#include "bindings/bind.h"
#include "bindings/topics.h"
#include "boundary/boundary_fit.h"
#include "boundary/fair_border.h"
#include "boundary/fair_curve.h"
#include "boundary/feather.h"
#include "boundary/fitted_boundary.h"
#include "detail/low_pass.h"
#include "geometry/hard_edges.h"

namespace fairing::bindings {

namespace {

using namespace py::literals;

py::dict to_dict(const SurroundingNormals& result) {
    return py::dict("normals"_a = result.normals, "fitted"_a = result.fitted, "errors"_a = result.errors,
                    "curvatures"_a = result.curvatures, "curvature_errors"_a = result.curvature_errors,
                    "trusted_curvatures"_a = trusted_curvatures(result));
}

}  // namespace

void bind_boundary(py::module_& module) {
    bind(module, "surrounding_normals", &surrounding_normals, &to_dict);
    bind(
        module, "boundary_normals",
        [](const Points& vertices, const Triangles& inside, const Triangles& outside, const Indices& at,
           const VertexPairs& creases, bool all_inside) {
            return boundary_normals({vertices, inside, outside}, at, creases,
                                    all_inside ? SideRule::inside : SideRule::automatic);
        },
        [](const BoundaryNormals& found) {
            py::dict dict = to_dict(found.normals);
            dict["from_inside"] = found.from_inside;
            return dict;
        });
    bind(module, "bad_outline", [](const Points& vertices, const Triangles& outside, const Indices& boundary) {
        Indices bad = bad_vertices(fit_surroundings(vertices, outside, boundary));
        for (int& place : bad) place = boundary[place];
        return bad;
    });
    bind(module, "mend_outline", &fitted_boundary, [](const FittedBoundary& result) {
        py::dict dict = to_dict(result.normals);
        dict["vertices"] = result.vertices;
        dict["moved"] = result.moved;
        dict["held"] = result.held;
        return dict;
    });
    bind(module, "curvatures_around",
         [](const Points& vertices, const Triangles& inside, const Triangles& outside, const Indices& fixed,
            const MaybePoints& normals) { return curvatures_around({vertices, inside, fixed, normals}, outside); });
    bind(module, "hard_edges", &hard_edges);
    bind(module, "feather_weights", &feather_weights);
    bind(
        module, "soft_base",
        [](const ProgressCallback& progress, const Points& vertices, const Triangles& triangles, const Indices& fixed,
           const Points& base, const std::vector<char>& faired, const std::tuple<double, double, double>& sizes,
           int threads) {
            const Threads team(threads);
            const auto [detail, diameter, width] = sizes;
            const MeshInput mesh{vertices, triangles, fixed, {}};
            return soft_base({mesh, base, faired}, {detail, diameter, width}, progress);
        },
        [](const SoftBase& result) { return py::make_tuple(result.base, result.soft); });
    bind(module, "denoised",
         [](const ProgressCallback& progress, const Points& vertices, const Triangles& triangles, const Indices& fixed,
            const VectorX& sizes, int threads) {
             const Threads team(threads);
             return denoised({vertices, triangles, fixed}, sizes, Progress(progress));
         });
    // Positions and directions: rows of the beginning and the end.
    bind(module, "fair_curve", [](const Points& places, const Points& directions, const VectorX& shares) {
        return fair_curve({places.col(0), directions.col(0)}, {places.col(1), directions.col(1)}, shares);
    });
    bind(module, "chain_end", &end_of_chain,
         [](const ChainEnd& end) { return py::make_tuple(Points(end.direction), Points(end.curvature)); });
}

}  // namespace fairing::bindings
