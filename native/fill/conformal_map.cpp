#include "fill/conformal_map.h"

#include <complex>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include "base/errors.h"
#include "base/limits.h"
#include "geometry/triangle.h"

namespace fairing {

namespace {

using Complex = std::complex<double>;
using ComplexMatrix = Eigen::SparseMatrix<Complex>;

// The sides opposite to a triangle's corners, laid out in the plane counter-clockwise, over the root of four areas:
// the squared modulus of Σ side × place is the triangle's Dirichlet energy minus its area in the map.
std::array<Complex, 3> sides_of(const Vector3& a, const Vector3& b, const Vector3& c) {
    const Vector3 ab = b - a;
    const Vector3 ac = c - a;
    const double length = std::max(ab.norm(), 1e-300);
    const double twice_area =
        safe_twice_area(ab.cross(ac).norm(), std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()}));
    const Complex at_b(length, 0.0);
    const Complex at_c(ab.dot(ac) / length, twice_area / length);
    const double scale = 1.0 / std::sqrt(2.0 * twice_area);
    return {scale * (at_c - at_b), -scale * at_c, scale * at_b};
}

// The energy of the map as a form of all vertices' places.
ComplexMatrix energy(const Points& points, const Triangles& triangles) {
    std::vector<Eigen::Triplet<Complex>> entries;
    entries.reserve(static_cast<std::size_t>(9 * triangles.cols()));
    for (const auto corners : triangles.colwise()) {
        const auto sides = sides_of(points.col(corners[0]), points.col(corners[1]), points.col(corners[2]));
        for (int i = 0; i < 3; ++i) {
            for (int k = 0; k < 3; ++k) entries.emplace_back(corners[i], corners[k], std::conj(sides[i]) * sides[k]);
        }
    }
    ComplexMatrix form(points.cols(), points.cols());
    form.setFromTriplets(entries.begin(), entries.end());
    return form;
}

// A column for each vertex that is not fixed, with a one in its row.
ComplexMatrix free_ones(Eigen::Index count, const Indices& fixed) {
    std::vector<char> is_fixed(static_cast<std::size_t>(count), 0);
    for (const int v : fixed) is_fixed[v] = 1;
    std::vector<Eigen::Triplet<Complex>> ones;
    for (int v = 0; v < count; ++v) {
        if (is_fixed[v] == 0) ones.emplace_back(v, static_cast<int>(ones.size()), 1.0);
    }
    ComplexMatrix matrix(count, static_cast<Eigen::Index>(ones.size()));
    matrix.setFromTriplets(ones.begin(), ones.end());
    return matrix;
}

// Throws where a part of the mesh may turn or grow as it likes: the form has a kernel there.
Eigen::VectorXcd solved(const ComplexMatrix& form, const Eigen::VectorXcd& rhs) {
    const Eigen::SimplicialLDLT<ComplexMatrix> factor(form);
    if (factor.info() == Eigen::Success) {
        const VectorX pivots = factor.vectorD().real();
        if (pivots.minCoeff() > roundoff * pivots.maxCoeff()) return factor.solve(rhs);
    }
    throw SolverError("the map is not determined: a piece of the mesh has no area, or fewer than two fixed vertices");
}

}  // namespace

Eigen::MatrixXd conformal_map(const Points& points, const Triangles& triangles, const Indices& fixed,
                              const Eigen::MatrixXd& given) {
    Eigen::VectorXcd places = Eigen::VectorXcd::Zero(points.cols());
    for (Eigen::Index k = 0; k < given.rows(); ++k) places[fixed[static_cast<int>(k)]] = {given(k, 0), given(k, 1)};
    const ComplexMatrix free = free_ones(points.cols(), fixed);
    if (free.cols() > 0) {
        const ComplexMatrix form = energy(points, triangles);
        places += free * solved(free.transpose() * form * free, -(free.transpose() * (form * places)));
    }
    Eigen::MatrixXd result(points.cols(), 2);
    result << places.real(), places.imag();
    return result;
}

}  // namespace fairing
