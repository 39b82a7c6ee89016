#include "multigrid/biharmonic_multigrid.h"

#include <cmath>

#include "multigrid/chebyshev.h"

namespace fairing {

namespace {

constexpr int degree = 4;
constexpr int evenings = 2;
constexpr int coarse_steps = 2;
// Of the residual in the preconditioner's norm: looser, the smoothest parts of a step would be missed, and with them the
// end of the iteration.
constexpr double relative_tolerance = 0.05;
constexpr int most_cycles = 40;

}  // namespace

Field<1> FactorisedBiharmonic::approximate_inverse(Field<1> r) const {
    r.leftCols(free_count_) = solve(r.leftCols(free_count_).transpose()).transpose();
    return r;
}

MultigridBiharmonic::MultigridBiharmonic(const Patch& patch, const Transfer& transfer, std::vector<double> weights,
                                         const BiharmonicCycle& coarser)
    : patch_(patch), transfer_(transfer), weights_(std::move(weights)), coarser_(coarser) {
    stiffness_.set_pattern(patch);
}

bool MultigridBiharmonic::update(const Stiffness& stiffness, const Progress& progress) {
    progress_ = progress.here();
    stiffness_.set_weights(patch_, stiffness.weights);
    mass_factor_ = 0.25 * stiffness.mass.cwiseInverse().transpose();
    inverse_diagonal_.setZero(patch_.vertex_count());
    inverse_laplacian_.setZero(patch_.vertex_count());
    for (int i = 0; i < patch_.free_count; ++i) {
        double sum = stiffness_.diagonal[i] * stiffness_.diagonal[i] * mass_factor_[i];
        double absolute = 0.0;
        for (int k = stiffness_.begin[at(i)]; k < stiffness_.begin[at(i) + 1]; ++k) {
            const double weight = stiffness_.weights[k];
            sum += weight * weight * mass_factor_[stiffness_.columns[at(k)]];
            absolute += std::abs(weight);
        }
        if (!(sum > 0.0) || !std::isfinite(sum)) return false;
        inverse_diagonal_[i] = 1.0 / sum;
        inverse_laplacian_[i] = 1.0 / absolute;
    }
    largest_ = largest_eigenvalue();
    return std::isfinite(largest_);
}

void MultigridBiharmonic::apply(const Field<1>& x, Field<1>& y) const {
    Field<1> t(patch_.vertex_count());
    stiffness_.apply<1>(x, t, patch_.vertex_count());
    t.array() *= mass_factor_.array();
    stiffness_.apply<1>(t, y, patch_.free_count);
    y.tail(patch_.vertex_count() - patch_.free_count).setZero();
}

double MultigridBiharmonic::largest_eigenvalue() const {
    constexpr int steps = 10;
    constexpr double margin = 1.1;
    // Any start that is rough everywhere.
    Field<1> x(patch_.vertex_count());
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = static_cast<double>(i * 7919 % 1009) / 1009.0 - 0.5;
    x.tail(patch_.vertex_count() - patch_.free_count).setZero();
    Field<1> y(x.size());
    double estimate = 1.0;
    for (int k = 0; k < steps; ++k) {
        x /= std::sqrt((x.array().square()).sum());
        apply(x, y);
        y.array() *= inverse_diagonal_.array();
        estimate = y.norm();
        x.swap(y);
    }
    return margin * estimate;
}

void MultigridBiharmonic::smooth(Field<1>& x, Field<1>& r) const {
    chebyshev(x, r, inverse_diagonal_, largest_, degree, [&](const Field<1>& z, Field<1>& y) { apply(z, y); });
}

// f ← f − ½ D⁻¹ S f.
void MultigridBiharmonic::even_out(Field<1>& field) const {
    Field<1> product = Field<1>::Zero(field.size());
    stiffness_.apply<1>(field, product, patch_.free_count);
    field.array() -= 0.5 * inverse_laplacian_.array() * product.array();
}

void MultigridBiharmonic::even_out_transposed(Field<1>& field) const {
    const Field<1> scaled = field.array() * inverse_laplacian_.array();
    Field<1> product = Field<1>::Zero(field.size());
    stiffness_.apply<1>(scaled, product, patch_.free_count);
    field -= 0.5 * product;
}

Field<1> MultigridBiharmonic::coarse_correction(const Field<1>& r) const {
    Field<1> rough = r;
    for (int k = 0; k < evenings; ++k) even_out_transposed(rough);
    Field<1> correction = transfer_.prolong<1>(
        coarser_.approximate_inverse(transfer_.restrict<1>(std::move(rough), weights_)), weights_);
    for (int k = 0; k < evenings; ++k) even_out(correction);
    return correction;
}

Field<1> MultigridBiharmonic::cycle(Field<1> r) const {
    Field<1> x = Field<1>::Zero(r.size());
    smooth(x, r);
    const Field<1> correction = coarse_correction(r);
    x += correction;
    Field<1> y(r.size());
    apply(correction, y);
    r -= y;
    smooth(x, r);
    return x;
}

Field<1> MultigridBiharmonic::approximate_inverse(Field<1> r) const {
    Field<1> x = Field<1>::Zero(r.size());
    Field<1> p = cycle(r);
    Field<1> Kp(r.size());
    for (int k = 1;; ++k) {
        apply(p, Kp);
        const double curvature = p.dot(Kp);
        if (!(curvature > 0.0)) return x;
        const double alpha = r.dot(p) / curvature;
        x += alpha * p;
        if (k == coarse_steps) return x;
        r -= alpha * Kp;
        const Field<1> z = cycle(r);
        p = z - (z.dot(Kp) / curvature) * p;
    }
}

// Conjugate gradients; flexible ones, since the cycle isn't a fixed operator.
VectorX MultigridBiharmonic::solve_column(const VectorX& rhs) const {
    Field<1> r = Field<1>::Zero(patch_.vertex_count());
    r.head(patch_.free_count) = rhs.transpose();
    Field<1> x = Field<1>::Zero(r.size());
    Field<1> z = cycle(r);
    Field<1> p = z;
    Field<1> Kp(r.size());
    double rz = r.dot(z);
    const double target = relative_tolerance * relative_tolerance * rz;
    for (int k = 0; k < most_cycles && rz > target && std::isfinite(rz); ++k) {
        progress_.report(0.0, "multigrid");
        apply(p, Kp);
        const double curvature = p.dot(Kp);
        const double alpha = r.dot(p) / curvature;
        x += alpha * p;
        r -= alpha * Kp;
        z = cycle(r);
        rz = r.dot(z);
        p = z - (z.dot(Kp) / curvature) * p;
    }
    return x.head(patch_.free_count).transpose();
}

Eigen::MatrixXd MultigridBiharmonic::solve(const Eigen::MatrixXd& rhs) const {
    Eigen::MatrixXd result(rhs.rows(), rhs.cols());
    for (Eigen::Index c = 0; c < rhs.cols(); ++c) result.col(c) = solve_column(rhs.col(c));
    return result;
}

}  // namespace fairing
