#include "multigrid/tangential_multigrid.h"

#include "linear/conjugate_gradients.h"
#include "multigrid/chebyshev.h"
#include "solver/across.h"

namespace fairing {

namespace {

constexpr int degree = 2;

// Of D⁻¹L where no weight is negative (Gershgorin).
constexpr double largest_eigenvalue = 2.0;

}  // namespace

Field<3> FactorisedLaplacian::cycle(Field<3> r) const {
    r.leftCols(free_count()) = inverse(r.leftCols(free_count()));
    return r;
}

MultigridStep::MultigridStep(const Patch& patch, RingMatrix laplacian, const Points& fixed_points,
                             const Transfer& transfer, const LaplaceCycle& coarser)
    : patch_(patch),
      fixed_points_(fixed_points),
      transfer_(transfer),
      coarser_(coarser),
      laplacian_(std::move(laplacian)) {
    inverse_diagonal_.setZero(patch.vertex_count());
    inverse_diagonal_.head(patch.free_count) =
        laplacian_.diagonal.head(patch.free_count).cwiseMax(1e-300).cwiseInverse().transpose();
}

void MultigridStep::apply(const Field<3>& x, Field<3>& y) const {
    laplacian_.apply<3>(x, y, patch_.free_count);
    y.rightCols(fixed_points_.cols()).setZero();
}

void MultigridStep::smooth(Field<3>& x, Field<3>& r) const {
    chebyshev(x, r, inverse_diagonal_, largest_eigenvalue, degree,
              [&](const Field<3>& z, Field<3>& y) { apply(z, y); });
}

Field<3> MultigridStep::cycle(Field<3> r) const {
    Field<3> x = Field<3>::Zero(3, r.cols());
    smooth(x, r);
    const Field<3> correction = transfer_.prolong<3>(coarser_.cycle(transfer_.restrict<3>(r)));
    x += correction;
    Field<3> y(3, r.cols());
    apply(correction, y);
    r -= y;
    smooth(x, r);
    return x;
}

Points MultigridStep::gradient(const Points& points) const {
    Points result(3, points.cols());
    apply(points, result);
    return result;
}

Points MultigridStep::harmonic_positions() const {
    constexpr double relative_tolerance = 1e-8;
    constexpr int most_cycles = 60;
    Points start = Points::Zero(3, patch_.vertex_count());
    start.rightCols(fixed_points_.cols()) = fixed_points_;
    return conjugate_gradients(
               -gradient(start), relative_tolerance, most_cycles, [&](const Points& p) { return gradient(p); },
               [&](const Points& r) { return cycle(r); })
        .leftCols(patch_.free_count);
}

double MultigridStep::merit(const Points& points, const Points& /*normals*/) const {
    return 0.5 * points.cwiseProduct(gradient(points)).sum();
}

Points MultigridStep::displacement(const Points& points, const Points& normals, int max_cycles) const {
    constexpr double relative_tolerance = 0.05;
    const auto across = [&](Points field) {
        project_across(field.leftCols(patch_.free_count), normals);
        return field;
    };
    return conjugate_gradients(
               across(-gradient(points)), relative_tolerance, max_cycles,
               [&](const Points& p) { return across(gradient(p)); }, [&](const Points& r) { return across(cycle(r)); })
        .leftCols(patch_.free_count);
}

}  // namespace fairing
