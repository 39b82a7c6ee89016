#include "operators/bending.h"

#include <Eigen/Geometry>

#include "geometry/triangle.h"

namespace fairing {

namespace {

Eigen::SparseMatrix<double> laplacian(const Points& points, const Triangles& triangles) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<std::size_t>(12 * triangles.cols()));
    for (const auto t : triangles.colwise()) {
        for (int k = 0; k < 3; ++k) {
            const int i = t[(k + 1) % 3];
            const int j = t[(k + 2) % 3];
            const double weight = 0.5 * cotangent(points.col(i) - points.col(t[k]), points.col(j) - points.col(t[k]));
            entries.insert(entries.end(), {{i, j, -weight}, {j, i, -weight}, {i, i, weight}, {j, j, weight}});
        }
    }
    Eigen::SparseMatrix<double> result(points.cols(), points.cols());
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

VectorX areas_of(const Points& points, const Triangles& triangles) {
    VectorX areas = VectorX::Zero(points.cols());
    for (const auto t : triangles.colwise()) {
        const Vector3 ab = points.col(t[1]) - points.col(t[0]);
        const double third = ab.cross(Vector3(points.col(t[2]) - points.col(t[0]))).norm() / 6.0;
        for (const int v : t) areas[v] += third;
    }
    return areas;
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

Eigen::SparseMatrix<double> columns_of(const Eigen::SparseMatrix<double>& whole, const Indices& picked) {
    std::vector<Eigen::Triplet<double>> choice;
    choice.reserve(picked.size());
    for (const int v : picked) choice.emplace_back(v, static_cast<int>(choice.size()), 1.0);
    Eigen::SparseMatrix<double> chosen(whole.cols(), static_cast<Eigen::Index>(picked.size()));
    chosen.setFromTriplets(choice.begin(), choice.end());
    return whole * chosen;
}

}  // namespace

Bending::Bending(const Points& points, const Triangles& triangles, const Indices& fixed, const VectorX& weights)
    : areas_(areas_of(points, triangles)), whole_(laplacian(points, triangles)) {
    free_ = free_vertices(areas_, fixed);
    rows_ = weights.binaryExpr(areas_, [](double weight, double area) { return area > 0.0 ? weight / area : 0.0; });
    columns_ = columns_of(whole_, free_);
    factor_ = SparseCholesky(points(Eigen::all, free_));
}

bool Bending::factorise(const VectorX& factors, const char* what, const Progress& progress) {
    Eigen::SparseMatrix<double> system = columns_.transpose() * rows_.asDiagonal() * columns_;
    for (Eigen::Index k = 0; k < system.cols(); ++k) system.coeffRef(k, k) += factors[k] * areas_[free_[k]];
    return factor_.factorise(SparseMatrix(system.triangularView<Eigen::Lower>()), what, progress);
}

Points Bending::force(const Points& x, bool slopes_stay) const {
    Eigen::MatrixXd curvature = rows_.asDiagonal() * (whole_ * x.transpose());
    VectorX counted = VectorX::Constant(x.cols(), slopes_stay ? 0.0 : 1.0);
    counted(free_).setOnes();
    curvature = counted.asDiagonal() * curvature;
    return (columns_.transpose() * curvature).transpose();
}

SplitBiharmonicOperator::SplitBiharmonicOperator(const Patch& patch, const Points& fixed_points, Points layout)
    : laplace_(patch, std::move(layout), Kept::singles), boundary_(patch, fixed_points), coupling_(patch) {
    free_mass_.resize(patch.free_count);
    fixed_mass_.resize(fixed_points.cols());
}

bool SplitBiharmonicOperator::update(const Stiffness& stiffness, const Progress& progress) {
    coupling_.update(stiffness);
    free_mass_ = 4.0 * stiffness.mass.head(free_mass_.size());
    fixed_mass_ = 4.0 * stiffness.mass.tail(fixed_mass_.size()).transpose();
    if (!boundary_.update(fixed_mass_.transpose()) || !laplace_.update(stiffness, progress)) return false;
    known_.forget();
    beside_boundary_ = laplace_.factor().reach(coupling_.beside());
    return true;
}

Eigen::MatrixXd SplitBiharmonicOperator::solve_to(const Eigen::MatrixXd& rhs, const Accuracy& accuracy) const {
    Eigen::MatrixXd result(rhs.rows(), rhs.cols());
    for (Eigen::Index k = 0; k < rhs.cols(); ++k) result.col(k) = solve_column(rhs.col(k), accuracy);
    return result;
}

VectorX SplitBiharmonicOperator::solve_column(const VectorX& rhs, const Accuracy& accuracy) const {
    const SparseCholesky& factor = laplace_.factor();
    // S_II⁻¹ C
    const auto harmonic = [&](const BoundaryRow& boundary) {
        return factor.solve_vector(coupling_.spread(boundary), beside_boundary_);
    };
    // Cᵀ S_II⁻¹ 4M_I
    const auto turned = [&](const VectorX& u) {
        return coupling_.gather(factor.solve_vector(u.cwiseProduct(free_mass_), FrontReach(), beside_boundary_));
    };
    const auto apply = [&](const BoundaryRow& p, BoundaryRow& product) {
        product = p.cwiseProduct(fixed_mass_) + turned(harmonic(p));
    };
    const auto precondition = [&](const BoundaryRow& r, BoundaryRow& z) { z = boundary_.approximate_inverse(r); };
    VectorX u = factor.solve_vector(rhs);
    u -= harmonic(known_.solve(turned(u), accuracy, most_cycles, apply, precondition));
    return factor.solve_vector(u.cwiseProduct(free_mass_));
}

}  // namespace fairing
