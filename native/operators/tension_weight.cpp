#include "operators/tension_weight.h"

#include <limits>

#include <Eigen/Geometry>

namespace fairing {

namespace {

// ∇f at all vertices, the mean of the triangles' by their areas.
Points gradients(const Patch& patch, const Points& points, const VectorX& values) {
    Points sums = Points::Zero(3, points.cols());
    VectorX areas = VectorX::Zero(points.cols());
    for (const auto t : patch.triangles.colwise()) {
        const Vector3 across = (points.col(t[1]) - points.col(t[0])).cross(points.col(t[2]) - points.col(t[0]));
        const double area = across.norm();
        if (!(area > 0.0)) continue;
        Vector3 turned = Vector3::Zero();  // twice the area times the gradient, a quarter turn back
        for (int k = 0; k < 3; ++k) turned += values[t[k]] * (points.col(t[(k + 2) % 3]) - points.col(t[(k + 1) % 3]));
        const Vector3 part = across.cross(turned) / area;
        for (int k = 0; k < 3; ++k) {
            sums.col(t[k]) += part;
            areas[t[k]] += area;
        }
    }
    return sums.array().rowwise() / areas.transpose().array().max(std::numeric_limits<double>::min());
}

// The normal curvature along the boundary loops at the fixed vertices, 0 off them: the second difference of the heights
// of a vertex's two neighbours over its tangent plane.
VectorX curvature_along(const Patch& patch, const Points& fixed_points, const Points& normals) {
    VectorX result = VectorX::Zero(fixed_points.cols());
    for (const Indices& loop : patch.loops()) {
        const std::size_t count = loop.size();
        for (std::size_t k = 0; k < count; ++k) {
            const int here = loop[k] - patch.free_count;
            double rise = 0.0;
            double width = 0.0;
            for (const std::size_t beside : {k + 1, k + count - 1}) {
                const Vector3 d = fixed_points.col(loop[beside % count] - patch.free_count) - fixed_points.col(here);
                rise += d.dot(normals.col(here)) / d.norm();
                width += d.norm();
            }
            result[here] = 2.0 * rise / width;
        }
    }
    return result;
}

}  // namespace

TensionWeight::TensionWeight(const Problem& problem, double share, Points layout)
    : patch_(problem.patch), given_(problem.fixed_points.cols(), 2), laplace_(problem.patch, std::move(layout)) {
    given_.col(0) = share * problem.log_tensions;
    given_.col(1) = 0.5 * curvature_along(patch_, problem.fixed_points, problem.fixed_normals);
}

std::optional<TensionWeight::Values> TensionWeight::on(const Points& points, const Stiffness& stiffness,
                                                       const Progress& progress) {
    if (!laplace_.update(stiffness, progress)) return std::nullopt;
    const int free = patch_.free_count;
    Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(2, points.cols());
    spread.rightCols(given_.rows()) = given_.transpose();
    Eigen::MatrixXd rows(free, 3);
    rows.leftCols(2) = -stiffness.apply(patch_, spread, free).transpose();
    rows.col(2) = 2.0 * stiffness.mass.head(free);
    const Eigen::MatrixXd found = laplace_.factor().solve(rows);
    spread.leftCols(free) = found.leftCols(2).transpose();
    VectorX torsion = VectorX::Zero(points.cols());
    torsion.head(free) = found.col(2);
    const VectorX deep = depth(points, torsion);
    Values values{(3.0 * spread.row(0).transpose().array() * (1.0 - deep.array())).exp(), spread.row(1).transpose()};
    if (!values.weight.allFinite() || !values.straight.allFinite()) return std::nullopt;
    return values;
}

VectorX TensionWeight::depth(const Points& points, const VectorX& torsion) const {
    const VectorX squares = gradients(patch_, points, torsion).colwise().squaredNorm();
    const VectorX whole = torsion + 0.5 * squares;
    return (whole.array() > 0.0).select(torsion.cwiseQuotient(whole), 0.0);
}

}  // namespace fairing
