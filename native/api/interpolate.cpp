#include "api/interpolate.h"

#include "api/component.h"
#include "base/errors.h"
#include "fairness/harmonic_values.h"
#include "mesh/pieces.h"

namespace fairing {

namespace {

// Of `values` (a row for each vertex of the mesh), at these vertices.
Eigen::MatrixXd rows_at(const Eigen::MatrixXd& values, std::span<const int> vertices) {
    Eigen::MatrixXd result(static_cast<Eigen::Index>(vertices.size()), values.cols());
    for (std::size_t k = 0; k < vertices.size(); ++k)
        result.row(static_cast<Eigen::Index>(k)) = values.row(vertices[k]);
    return result;
}

}  // namespace

Eigen::MatrixXd interpolate(const MeshInput& input, const Eigen::MatrixXd& given) {
    const CheckedMesh mesh = check_mesh(input);
    Eigen::MatrixXd values = Eigen::MatrixXd::Zero(input.vertices.cols(), given.cols());
    for (Eigen::Index k = 0; k < given.rows(); ++k) values.row((*input.fixed)[static_cast<int>(k)]) = given.row(k);
    for (const Patch& patch : make_patches(mesh.cut, mesh.roles)) {
        const Points points = gather(input.vertices, patch.to_input);
        const auto inside = harmonic_values(patch, points, rows_at(values, fixed_vertices(patch)));
        if (!inside) throw SolverError("the values could not be continued: the mesh has triangles without area");
        for (int v = 0; v < patch.free_count; ++v) values.row(patch.to_input[v]) = inside->row(v);
    }
    return values;
}

}  // namespace fairing
