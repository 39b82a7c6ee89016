#include "fillet/profile.h"

#include <vector>

#include <Eigen/Geometry>
#include <Eigen/SparseCore>

#include "base/errors.h"
#include "geometry/cotangent.h"
#include "linear/sparse_cholesky.h"

namespace fairing {

namespace {

// L (cotangents, ½ (cot α + cot β)) and a third of the triangles' areas at each vertex, 0 without any.
struct Laplacian {
    Eigen::SparseMatrix<double> matrix;
    VectorX areas;
};

Laplacian laplacian(const Points& points, const Triangles& triangles) {
    std::vector<Eigen::Triplet<double>> entries;
    VectorX areas = VectorX::Zero(points.cols());
    for (const auto t : triangles.colwise()) {
        for (int k = 0; k < 3; ++k) {
            const int apex = t[k];
            const int i = t[(k + 1) % 3];
            const int j = t[(k + 2) % 3];
            const Vector3 a = points.col(i) - points.col(apex);
            const Vector3 b = points.col(j) - points.col(apex);
            const double weight = 0.5 * cotangent(a, b);
            entries.insert(entries.end(), {{i, j, -weight}, {j, i, -weight}, {i, i, weight}, {j, j, weight}});
            areas[apex] += a.cross(b).norm() / 6.0;
        }
    }
    Laplacian result{Eigen::SparseMatrix<double>(points.cols(), points.cols()), areas};
    result.matrix.setFromTriplets(entries.begin(), entries.end());
    return result;
}

Indices free_vertices(const VectorX& areas, const Indices& fixed) {
    std::vector<char> held(static_cast<std::size_t>(areas.size()), 0);
    for (const int v : fixed) held[v] = 1;
    Indices free;
    for (int v = 0; v < static_cast<int>(areas.size()); ++v) {
        if (held[v] == 0 && areas[v] > 0.0) free.push_back(v);
    }
    return free;
}

}  // namespace

// With B = x − points, 0 at fixed vertices: (Lᵀ A⁻¹ L + A pull) B = A pull (target − points). The rows of L at fixed
// vertices stay in the sum: they are the flow over the boundary, which a slope there would be.
Points drawn_to(const Points& points, const Triangles& triangles, const Indices& fixed, const Points& target,
                const VectorX& pull) {
    const Laplacian whole = laplacian(points, triangles);
    const Indices free = free_vertices(whole.areas, fixed);
    if (free.empty()) return points;
    const auto count = static_cast<Eigen::Index>(free.size());
    std::vector<Eigen::Triplet<double>> picked;
    picked.reserve(free.size());
    for (Eigen::Index k = 0; k < count; ++k) picked.emplace_back(free[static_cast<std::size_t>(k)], k, 1.0);
    Eigen::SparseMatrix<double> choice(points.cols(), count);
    choice.setFromTriplets(picked.begin(), picked.end());
    const VectorX inverse = whole.areas.unaryExpr([](double area) { return area > 0.0 ? 1.0 / area : 0.0; });
    const Eigen::SparseMatrix<double> columns = whole.matrix * choice;
    const VectorX weights = (whole.areas.cwiseProduct(pull))(free);
    Eigen::SparseMatrix<double> system = columns.transpose() * inverse.asDiagonal() * columns;
    for (Eigen::Index k = 0; k < count; ++k) system.coeffRef(k, k) += weights[k];
    SparseCholesky factor(points(Eigen::all, free));
    if (!factor.factorise(SparseMatrix(system.triangularView<Eigen::Lower>()), "profile", Progress()))
        throw SolverError("the profile could not be changed: the mesh has triangles without area");
    const Points off = (target - points)(Eigen::all, free) * weights.asDiagonal();
    Points result = points;
    result(Eigen::all, free) += factor.solve_points(off);
    return result;
}

}  // namespace fairing
