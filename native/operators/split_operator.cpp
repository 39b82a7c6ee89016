#include "operators/split_operator.h"

namespace fairing {

SplitBiharmonicOperator::SplitBiharmonicOperator(const Patch& patch, const Points& fixed_points, Points layout)
    : laplace_(patch, std::move(layout), Kept::singles), outline_(patch, fixed_points), coupling_(patch) {
    free_mass_.resize(patch.free_count);
    fixed_mass_.resize(fixed_points.cols());
}

bool SplitBiharmonicOperator::update(const Stiffness& stiffness, const Progress& progress) {
    coupling_.update(stiffness);
    free_mass_ = 4.0 * stiffness.mass.head(free_mass_.size());
    fixed_mass_ = 4.0 * stiffness.mass.tail(fixed_mass_.size()).transpose();
    if (!outline_.update(fixed_mass_.transpose()) || !laplace_.update(stiffness, progress)) return false;
    known_.forget();
    beside_outline_ = laplace_.factor().reach(coupling_.beside());
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
    const auto harmonic = [&](const OutlineRow& outline) {
        return factor.solve_vector(coupling_.spread(outline), beside_outline_);
    };
    // Cᵀ S_II⁻¹ 4M_I
    const auto turned = [&](const VectorX& u) {
        return coupling_.gather(factor.solve_vector(u.cwiseProduct(free_mass_), FrontReach(), beside_outline_));
    };
    const auto apply = [&](const OutlineRow& p, OutlineRow& product) {
        product = p.cwiseProduct(fixed_mass_) + turned(harmonic(p));
    };
    const auto precondition = [&](const OutlineRow& r, OutlineRow& z) { z = outline_.approximate_inverse(r); };
    VectorX u = factor.solve_vector(rhs);
    u -= harmonic(known_.solve(turned(u), accuracy, most_cycles, apply, precondition));
    return factor.solve_vector(u.cwiseProduct(free_mass_));
}

}  // namespace fairing
