#include "fill/harmonic_values.h"

#include "geometry/cotangent.h"
#include "geometry/face_geometry.h"
#include "operators/laplace_operator.h"

namespace fairing {

std::optional<Eigen::MatrixXd> harmonic_values(const Patch& patch, const Points& points, const Eigen::MatrixXd& given) {
    const int free_count = patch.free_count;
    if (free_count == 0 || given.rows() == 0) return Eigen::MatrixXd::Zero(free_count, given.cols());
    FaceGeometry faces;
    faces.update(points, patch.triangles);
    Stiffness stiffness;
    stiffness.update(faces, patch);
    stiffness.weights = stiffness.weights.cwiseMax(least_harmonic_weight);
    LaplaceOperator laplace(patch, points.leftCols(free_count));
    if (!laplace.update(stiffness, Progress())) return std::nullopt;
    Eigen::MatrixXd everywhere = Eigen::MatrixXd::Zero(given.cols(), patch.vertex_count());
    everywhere.rightCols(given.rows()) = given.transpose();
    return -laplace.solve(stiffness.apply(patch, everywhere, free_count).transpose());
}

}  // namespace fairing
