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
    bind(module, "mean_curvature",
         [](const Points& vertices, const Triangles& triangles, const MaybeIndices& fixed,
            const MaybePoints& fixed_normals, const std::string& normals) {
             return mean_curvature({vertices, triangles, fixed, fixed_normals}, normal_words.value(normals));
         });
    bind(module, "vertex_normals", [](const Points& vertices, const Triangles& triangles, const std::string& normals) {
        return vertex_normals({vertices, triangles, {}, {}}, normal_words.value(normals));
    });
    bind(module, "cotan_laplacian", &cotan_laplacian, [](const MatrixEntries& entries) {
        const auto count = static_cast<Eigen::Index>(entries.values.size());
        return py::make_tuple(entries.rows, entries.columns,
                              VectorX(Eigen::Map<const VectorX>(entries.values.data(), count)));
    });
    bind(module, "components", &component_of_triangles);
    bind(module, "mesh_levels",
         [](const Points& vertices, const Triangles& triangles, const MaybeIndices& fixed, int most) {
             return mesh_levels({vertices, triangles, fixed, {}}, most);
         });
    bind(module, "boundary_loops", [](const Triangles& triangles) {
        return boundary_loops(triangles, triangles.size() > 0 ? triangles.maxCoeff() + 1 : 0);
    });
    bind(module, "turned_triangles", &turned_triangles);
    bind(module, "flipped_triangles",
         [](const Points& vertices, const Triangles& triangles, const MaybeIndices& fixed) {
             return flipped_triangles({vertices, triangles, fixed, {}});
         });
    bind(module, "self_intersections",
         [](const Points& vertices, const Triangles& triangles, const MaybeIndices& near) {
             return near ? crossings_with(triangles, vertices, *near) : crossing_triangles(triangles, vertices);
         });
    bind(module, "conformal_distortion", &conformal_distortion);
    bind(module, "signed_distances", &signed_distances);
    bind(module, "interpolate",
         [](const Points& vertices, const Triangles& triangles, const Indices& fixed, const Eigen::MatrixXd& values) {
             return interpolate({vertices, triangles, fixed, {}}, values);
         });
    bind(module, "crossing_edges", &crossing_edges);
    bind(module, "touching_edges", &touching_edges,
         [](const Touches& found) { return py::make_tuple(found.on_edges, found.pairs); });
}

}  // namespace fairing::bindings
