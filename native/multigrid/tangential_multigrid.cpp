#include "multigrid/tangential_multigrid.h"

#include <cmath>

#include "multigrid/chebyshev.h"
#include "solver/across.h"

namespace fairing {

namespace {

constexpr int degree = 2;

double inner(const Points& a, const Points& b) { return a.cwiseProduct(b).sum(); }

}  // namespace

Field<3> FactorisedLaplacian::cycle(Field<3> r) const {
    r.leftCols(free_count()) = inverse(r.leftCols(free_count()));
    return r;
}

MultigridStep::MultigridStep(const Patch& patch, const InnerWeights& weights, const Points& fixed_points,
                             const Transfer& transfer, const LaplaceCycle& coarser)
    : patch_(patch), fixed_points_(fixed_points), transfer_(transfer), coarser_(coarser) {
    laplacian_.assemble(patch.vertex_count(), weights);
    inverse_diagonal_.setZero(patch.vertex_count());
    inverse_diagonal_.head(patch.free_count) =
        laplacian_.diagonal.head(patch.free_count).cwiseMax(1e-300).cwiseInverse().transpose();
}

void MultigridStep::apply(const Field<3>& x, Field<3>& y) const {
    laplacian_.apply<3>(x, y, patch_.free_count);
    y.rightCols(fixed_points_.cols()).setZero();
}

void MultigridStep::smooth(Field<3>& x, Field<3>& r) const {
    chebyshev(x, r, inverse_diagonal_, largest_, degree, [&](const Field<3>& z, Field<3>& y) { apply(z, y); });
}

Field<3> MultigridStep::cycle(Field<3> r) const {
    Field<3> x = Field<3>::Zero(3, r.cols());
    smooth(x, r);
    const std::vector<double>& weights = transfer_.removals.weights;
    const Field<3> correction = transfer_.prolong<3>(coarser_.cycle(transfer_.restrict<3>(r, weights)), weights);
    x += correction;
    Field<3> y(3, r.cols());
    apply(correction, y);
    r -= y;
    smooth(x, r);
    return x;
}

// Conjugate gradients within the image of `project`, from r; both over all vertices.
template <typename Project>
Points MultigridStep::solve(Points r, double relative_tolerance, int max_cycles, const Project& project) const {
    Points d = Points::Zero(3, r.cols());
    Points Ap(3, r.cols());
    project(r);
    Points z = cycle(r);
    project(z);
    Points p = z;
    double rz = inner(r, z);
    const double target = relative_tolerance * relative_tolerance * rz;
    for (int k = 0; k < max_cycles && rz > target; ++k) {
        apply(p, Ap);
        project(Ap);
        const double curvature = inner(p, Ap);
        if (!(curvature > 0.0)) break;
        const double alpha = rz / curvature;
        d += alpha * p;
        r -= alpha * Ap;
        z = cycle(r);
        project(z);
        const double next = inner(r, z);
        p = z + (next / rz) * p;
        rz = next;
    }
    return d;
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
    return solve(-gradient(start), relative_tolerance, most_cycles, [](Points&) {}).leftCols(patch_.free_count);
}

double MultigridStep::merit(const Points& points, const Points& /*normals*/) const {
    return 0.5 * inner(points, gradient(points));
}

Points MultigridStep::displacement(const Points& points, const Points& normals, int max_cycles) const {
    constexpr double relative_tolerance = 0.05;
    const auto across = [&](Points& field) {
        for (int i = 0; i < patch_.free_count; ++i) field.col(i) -= normals.col(i).dot(field.col(i)) * normals.col(i);
    };
    return solve(-gradient(points), relative_tolerance, max_cycles, across).leftCols(patch_.free_count);
}

}  // namespace fairing
