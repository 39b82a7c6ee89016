#include "geometry/slope_fit.h"

#include <Eigen/Eigenvalues>

#include "geometry/limits.h"
#include "geometry/surface_fit.h"
#include "geometry/triangle.h"

namespace fairing {

namespace {

constexpr double width_of_weights = 0.6;     // over the distance of the farthest point: it counts for 6 % in each row
constexpr double least_pivot = 1e-4;         // of the largest, where the columns are about of one size
constexpr int most_rounds = 10;              // a bound: rounds end when they change nothing
constexpr double converged = 1e-12;          // radians, rounding: the normal has converged
constexpr double converged_in_noise = 1e-3;  // standard errors

// Columns of the system: quadratic and cubic terms, the constant where the centre is free, then x and y; the heights
// stand in the last one.
constexpr int sphere_terms = 1;
constexpr int strip_terms = 2;
constexpr int quadratic_terms = 3;
constexpr int cubic_terms = 4;

int terms_of(Degree degree) {
    if (degree == Degree::sphere) return sphere_terms;
    if (degree == Degree::strip) return strip_terms;
    return degree == Degree::cubic ? quadratic_terms + cubic_terms : quadratic_terms;
}

struct Round {
    Eigen::Vector2d slopes;  // along the frame's u and v
    Eigen::Vector<double, 7> terms;
    double constant;
    double error;
    double scatter;
};

// The axes of the quadratic terms. Until their direction is known, chords stretch all of the terms.
struct Axes {
    Vector3 x;
    Vector3 y;
    bool known;
};

class Fit {
    using Four = TallSystem::Four;
    using Index = TallSystem::Index;

public:
    Fit(const Vector3& centre, std::span<const Vector3> points, Degree degree, Centre at_centre)
        : terms_(terms_of(degree)),
          constants_(at_centre == Centre::free ? 1 : 0),
          count_(static_cast<int>(points.size()) + constants_),
          system_(count_, unknowns() + 1),
          offsets_(4, 3 * system_.fours()),
          weights_(4, system_.fours()) {
        offsets_.setZero();  // as the centre's own row has them
        for (Index k = 0; k < count_ - constants_; ++k) {
            const Vector3 offset = points[static_cast<std::size_t>(k)] - centre;
            for (Index axis = 0; axis < 3; ++axis) offsets_(k % 4, 3 * (k / 4) + axis) = offset[axis];
        }
        for (Index k = 0; k < system_.fours(); ++k) {
            weights_.col(k) =
                offsets_.col(3 * k).square() + offsets_.col(3 * k + 1).square() + offsets_.col(3 * k + 2).square();
        }
        const double farthest = weights_.maxCoeff();  // squared
        scale_ = std::sqrt(farthest);
        if (scale_ > 0.0) offsets_ /= scale_;
        weights_ = (weights_ * (-1.0 / (farthest * width_of_weights * width_of_weights))).exp();
        for (Index k = count_; k < 4 * system_.fours(); ++k) weights_(k % 4, k / 4) = 0.0;
        mean_weight_ = std::sqrt(weights_.square().sum() / count_);
    }

    [[nodiscard]] bool usable() const { return scale_ > 0.0 && count_ > unknowns(); }
    [[nodiscard]] double scale() const { return scale_; }

    // `constant`: c₀ of the round before.
    std::optional<Round> round(const Vector3& normal, const Axes& axes, double constant) {
        for (Index k = 0; k < system_.fours(); ++k) fill_four(k, normal, axes, constant);
        system_.triangularise();
        return solve();
    }

    // The direction in which the points lie farthest apart.
    [[nodiscard]] Vector3 longest_extent() const {
        Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
        for (Index i = 0; i < 3; ++i) {
            for (Index j = 0; j < 3; ++j) {
                for (Index k = 0; k < system_.fours(); ++k)
                    moments(i, j) += (weights_.col(k) * offsets_.col(3 * k + i) * offsets_.col(3 * k + j)).sum();
            }
        }
        return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments).eigenvectors().col(2);
    }

    // How far the points reach to either side of the centre.
    [[nodiscard]] double width(const Vector3& axis) const {
        double widest = 0.0;
        for (Index k = 0; k < system_.fours(); ++k) widest = std::max(widest, along(axis, k).abs().maxCoeff());
        return widest;
    }

    // The standard error of the sum of the terms of x² and y², in the last round.
    [[nodiscard]] double error_of_curvature() const {
        TallSystem::Row covariance = TallSystem::Row::Zero(unknowns());
        covariance[0] = terms_ == sphere_terms ? 2.0 : 1.0;
        if (terms_ >= quadratic_terms) covariance[2] = 1.0;
        return system_.solve_transposed(covariance).norm() * residual();
    }

private:
    [[nodiscard]] int unknowns() const { return terms_ + constants_ + 2; }

    [[nodiscard]] Four along(const Vector3& axis, Index k) const {
        return axis.x() * offsets_.col(3 * k) + axis.y() * offsets_.col(3 * k + 1) + axis.z() * offsets_.col(3 * k + 2);
    }

    void fill_four(Index k, const Vector3& normal, const Axes& axes, double constant) {
        const Four weight = weights_.col(k);
        const Four x = along(axes.x, k);
        const Four y = along(axes.y, k);
        const Four height = along(normal, k);
        const Four above = height - constant;
        const Four squared = x * x + y * y;
        int column = 0;
        const auto add = [&](const Four& values) { system_.set(k, column++, weight * values); };
        if (terms_ == sphere_terms) {
            add(squared + above * above);
        } else if (terms_ == strip_terms) {
            add(x * x + above * above), add(x * y);
        } else if (axes.known) {
            add(x * x + above * above), add(x * y), add(y * y);
        } else {
            const Four stretch = (squared + height * height) / squared.max(1e-24);
            add(stretch * x * x), add(stretch * x * y), add(stretch * y * y);
        }
        if (terms_ > quadratic_terms) add(x * x * x), add(x * x * y), add(x * y * y), add(y * y * y);
        if (constants_ > 0) add(Four::Ones());
        add(x), add(y), add(height);
    }

    [[nodiscard]] double residual() const {
        return std::abs(system_.factor(unknowns(), unknowns())) / std::sqrt(static_cast<double>(count_ - unknowns()));
    }

    // From the triangular factor. The slopes are the last unknowns: their covariance needs the last block of the factor
    // only.
    [[nodiscard]] std::optional<Round> solve() const {
        if (!(system_.least_pivot(unknowns()) > least_pivot)) return std::nullopt;
        const TallSystem::Row solution = system_.solve(unknowns());
        const double first = 1.0 / system_.factor(unknowns() - 2, unknowns() - 2);
        const double last = 1.0 / system_.factor(unknowns() - 1, unknowns() - 1);
        const double beside = -first * last * system_.factor(unknowns() - 2, unknowns() - 1);
        Round result{solution.tail<2>(),
                     {},
                     constants_ > 0 ? solution[terms_] : 0.0,
                     std::sqrt(first * first + beside * beside + last * last) * residual(),
                     residual() / mean_weight_};
        result.terms.setZero();
        result.terms.head(terms_) = solution.head(terms_);
        if (terms_ == sphere_terms) result.terms[2] = result.terms[0];
        if (!result.slopes.allFinite() || !std::isfinite(result.error)) return std::nullopt;
        return result;
    }

    int terms_;
    int constants_;
    int count_;  // of rows
    TallSystem system_;
    Eigen::Array4Xd offsets_;   // x, y, z of each four, in units of the farthest
    Eigen::Array4Xd weights_;   // zero in the rows that fill up the last four
    double mean_weight_ = 0.0;  // root of the mean square
    double scale_ = 0.0;
};

// The direction of the larger principal curvature, in space.
Vector3 most_curved(const Eigen::Vector<double, 7>& terms, const Axes& axes) {
    Eigen::Matrix2d form;
    form << terms[0], 0.5 * terms[1], 0.5 * terms[1], terms[2];
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
    eigen.computeDirect(form);
    const int larger = std::abs(eigen.eigenvalues()[0]) > std::abs(eigen.eigenvalues()[1]) ? 0 : 1;
    const Eigen::Vector2d direction = eigen.eigenvectors().col(larger);
    return direction.x() * axes.x + direction.y() * axes.y;
}

// Uncertainty that a strip leaves: its slope across, and half of its curvature, if it bends across as much as along.
void doubt(SlopeFit& fit, double width) {
    fit.error += std::abs(fit.terms[0]) * width;
    fit.curvature_error += std::abs(fit.mean_curvature);
}

Axes turned_into(const Vector3& direction, const Vector3& normal) {
    const Vector3 x = (direction - normal.dot(direction) * normal).normalized();
    return {x, normal.cross(x), true};
}

// The result of a round as a fit; its slopes turn the normal.
void take(SlopeFit& fit, const Round& round, const Axes& axes) {
    const double scale = fit.scale;
    fit.normal = (fit.normal - round.slopes.x() * axes.x - round.slopes.y() * axes.y).normalized();
    fit.error = round.error + round.slopes.norm();
    fit.height = scale * round.constant;
    fit.scatter = scale * round.scatter;
    fit.mean_curvature = (round.terms[0] + round.terms[2]) / scale;
    fit.bending = (2.0 * round.terms[0] * axes.x * axes.x.transpose() + round.terms[1] * axes.x * axes.y.transpose() +
                   round.terms[1] * axes.y * axes.x.transpose() + 2.0 * round.terms[2] * axes.y * axes.y.transpose()) /
                  scale;
    fit.x = axes.x;
    fit.y = axes.y;
    fit.terms = round.terms;
}

}  // namespace

std::optional<SlopeFit> fit_slopes(const Vector3& centre, std::span<const Vector3> points, const Vector3& start,
                                   Degree wanted, Centre at_centre) {
    if (points.empty() || start.isZero()) return std::nullopt;
    Fit fit(centre, points, wanted, at_centre);
    if (!fit.usable()) return std::nullopt;
    SlopeFit result{.normal = start, .scale = fit.scale()};
    const Frame first(start);
    Axes axes{first.u, first.v, false};
    const bool is_strip = wanted == Degree::strip;
    if (is_strip) axes = turned_into(fit.longest_extent(), start);
    double constant = 0.0;
    for (int k = 0; k < most_rounds; ++k) {
        const auto round = fit.round(result.normal, axes, constant);
        if (!round) return std::nullopt;
        const double change = round->slopes.norm() + std::abs(round->constant - constant);
        constant = round->constant;
        const Vector3 direction = is_strip ? axes.x : most_curved(round->terms, axes);
        take(result, *round, axes);
        axes = turned_into(direction, result.normal);
        if (change < std::max(converged, converged_in_noise * round->error)) break;
    }
    if (!(result.normal.dot(start) > cos_of_widest_turn)) return std::nullopt;
    result.curvature_error = fit.error_of_curvature() / fit.scale();
    if (is_strip) doubt(result, fit.width(result.y));
    return result;
}

SlopeFit::Local SlopeFit::local(const Vector3& offset) const {
    return {x.dot(offset) / scale, y.dot(offset) / scale, (normal.dot(offset) - height) / scale};
}

Vector3 SlopeFit::gradient(const Local& place) const {
    const auto [across, along, above] = place;
    const double slope_x = 2.0 * terms[0] * across + terms[1] * along + 3.0 * terms[3] * across * across +
                           2.0 * terms[4] * across * along + terms[5] * along * along;
    const double slope_y = terms[1] * across + 2.0 * terms[2] * along + terms[4] * across * across +
                           2.0 * terms[5] * across * along + 3.0 * terms[6] * along * along;
    return (1.0 - 2.0 * terms[0] * above) * normal - slope_x * x - slope_y * y;
}

Vector3 SlopeFit::normal_at(const Vector3& offset) const { return gradient(local(offset)).normalized(); }

Vector3 SlopeFit::foot(const Vector3& offset) const {
    constexpr int newton_steps = 3;  // each squares the error
    Vector3 result = offset;
    for (int k = 0; k < newton_steps; ++k) {
        const Local place = local(result);
        const auto [across, along, above] = place;
        const double surface = terms[0] * (across * across + above * above) + terms[1] * across * along +
                               terms[2] * along * along + terms[3] * across * across * across +
                               terms[4] * across * across * along + terms[5] * across * along * along +
                               terms[6] * along * along * along;
        const Vector3 slope = gradient(place);
        result -= scale * (above - surface) / slope.squaredNorm() * slope;
    }
    return result;
}

}  // namespace fairing
