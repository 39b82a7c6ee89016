#include "api/measure.h"
#include "bindings/bind.h"
#include "bindings/topics.h"
#include "bindings/words.h"
#include "geometry/nearest_point.h"
#include "geometry/segments.h"
#include "geometry/self_intersection.h"
#include "mesh/loops.h"
#include "mesh/twins.h"

namespace fairing::bindings {

void bind_measure(py::module_& module) {
    bind(module, "mean_curvature", {"vertices", "triangles", "fixed", "fixed_normals", "normals"},
         [](const Points& vertices, const Triangles& triangles, const MaybeIndices& fixed,
            const MaybePoints& fixed_normals, const std::string& normals) {
             return mean_curvature({vertices, triangles, fixed, fixed_normals}, normal_words.value(normals));
         });
    bind(module, "vertex_normals", {"vertices", "triangles", "normals"},
         [](const Points& vertices, const Triangles& triangles, const std::string& normals) {
             return vertex_normals({vertices, triangles, {}, {}}, normal_words.value(normals));
         });
    bind(
        module, "cotan_laplacian", {"vertices", "triangles"},
        [](const Points& vertices, const Triangles& triangles) { return cotan_laplacian(vertices, triangles); },
        [](const MatrixEntries& entries) {
            const auto count = static_cast<Eigen::Index>(entries.values.size());
            return py::make_tuple(entries.rows, entries.columns,
                                  VectorX(Eigen::Map<const VectorX>(entries.values.data(), count)));
        });
    bind(module, "components", {"triangles", "fixed", "vertex_count"},
         [](const Triangles& triangles, const MaybeIndices& fixed, int vertex_count) {
             return component_of_triangles(triangles, fixed, vertex_count);
         });
    bind(module, "boundary_loops", {"triangles"}, [](const Triangles& triangles) {
        return boundary_loops(triangles, triangles.size() > 0 ? triangles.maxCoeff() + 1 : 0);
    });
    bind(module, "turned_triangles", {"triangles", "vertex_count"},
         [](const Triangles& triangles, int vertex_count) { return turned_triangles(triangles, vertex_count); });
    bind(module, "flipped_triangles", {"vertices", "triangles", "fixed"},
         [](const Points& vertices, const Triangles& triangles, const MaybeIndices& fixed) {
             return flipped_triangles({vertices, triangles, fixed, {}});
         });
    bind(module, "self_intersections", {"vertices", "triangles", "near"},
         [](const Points& vertices, const Triangles& triangles, const MaybeIndices& near) {
             return near ? crossings_with(triangles, vertices, *near) : crossing_triangles(triangles, vertices);
         });
    bind(module, "conformal_distortion", {"reference", "vertices", "triangles"},
         [](const Points& reference, const Points& vertices, const Triangles& triangles) {
             return conformal_distortion(reference, vertices, triangles);
         });
    bind(module, "signed_distances", {"at", "reference", "triangles"},
         [](const Points& at, const Points& reference, const Triangles& triangles) {
             return signed_distances(at, reference, triangles);
         });
    bind(module, "interpolate", {"vertices", "triangles", "fixed", "values"},
         [](const Points& vertices, const Triangles& triangles, const Indices& fixed, const Eigen::MatrixXd& values) {
             return interpolate({vertices, triangles, fixed, {}}, values);
         });
    bind(module, "crossing_edges", {"edges", "vertices"},
         [](const VertexPairs& edges, const Points& vertices) { return crossing_edges(edges, vertices); });
    bind(
        module, "touching_edges", {"edges", "vertices"},
        [](const VertexPairs& edges, const Points& vertices) { return touching_edges(edges, vertices); },
        [](const Touches& found) { return py::make_tuple(found.on_edges, found.pairs); });
}

}  // namespace fairing::bindings
