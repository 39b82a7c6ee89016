#include "multigrid/tangential_multigrid.h"

#include "linear/conjugate_gradients.h"
#include "tangential/slide.h"

namespace fairing {

namespace {

// The largest eigenvalue of D⁻¹L where no weight is negative (Gershgorin).
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
    laplacian_.apply_singles([&](int j) { return x.col(j); }, patch_.free_count,
                             [&](int i, const Eigen::Vector4f& product) { r.col(i) -= product; });
}

// Two steps of the Chebyshev iteration of the fourth kind (Lottes 2022), which needs no lower bound of the spectrum:
// write(i, p(D⁻¹L) D⁻¹ r there). The first step is made where the second reads it: a large mesh is walked over as fast
// as memory answers.
template <typename Write>
void MultigridStep::smooth(const SingleField& r, const Write& write) const {
    constexpr float first = 4.0F / 3.0F / largest_eigenvalue;  // coefficients of both steps
    constexpr float keep = 1.0F / 5.0F;                        // likewise
    constexpr float add = 12.0F / 5.0F / largest_eigenvalue;   // likewise
    const auto z = [&](int j) { return Eigen::Vector4f(first * inverse_diagonal_[j] * r.col(j)); };
    laplacian_.apply_singles(z, patch_.free_count, [&](int i, const Eigen::Vector4f& product) {
        write(i, (1.0F + keep) * z(i) + add * inverse_diagonal_[i] * (r.col(i) - product));
    });
}

void MultigridStep::cycle(SingleField& r, SingleField& x) const {
    fine_.resize(4, x.cols());
    x.rightCols(fixed_points_.cols()).setZero();
    smooth(r, [&](int i, const Eigen::Vector4f& move) { x.col(i) = move; });
    subtract_product(x, r);
    restriction_.apply(r, static_cast<float>(scale() / coarser_.scale()), fine_, coarse_r_);
    coarser_.cycle(coarse_r_, coarse_x_);
    restriction_.transfer().prolong(coarse_x_, fine_);
    subtract_product(fine_, r);
    smooth(r, [&](int i, const Eigen::Vector4f& move) { x.col(i) += fine_.col(i) + move; });
}

// d with L d = scale · pull; across the normals if there are any, as `pull` is then. In units of its own, far from the
// limits of single precision.
MultigridStep::Moves MultigridStep::solve(const Points& pull, const Planes* planes, const Effort& effort) const {
    const double unit = pull.cwiseAbs().maxCoeff();
    if (!(unit > 0.0)) return {Points::Zero(3, patch_.free_count), true};
    SingleField residual;
    const bool turns = planes && planes->turns.cols() > 0;
    const auto apply = [&](const SingleField& p, SingleField& product) {
        const auto write = [&](int i, Eigen::Vector4f value) {
            if (planes) {
                if (turns) value.head<3>() += turn(planes->turns, i, p.col(i).head<3>());
                value -= planes->normals.col(i).dot(value) * planes->normals.col(i);
            }
            product.col(i) = value;
        };
        laplacian_.apply_singles([&](int j) { return p.col(j); }, patch_.free_count, write);
        product.rightCols(fixed_points_.cols()).setZero();
    };
    const auto precondition = [&](const SingleField& field, SingleField& z) {
        residual = field;
        cycle(residual, z);
        if (planes) project_across(z, planes->normals);
    };
    const auto found = conjugate_gradients(to_single(pull, pull.cols(), unit), effort.tolerance, effort.max_cycles,
                                           apply, precondition);
    fine_.resize(4, 0);  // others need the room until the next solve
    return {unit * found.x.topLeftCorner(3, patch_.free_count).cast<double>(), found.positive};
}

// The residual that single precision leaves is solved for again.
Points MultigridStep::harmonic_positions() const {
    constexpr double tolerance = 1e-8;     // of the first residual
    constexpr Effort each_time{1e-3, 30};  // accuracy and cycles in single precision
    constexpr int most_times = 8;          // a bound
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

double MultigridStep::merit(const Points& points) const {
    return -0.5 * scale() * inner_product<Points>(points, pull(points));
}

double MultigridStep::imbalance(const Points& points, const Points& normals) const {
    Points across = pull(points);
    project_across(across.leftCols(patch_.free_count), normals);
    return scale() * across.norm();
}

Points MultigridStep::displacement(const Points& points, const TangentPlanes& planes, Effort effort) const {
    Points across = pull(points);
    Planes singles = project(across, planes.normals, planes.shapes ? *planes.shapes : ShapeOperators());
    return solve_across(across, std::move(singles), effort);
}

Points MultigridStep::displacement(TurningPlanes&& temporary, Effort effort) const {
    TurningPlanes planes = std::move(temporary);
    Points across = pull(planes.points);
    planes.points.resize(3, 0);
    Planes singles = project(across, planes.normals, std::move(planes.shapes));
    planes.normals.resize(3, 0);
    return solve_across(across, std::move(singles), effort);
}

// In double precision: along the normals the pull is far larger than what steps towards the solution leave across.
MultigridStep::Planes MultigridStep::project(Points& pull, const Points& normals, ShapeOperators shapes) const {
    Planes planes{to_single(normals, patch_.free_count), turning(std::move(shapes), normals, pull)};
    project_across(pull.leftCols(patch_.free_count), normals);
    return planes;
}

Points MultigridStep::solve_across(const Points& across, Planes planes, Effort effort) const {
    Moves moves = solve(across, &planes, effort);
    if (moves.positive || planes.turns.cols() == 0) return std::move(moves.d);
    planes.turns.resize(6, 0);
    return solve(across, &planes, effort).d;
}

}  // namespace fairing
