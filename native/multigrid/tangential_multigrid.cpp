#include "multigrid/tangential_multigrid.h"

#include "linear/conjugate_gradients.h"
#include "solver/across.h"

namespace fairing {

namespace {

constexpr int smoothing_degree = 2;

// Of D⁻¹L where no weight is negative (Gershgorin).
constexpr double largest_eigenvalue = 2.0;

}  // namespace

void FactorisedLaplacian::cycle(Points& r, Points& x) const {
    x.leftCols(free_count()) = inverse(r.leftCols(free_count()));
    x.rightCols(x.cols() - free_count()).setZero();
}

MultigridStep::MultigridStep(const Patch& patch, RingMatrix laplacian, const Points& fixed_points,
                             const Transfer& transfer, const LaplaceCycle& coarser)
    : patch_(patch),
      fixed_points_(fixed_points),
      transfer_(transfer),
      coarser_(coarser),
      laplacian_(std::move(laplacian)),
      inverse_diagonal_(VectorX::Zero(patch.vertex_count())),
      fine_(3, patch.vertex_count()),
      coarse_r_(3, transfer.coarse_count()),
      coarse_x_(3, transfer.coarse_count()) {
    inverse_diagonal_.head(patch.free_count) =
        laplacian_.diagonal.head(patch.free_count).cwiseMax(1e-300).cwiseInverse();
}

void MultigridStep::apply(const Points& x, Points& y) const {
    laplacian_.apply(x, patch_.free_count, [&](int i, const Vector3& product) { y.col(i) = product; });
    y.rightCols(fixed_points_.cols()).setZero();
}

void MultigridStep::subtract_product(const Points& x, Points& r) const {
    laplacian_.apply(x, patch_.free_count, [&](int i, const Vector3& product) { r.col(i) -= product; });
}

// Steps of the Chebyshev iteration of the fourth kind (Lottes 2022), which needs no lower bound of the spectrum:
// x ← x + p(D⁻¹L) D⁻¹ r, with r kept as the residual of x if wanted.
void MultigridStep::smooth(Points& x, Points& r, Residual last) const {
    Points& z = fine_;
    for (int k = 1; k <= smoothing_degree; ++k) {
        const double keep = k == 1 ? 0.0 : (2.0 * k - 3.0) / (2.0 * k + 1.0);
        const double add = (8.0 * k - 4.0) / (2.0 * k + 1.0) / largest_eigenvalue;
        for_ranges(static_cast<int>(x.cols()), coarse_grain, [&](int begin, int end) {
            for (int i = begin; i < end; ++i) {
                const Vector3 fresh = add * inverse_diagonal_[i] * r.col(i);
                z.col(i) = k == 1 ? fresh : Vector3(keep * z.col(i) + fresh);
                x.col(i) += z.col(i);
            }
        });
        if (k < smoothing_degree || last == Residual::kept) subtract_product(z, r);
    }
}

void MultigridStep::cycle(Points& r, Points& x) const {
    x.setZero();
    smooth(x, r, Residual::kept);
    fine_ = r;
    transfer_.restrict(fine_, coarse_r_);
    coarser_.cycle(coarse_r_, coarse_x_);
    transfer_.prolong(coarse_x_, fine_);
    x += fine_;
    subtract_product(fine_, r);
    smooth(x, r, Residual::left);
}

Points MultigridStep::harmonic_positions() const {
    constexpr double relative_tolerance = 1e-8;
    constexpr int most_cycles = 60;
    Points start = Points::Zero(3, patch_.vertex_count());
    start.rightCols(fixed_points_.cols()) = fixed_points_;
    Points r = Points::Zero(3, patch_.vertex_count());
    subtract_product(start, r);
    Points residual;
    const auto precondition = [&](const Points& field, Points& z) {
        residual = field;
        cycle(residual, z);
    };
    return conjugate_gradients(
               std::move(r), relative_tolerance, most_cycles, [&](const Points& p, Points& q) { apply(p, q); },
               precondition)
        .leftCols(patch_.free_count);
}

double MultigridStep::merit(const Points& points, const Points& /*normals*/) const {
    Points product(3, points.cols());
    apply(points, product);
    return 0.5 * inner_product(points, product);
}

Points MultigridStep::displacement(const Points& points, const Points& normals, int max_cycles) const {
    constexpr double relative_tolerance = 0.05;
    const auto across = [&](Points& field) { project_across(field.leftCols(patch_.free_count), normals); };
    Points r = Points::Zero(3, points.cols());
    subtract_product(points, r);
    across(r);
    Points residual;
    const auto apply_across = [&](const Points& p, Points& product) {
        apply(p, product);
        across(product);
    };
    const auto precondition = [&](const Points& field, Points& z) {
        residual = field;
        cycle(residual, z);
        across(z);
    };
    return conjugate_gradients(std::move(r), relative_tolerance, max_cycles, apply_across, precondition)
        .leftCols(patch_.free_count);
}

}  // namespace fairing
