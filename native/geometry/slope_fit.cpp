#include "geometry/slope_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "geometry/frame.h"

namespace fairing {

namespace {

constexpr double width_of_weights = 0.6;  // over the distance of the farthest point: it counts for 6 % in each row
constexpr double least_pivot = 1e-4;      // of the largest, where the columns are about of one size
constexpr int least_rounds = 3;           // the direction is known from the second one on
constexpr int most_rounds = 10;
constexpr double settled = 1e-12;
constexpr double settled_in_noise = 1e-3;  // standard errors
constexpr double cos_of_widest_turn = 0.5;

// Columns of the system: quadratic and cubic terms, the constant where the centre is free, then x and y; the heights
// stand in the last one.
constexpr Eigen::Index sphere_terms = 1;
constexpr Eigen::Index quadratic_terms = 3;
constexpr Eigen::Index cubic_terms = 4;

Eigen::Index terms_of(Degree degree) {
    if (degree == Degree::sphere) return sphere_terms;
    return degree == Degree::cubic ? quadratic_terms + cubic_terms : quadratic_terms;
}

struct Round {
    Eigen::Vector2d slopes;  // along the frame's u and v
    Eigen::Vector<double, 7> terms;
    double constant;
    double error;
    double scatter;
    double curvature_error;
};

// The axes in which the quadratic terms are written. Where the direction isn't known yet, chords stretch all of them.
struct Axes {
    Vector3 x;
    Vector3 y;
    bool known;
};

// The triangular factor of A = Q R in place of A, above the diagonal and on it, by Householder's reflections. For
// systems this small half of the time of Eigen's would go into its blocks and buffers.
void triangularise(Eigen::MatrixXd& A) {
    const Eigen::Index rows = A.rows();
    for (Eigen::Index j = 0; j < std::min(rows, A.cols()); ++j) {
        auto v = A.col(j).tail(rows - j);
        const double pivot = v[0] > 0.0 ? -v.norm() : v.norm();
        v[0] -= pivot;
        const double scale = -pivot * v[0];  // half of |v|²
        if (!(scale > 0.0)) continue;
        for (Eigen::Index k = j + 1; k < A.cols(); ++k) {
            auto column = A.col(k).tail(rows - j);
            column -= v.dot(column) / scale * v;
        }
        v[0] = pivot;
    }
}

class Fit {
public:
    Fit(const Vector3& centre, std::span<const Vector3> points, Degree degree, Centre at_centre)
        : terms_(terms_of(degree)),
          constants_(at_centre == Centre::free ? 1 : 0),
          offsets_(3, static_cast<Eigen::Index>(points.size()) + constants_),
          system_(offsets_.cols(), terms_ + constants_ + 3) {
        offsets_.rightCols(constants_).setZero();  // the centre itself
        for (std::size_t k = 0; k < points.size(); ++k) {
            offsets_.col(static_cast<Eigen::Index>(k)) = points[k] - centre;
        }
        scale_ = std::sqrt(offsets_.colwise().squaredNorm().maxCoeff());
        if (scale_ > 0.0) offsets_ /= scale_;
        weights_ = (-offsets_.colwise().squaredNorm().array() / (width_of_weights * width_of_weights)).exp();
    }

    [[nodiscard]] bool usable() const { return scale_ > 0.0 && offsets_.cols() > unknowns(); }
    [[nodiscard]] double scale() const { return scale_; }

    // `constant`: c₀ of the round before.
    std::optional<Round> round(const Vector3& normal, const Axes& axes, double constant) {
        for (Eigen::Index k = 0; k < offsets_.cols(); ++k) fill_row(k, normal, axes, constant);
        triangularise(system_);
        return solve();
    }

private:
    [[nodiscard]] Eigen::Index unknowns() const { return terms_ + constants_ + 2; }

    void fill_row(Eigen::Index k, const Vector3& normal, const Axes& axes, double constant) {
        const Vector3 d = offsets_.col(k);
        const double x = axes.x.dot(d);
        const double y = axes.y.dot(d);
        const double height = normal.dot(d);
        const double above = height - constant;
        auto row = system_.row(k);
        if (terms_ == sphere_terms) {
            row[0] = x * x + y * y + above * above;
        } else {
            row.head<3>() << x * x, x * y, y * y;
            if (axes.known) {
                row[0] += above * above;
            } else {
                row.head<3>() *= d.squaredNorm() / std::max(x * x + y * y, 1e-24);
            }
        }
        if (terms_ > quadratic_terms) row.segment<4>(3) << x * x * x, x * x * y, x * y * y, y * y * y;
        row.segment(terms_, constants_).setOnes();
        row.tail<3>() << x, y, height;
        row *= weights_[k];
    }

    // From the triangular factor in place of the system. The slopes are the last unknowns: their covariance needs the
    // last block of the factor only.
    [[nodiscard]] std::optional<Round> solve() const {
        const auto factor = system_.topLeftCorner(unknowns(), unknowns());
        const VectorX pivots = factor.diagonal().cwiseAbs();
        if (!(pivots.minCoeff() > least_pivot * pivots.maxCoeff())) return std::nullopt;
        VectorX solution = system_.col(unknowns()).head(unknowns());
        factor.triangularView<Eigen::Upper>().solveInPlace(solution);
        const Eigen::Matrix2d last = factor.bottomRightCorner<2, 2>();
        const Eigen::Matrix2d inverse = last.triangularView<Eigen::Upper>().solve(Eigen::Matrix2d::Identity());
        const auto spare = static_cast<double>(offsets_.cols() - unknowns());
        const double residual = std::abs(system_(unknowns(), unknowns())) / std::sqrt(spare);
        Round result{solution.tail<2>(),
                     {},
                     constants_ > 0 ? solution[terms_] : 0.0,
                     inverse.norm() * residual,
                     residual / root_mean_square_weight(),
                     error_of_curvature(factor) * residual};
        result.terms.setZero();
        result.terms.head(terms_) = solution.head(terms_);
        if (terms_ == sphere_terms) result.terms[2] = result.terms[0];
        if (!result.slopes.allFinite() || !std::isfinite(result.error)) return std::nullopt;
        return result;
    }

    // Of the sum of the terms of x² and y², for a residual of one.
    template <typename Factor>
    [[nodiscard]] double error_of_curvature(const Factor& factor) const {
        VectorX covariance = VectorX::Zero(unknowns());
        if (terms_ == sphere_terms) {
            covariance[0] = 2.0;
        } else {
            covariance[0] = 1.0;
            covariance[2] = 1.0;
        }
        factor.transpose().template triangularView<Eigen::Lower>().solveInPlace(covariance);
        return covariance.norm();
    }

    [[nodiscard]] double root_mean_square_weight() const {
        return std::sqrt(weights_.squaredNorm() / static_cast<double>(offsets_.cols()));
    }

    Eigen::Index terms_;
    Eigen::Index constants_;
    Points offsets_;  // in units of the farthest
    VectorX weights_;
    Eigen::MatrixXd system_;
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

Axes turned_into(const Vector3& direction, const Vector3& normal) {
    const Vector3 x = (direction - normal.dot(direction) * normal).normalized();
    return {x, normal.cross(x), true};
}

// What a round found, as a fit whose normal it turns.
void take(SlopeFit& fit, const Round& round, const Axes& axes) {
    const double scale = fit.scale;
    fit.normal = (fit.normal - round.slopes.x() * axes.x - round.slopes.y() * axes.y).normalized();
    fit.error = round.error + round.slopes.norm();
    fit.height = scale * round.constant;
    fit.scatter = scale * round.scatter;
    fit.mean_curvature = (round.terms[0] + round.terms[2]) / scale;
    fit.curvature_error = round.curvature_error / scale;
    fit.x = axes.x;
    fit.y = axes.y;
    fit.terms = round.terms;
}

}  // namespace

std::optional<SlopeFit> fit_slopes(const Vector3& centre, std::span<const Vector3> points, const Vector3& start,
                                   Degree degree, Centre at_centre) {
    if (points.empty() || start.isZero()) return std::nullopt;
    Fit fit(centre, points, degree, at_centre);
    if (!fit.usable()) return std::nullopt;
    SlopeFit result{.normal = start, .scale = fit.scale()};
    const Frame first(start);
    Axes axes{first.u, first.v, false};
    double constant = 0.0;
    for (int k = 0; k < most_rounds; ++k) {
        const auto round = fit.round(result.normal, axes, constant);
        if (!round) return std::nullopt;
        const double change = round->slopes.norm() + std::abs(round->constant - constant);
        constant = round->constant;
        const Vector3 direction = most_curved(round->terms, axes);
        take(result, *round, axes);
        axes = turned_into(direction, result.normal);
        if (k + 1 >= least_rounds && change < std::max(settled, settled_in_noise * round->error)) break;
    }
    if (!(result.normal.dot(start) > cos_of_widest_turn)) return std::nullopt;
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
    constexpr int newton_steps = 3;
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
