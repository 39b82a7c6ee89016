#include "multigrid/tangential_multigrid.h"

#include <algorithm>

#include "linear/conjugate_gradients.h"
#include "tangential/across.h"

namespace fairing {

namespace {

constexpr int smoothing_degree = 2;

// Of D⁻¹L where no weight is negative (Gershgorin).
constexpr float largest_eigenvalue = 2.0F;

void project_across(SingleField& field, const SingleField& normals) {
    for_ranges(static_cast<int>(normals.cols()), coarse_grain, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) field.col(i) -= normals.col(i).dot(field.col(i)) * normals.col(i);
    });
}

SingleField to_single(const Points& field, Eigen::Index count, double unit = 1.0) {
    SingleField result = SingleField::Zero(4, count);
    result.topRows<3>() = (field.leftCols(count) / unit).cast<float>();
    return result;
}

}  // namespace

FactorisedLaplacian::FactorisedLaplacian(const Patch& patch, const InnerWeights& weights, const Points& fixed_points,
                                         const Progress& progress)
    : SymmetricStep(patch, weights, fixed_points, progress) {
    for (const WeightedEdge& edge : weights) scale_ = std::max(scale_, edge.weight);
}

void FactorisedLaplacian::cycle(SingleField& r, SingleField& x) const {
    x.setZero();
    const Points field = r.topLeftCorner(3, free_count()).cast<double>();
    x.topLeftCorner(3, free_count()) = (scale_ * inverse(field)).cast<float>();
}

MultigridStep::MultigridStep(const Patch& patch, RingMatrix laplacian, const Points& fixed_points,
                             Restriction restriction, const LaplaceCycle& coarser)
    : patch_(patch),
      fixed_points_(fixed_points),
      restriction_(std::move(restriction)),
      coarser_(coarser),
      laplacian_(std::move(laplacian)),
      inverse_diagonal_(Eigen::VectorXf::Zero(patch.vertex_count())),
      coarse_r_(4, restriction_.transfer().coarse_count()),
      coarse_x_(4, restriction_.transfer().coarse_count()) {
    inverse_diagonal_.head(patch.free_count) =
        laplacian_.diagonal.head(patch.free_count).cwiseMax(1e-30F).cwiseInverse();
}

// −L x over the scale at all vertices, 0 at fixed ones.
Points MultigridStep::pull(const Points& points) const {
    Points result = Points::Zero(3, points.cols());
    laplacian_.apply(points, patch_.free_count, [&](int i, const Vector3& product) { result.col(i) = -product; });
    return result;
}

void MultigridStep::subtract_product(const SingleField& x, SingleField& r) const {
    laplacian_.apply(x, patch_.free_count, [&](int i, const Eigen::Vector4f& product) { r.col(i) -= product; });
}

// Steps of the Chebyshev iteration of the fourth kind (Lottes 2022), which needs no lower bound of the spectrum:
// x ← x + p(D⁻¹L) D⁻¹ r, with r kept as the residual of x if wanted.
void MultigridStep::smooth(SingleField& x, SingleField& r, From start, Residual last) const {
    SingleField& z = fine_;
    for (int k = 1; k <= smoothing_degree; ++k) {
        const auto step = static_cast<float>(k);
        const float keep = (2.0F * step - 3.0F) / (2.0F * step + 1.0F);
        const float add = (8.0F * step - 4.0F) / (2.0F * step + 1.0F) / largest_eigenvalue;
        for_ranges(static_cast<int>(x.cols()), coarse_grain, [&](int begin, int end) {
            for (int i = begin; i < end; ++i) {
                const Eigen::Vector4f fresh = add * inverse_diagonal_[i] * r.col(i);
                const Eigen::Vector4f move = k == 1 ? fresh : Eigen::Vector4f(keep * z.col(i) + fresh);
                z.col(i) = move;
                x.col(i) = k == 1 && start == From::zero ? move : Eigen::Vector4f(x.col(i) + move);
            }
        });
        if (k < smoothing_degree || last == Residual::kept) subtract_product(z, r);
    }
}

void MultigridStep::cycle(SingleField& r, SingleField& x) const {
    fine_.resize(4, x.cols());
    smooth(x, r, From::zero, Residual::kept);
    restriction_.apply(r, static_cast<float>(scale() / coarser_.scale()), fine_, coarse_r_);
    coarser_.cycle(coarse_r_, coarse_x_);
    restriction_.transfer().prolong(coarse_x_, fine_);
    for_ranges(static_cast<int>(x.cols()), coarse_grain,
               [&](int begin, int end) { x.middleCols(begin, end - begin) += fine_.middleCols(begin, end - begin); });
    subtract_product(fine_, r);
    smooth(x, r, From::given, Residual::left);
}

// d with L d = scale · pull; across the normals if there are any, as `pull` is then. In units of its own, far from the
// limits of single precision.
MultigridStep::Moves MultigridStep::solve(const Points& pull, const Planes* planes, const Effort& effort) const {
    const double unit = pull.cwiseAbs().maxCoeff();
    if (!(unit > 0.0)) return {Points::Zero(3, patch_.free_count), true};
    SingleField residual;
    const auto apply = [&](const SingleField& p, SingleField& product) {
        laplacian_.apply(p, patch_.free_count, [&](int i, const Eigen::Vector4f& value) { product.col(i) = value; });
        product.rightCols(fixed_points_.cols()).setZero();
        if (!planes) return;
        add_turning(planes->turns, p, product);
        project_across(product, planes->normals);
    };
    const auto precondition = [&](const SingleField& field, SingleField& z) {
        residual = field;
        cycle(residual, z);
        if (planes) project_across(z, planes->normals);
    };
    const auto [x, positive] = conjugate_gradients(to_single(pull, pull.cols(), unit), effort.tolerance,
                                                   effort.max_cycles, apply, precondition);
    fine_.resize(4, 0);  // others need the room until the next solve
    return {unit * x.topLeftCorner(3, patch_.free_count).cast<double>(), positive};
}

// What single precision leaves is solved for again.
Points MultigridStep::harmonic_positions() const {
    constexpr double tolerance = 1e-8;
    constexpr Effort each_time{1e-3, 30};
    constexpr int most_times = 8;
    Points points = Points::Zero(3, patch_.vertex_count());
    points.rightCols(fixed_points_.cols()) = fixed_points_;
    Points r = pull(points);
    const double first = r.norm();
    for (int k = 0; k < most_times && r.norm() > tolerance * first; ++k) {
        points.leftCols(patch_.free_count) += solve(r, nullptr, each_time).d;
        r = pull(points);
    }
    return points.leftCols(patch_.free_count);
}

double MultigridStep::merit(const Points& points, const Points& /*normals*/) const {
    return -0.5 * scale() * inner_product<Points>(points, pull(points));
}

double MultigridStep::imbalance(const Points& points, const Points& normals) const {
    Points across = pull(points);
    project_across(across.leftCols(patch_.free_count), normals);
    return scale() * across.norm();
}

Points MultigridStep::displacement(const Points& points, const TangentPlanes& planes, Effort effort) const {
    return displacement(TurningPlanes{points, planes.normals, planes.shapes ? *planes.shapes : ShapeOperators()},
                        effort);
}

Points MultigridStep::displacement(TurningPlanes&& gone, Effort effort) const {
    TurningPlanes planes = std::move(gone);
    // In double precision: along the normals the pull is far larger than what steps towards the solution leave across.
    Points across = pull(planes.points);
    planes.points.resize(3, 0);
    Planes singles{to_single(planes.normals, patch_.free_count),
                   turning(std::move(planes.shapes), planes.normals, across)};
    project_across(across.leftCols(patch_.free_count), planes.normals);
    planes.normals.resize(3, 0);
    Moves moves = solve(across, &singles, effort);
    if (moves.positive || singles.turns.cols() == 0) return std::move(moves.d);
    singles.turns.resize(6, 0);
    return solve(across, &singles, effort).d;
}

}  // namespace fairing
