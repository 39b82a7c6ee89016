#include "geometry/slope_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "geometry/frame.h"

namespace fairing {

namespace {

constexpr double width_of_weights = 0.6;  // over the distance of the farthest point: it counts for 6 % in each row
constexpr double least_pivot = 1e-4;      // of the largest, where the columns are about of one size
constexpr int least_rounds = 3;           // the direction is known from the second one on
constexpr int most_rounds = 10;
constexpr double settled = 1e-12;
constexpr double cos_of_widest_turn = 0.5;

// Columns of the system: quadratic and cubic terms, then x and y; the heights stand in the last one.
constexpr Eigen::Index quadratic_terms = 3;
constexpr Eigen::Index cubic_terms = 4;

struct Round {
    Eigen::Vector2d slopes;     // along the frame's u and v
    Eigen::Vector3d quadratic;  // of x², xy, y²
    double error;
};

// The axes in which the quadratic terms are written. Where the direction isn't known yet, chords stretch all of them.
struct Axes {
    Vector3 x;
    Vector3 y;
    bool known;
};

class Fit {
public:
    Fit(const Vector3& centre, std::span<const Vector3> points, Degree degree)
        : offsets_(3, static_cast<Eigen::Index>(points.size())),
          terms_(degree == Degree::cubic ? quadratic_terms + cubic_terms : quadratic_terms),
          system_(offsets_.cols(), terms_ + 3) {
        for (std::size_t k = 0; k < points.size(); ++k) {
            offsets_.col(static_cast<Eigen::Index>(k)) = points[k] - centre;
        }
        const double scale = std::sqrt(offsets_.colwise().squaredNorm().maxCoeff());
        if (scale > 0.0) offsets_ /= scale;
        usable_ = scale > 0.0 && offsets_.cols() > terms_ + 2;
    }

    [[nodiscard]] bool usable() const { return usable_; }

    std::optional<Round> round(const Vector3& normal, const Axes& axes) {
        for (Eigen::Index k = 0; k < offsets_.cols(); ++k) fill_row(k, offsets_.col(k), normal, axes);
        const Eigen::HouseholderQR<Eigen::Ref<Eigen::MatrixXd>> qr(system_);
        return solve();
    }

private:
    void fill_row(Eigen::Index k, const Vector3& d, const Vector3& normal, const Axes& axes) {
        const double x = axes.x.dot(d);
        const double y = axes.y.dot(d);
        const double height = normal.dot(d);
        auto row = system_.row(k);
        row.head<3>() << x * x, x * y, y * y;
        if (axes.known) {
            row[0] += height * height;
        } else {
            row.head<3>() *= d.squaredNorm() / std::max(x * x + y * y, 1e-24);
        }
        if (terms_ > quadratic_terms) row.segment<4>(3) << x * x * x, x * x * y, x * y * y, y * y * y;
        row.tail<3>() << x, y, height;
        row *= std::exp(-d.squaredNorm() / (width_of_weights * width_of_weights));
    }

    // From the triangular factor in place of the system. The slopes are the last unknowns: their covariance needs the
    // last block of the factor only.
    [[nodiscard]] std::optional<Round> solve() const {
        const Eigen::Index unknowns = terms_ + 2;
        const auto factor = system_.topLeftCorner(unknowns, unknowns);
        const VectorX pivots = factor.diagonal().cwiseAbs();
        if (!(pivots.minCoeff() > least_pivot * pivots.maxCoeff())) return std::nullopt;
        VectorX solution = system_.col(unknowns).head(unknowns);
        factor.triangularView<Eigen::Upper>().solveInPlace(solution);
        const Eigen::Matrix2d last = factor.bottomRightCorner<2, 2>();
        const Eigen::Matrix2d inverse = last.triangularView<Eigen::Upper>().solve(Eigen::Matrix2d::Identity());
        const auto spare = static_cast<double>(offsets_.cols() - unknowns);
        const double residual = system_(unknowns, unknowns);
        Round result{solution.tail<2>(), solution.head<3>(), inverse.norm() * std::abs(residual) / std::sqrt(spare)};
        if (!result.slopes.allFinite() || !std::isfinite(result.error)) return std::nullopt;
        return result;
    }

    Points offsets_;  // in units of the farthest
    Eigen::Index terms_;
    Eigen::MatrixXd system_;
    bool usable_;
};

// The direction of the larger principal curvature, in space.
Vector3 most_curved(const Eigen::Vector3d& quadratic, const Axes& axes) {
    Eigen::Matrix2d form;
    form << quadratic[0], 0.5 * quadratic[1], 0.5 * quadratic[1], quadratic[2];
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

}  // namespace

std::optional<SlopeFit> fit_slopes(const Vector3& centre, std::span<const Vector3> points, const Vector3& start,
                                   Degree degree) {
    if (points.empty() || start.isZero()) return std::nullopt;
    Fit fit(centre, points, degree);
    if (!fit.usable()) return std::nullopt;
    SlopeFit result{start, 0.0};
    const Frame first(start);
    Axes axes{first.u, first.v, false};
    for (int k = 0; k < most_rounds; ++k) {
        const auto round = fit.round(result.normal, axes);
        if (!round) return std::nullopt;
        const Vector3 direction = most_curved(round->quadratic, axes);
        result.normal = (result.normal - round->slopes.x() * axes.x - round->slopes.y() * axes.y).normalized();
        result.error = round->error + round->slopes.norm();
        axes = turned_into(direction, result.normal);
        if (k + 1 >= least_rounds && round->slopes.norm() < settled) break;
    }
    if (!(result.normal.dot(start) > cos_of_widest_turn)) return std::nullopt;
    return result;
}

}  // namespace fairing
