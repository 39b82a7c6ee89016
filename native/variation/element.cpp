#include "variation/element.h"

#include <tuple>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "geometry/triangle.h"

namespace fairing {

namespace {

using Cubic = Eigen::Vector4d;  // C(t, t, t) = c₀ cos³ + c₁ cos² sin + c₂ cos sin² + c₃ sin³
using CubicMatrix = Eigen::Matrix4d;
using PairVector = Eigen::Matrix<double, 6, 1>;
using PairMatrix = Eigen::Matrix<double, 6, 4>;
using Residual = Eigen::Matrix<double, 10, 1>;  // of the cubic's size, then of its fit
using ByPair = Eigen::Matrix<double, 10, 6>;    // derivatives of the residual by what each pair has
using Jacobian = Eigen::Matrix<double, 10, 18>;

// Penalty on the cubic's size in the fit, for stencils at the border with too few pairs (six pairs weigh about 6).
constexpr double ridge = 1e-4;
constexpr double flattest = 1e-6;  // sine of a triangle's angle, share of a pair's length within the plane

// Lᵀ L = Q, cᵀ Q c the mean over all directions of C(t, t, t)² = (A cos θ + B sin θ + …cos 3θ + …sin 3θ)²; the rows
// give A, B and the other two, by √½ each.
CubicMatrix mean_square_root() {
    CubicMatrix root;
    root << 3.0, 0.0, 1.0, 0.0,  //
        0.0, 1.0, 0.0, 3.0,      //
        1.0, 0.0, -1.0, 0.0,     //
        0.0, 1.0, 0.0, -1.0;
    return std::sqrt(0.5) / 4.0 * root;
}

const CubicMatrix& root_of_mean_square() {
    static const CubicMatrix root = mean_square_root();
    return root;
}

// A pair of the stencil in the plane of its triangle.
struct Pair {
    int i, j;       // places in the stencil
    Vector3 along;  // x_j − x_i
    double length;
    Eigen::Vector2d in_plane;
    double across;      // component along the triangle's normal
    double derivative;  // of the normal curvature
};

// Two unit vectors across the normal of each vertex (geometry/triangle.h).
struct Frames {
    Eigen::Matrix<double, 3, 6> u, v;
};

class Element {
public:
    Element(const Sheet& sheet, const Stencil& stencil, const ElementWeights& weights)
        : root_(root_of_mean_square()), root_of_misfit_(std::sqrt(weights.misfit)) {
        root_.topRows<2>() *= std::sqrt(weights.lean);
        for (std::size_t k = 0; k < stencil_size; ++k) {
            present_[k] = stencil[k] != none;
            if (!present_[k]) continue;
            x_.col(static_cast<Eigen::Index>(k)) = sheet.points.col(stencil[k]);
            n_.col(static_cast<Eigen::Index>(k)) = sheet.normals.col(stencil[k]);
        }
        measure_triangle();
        for (const auto& [i, j] : stencil_pairs) {
            if (present_[j]) add_pair(i, j);
        }
        fit();
    }

    [[nodiscard]] ElementSums sums() const { return {residual_.squaredNorm(), area_}; }

    [[nodiscard]] LocalCubic cubic() const { return {cubic_, e1_, e2_}; }

    [[nodiscard]] ElementTerms terms(const ElementSums& factors) const {
        ElementTerms result;
        const ByPair by_derivative = residual_by_derivative();
        const Frames frames = own_frames();
        const Jacobian J = jacobian(by_derivative, frames);
        result.area_gradient = area_by_motion();
        result.gradient = 2.0 * factors.variation * (J.transpose() * residual_) + factors.area * result.area_gradient;
        result.stretching = 2.0 * factors.variation * J.transpose().lazyProduct(J);
        add_area(factors.area, result.stretching);
        const PairVector g = 2.0 * factors.variation * (by_derivative.transpose() * residual_);
        for (int p = 0; p < count_; ++p) add_bending(pairs_[p], g[p] * scale(pairs_[p]), frames, result.bending);
        return result;
    }

    [[nodiscard]] ElementVector gradient(const ElementSums& factors) const {
        const Jacobian J = jacobian(residual_by_derivative(), own_frames());
        return 2.0 * factors.variation * (J.transpose() * residual_) + factors.area * area_by_motion();
    }

    [[nodiscard]] ElementVector acceleration(const Element& there, const ElementVector& motions, double share) const {
        const Jacobian J = jacobian(residual_by_derivative(), own_frames());
        return 4.0 / (share * share) * (J.transpose() * (there.residual_ - residual_ - share * (J * motions)));
    }

private:
    void measure_triangle() {
        const Vector3 ab = x_.col(1) - x_.col(0);
        const Vector3 ac = x_.col(2) - x_.col(0);
        const Vector3 cross = ab.cross(ac);
        const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (x_.col(2) - x_.col(1)).squaredNorm()});
        area_ = 0.5 * std::max(cross.norm(), flattest * longest);
        normal_ = cross / (2.0 * area_);
        e1_ = ab.normalized();
        e2_ = normal_.cross(e1_);
        c_ = {ac.dot(e1_), std::max(ac.dot(e2_), flattest * std::sqrt(longest))};
        base_ = ab.norm();
    }

    void add_pair(int i, int j) {
        Pair& pair = pairs_[count_];
        pair = {i, j, x_.col(j) - x_.col(i), 0.0, {0.0, 0.0}, 0.0, 0.0};
        pair.length = pair.along.norm();
        pair.in_plane = {pair.along.dot(e1_), pair.along.dot(e2_)};
        pair.across = pair.along.dot(normal_);
        pair.derivative = scale(pair) * pair.along.dot(n_.col(i) + n_.col(j));
        const double length = std::max(pair.in_plane.norm(), flattest * pair.length);
        const double c = pair.in_plane[0] / length;
        const double s = pair.in_plane[1] / length;
        V_.row(count_) << c * c * c, c * c * s, c * s * s, s * s * s;
        turned_.row(count_) << -3.0 * c * c * s, c * (c * c - 2.0 * s * s), s * (2.0 * c * c - s * s), 3.0 * c * s * s;
        derivatives_[count_] = pair.derivative;
        ++count_;
    }

    [[nodiscard]] Frames own_frames() const {
        Frames frames;
        for (int k = 0; k < stencil_size; ++k) {
            const Frame frame(Vector3(n_.col(k)));
            frames.u.col(k) = frame.u;
            frames.v.col(k) = frame.v;
        }
        return frames;
    }

    static double scale(const Pair& pair) { return 6.0 / (pair.length * pair.length * pair.length); }

    void fit() {
        const CubicMatrix& L = root_of_mean_square();
        const CubicMatrix G = V_.transpose() * V_ + ridge * (L.transpose() * L);
        inverse_ = G.llt().solve(CubicMatrix::Identity());
        cubic_ = inverse_ * (V_.transpose() * derivatives_);
        misfit_ = derivatives_ - V_ * cubic_;
        residual_ << root_ * cubic_, root_of_misfit_ * misfit_;
        residual_ *= std::sqrt(area_);
    }

    // ∂R / ∂(derivatives along the pairs)
    [[nodiscard]] ByPair residual_by_derivative() const {
        const Eigen::Matrix<double, 4, 6> dC = inverse_ * V_.transpose();
        return stacked(dC, Eigen::Matrix<double, 6, 6>::Identity() - V_ * dC);
    }

    // ∂R / ∂(angles of the pairs)
    [[nodiscard]] ByPair residual_by_angle() const {
        const PairVector turn = turned_ * cubic_;
        const Eigen::Matrix<double, 4, 6> dC =
            inverse_ * (turned_.transpose() * misfit_.asDiagonal() - V_.transpose() * turn.asDiagonal());
        return stacked(dC, -V_ * dC - Eigen::Matrix<double, 6, 6>(turn.asDiagonal()));
    }

    [[nodiscard]] ByPair stacked(const Eigen::Matrix<double, 4, 6>& cubic,
                                 const Eigen::Matrix<double, 6, 6>& misfit) const {
        ByPair result;
        result << root_ * cubic, root_of_misfit_ * misfit;
        return std::sqrt(area_) * result;
    }

    // Pair by pair: each knows few of the motions.
    [[nodiscard]] Jacobian jacobian(const ByPair& by_derivative, const Frames& frames) const {
        const ByPair by_angle = residual_by_angle();
        Jacobian J = residual_ * (area_by_motion() / (2.0 * area_)).transpose();
        for (int p = 0; p < count_; ++p) {
            add_derivative(pairs_[p], by_derivative.col(p), frames, J);
            add_angle(pairs_[p], by_angle.col(p), J);
        }
        return J;
    }

    void add_derivative(const Pair& pair, const Residual& by_derivative, const Frames& frames, Jacobian& J) const {
        const Vector3 sum = n_.col(pair.i) + n_.col(pair.j);
        const double per_length = -3.0 * pair.derivative / (pair.length * pair.length);
        for (const auto& [k, sign] : {std::pair(pair.i, -1.0), std::pair(pair.j, 1.0)}) {
            const Vector3 n = n_.col(k);
            J.col(3L * k) += sign * (scale(pair) * sum.dot(n) + per_length * pair.along.dot(n)) * by_derivative;
            J.col(3 * k + 1) += scale(pair) * pair.along.dot(frames.u.col(k)) * by_derivative;
            J.col(3 * k + 2) += scale(pair) * pair.along.dot(frames.v.col(k)) * by_derivative;
        }
    }

    // Where the plane tilts, what stands across it moves within it; a turn of all angles alike changes nothing.
    void add_angle(const Pair& pair, const Residual& by_angle, Jacobian& J) const {
        const double square = std::max(pair.in_plane.squaredNorm(), flattest * flattest * pair.length * pair.length);
        const Eigen::Vector2d turn = Eigen::Vector2d(-pair.in_plane[1], pair.in_plane[0]) / square;
        const Vector3 tangent = turn[0] * e1_ + turn[1] * e2_;
        J.col(3L * pair.i) -= tangent.dot(n_.col(pair.i)) * by_angle;
        J.col(3L * pair.j) += tangent.dot(n_.col(pair.j)) * by_angle;
        if (pair.across == 0.0) return;
        for (int k = 0; k < 3; ++k)
            J.col(3L * k) -= pair.across * turn.dot(tilt_by_height(k)) * normal_.dot(n_.col(k)) * by_angle;
    }

    // Change of the triangle's normal, by its components along e1 and e2, where corner k rises by 1.
    [[nodiscard]] Eigen::Vector2d tilt_by_height(int k) const {
        if (k == 2) return {0.0, -1.0 / c_[1]};
        if (k == 1) return {-1.0 / base_, c_[0] / (base_ * c_[1])};
        return {1.0 / base_, (base_ - c_[0]) / (base_ * c_[1])};
    }

    [[nodiscard]] ElementVector area_by_motion() const {
        ElementVector result = ElementVector::Zero();
        for (int k = 0; k < 3; ++k) {
            const Vector3 opposite = x_.col((k + 2) % 3) - x_.col((k + 1) % 3);
            result[3L * k] = 0.5 * normal_.cross(opposite).dot(n_.col(k));
        }
        return result;
    }

    // The part of the area's second derivatives that every height field has, ½ ∫ |∇h|²; blunt angles left out.
    void add_area(double factor, ElementMatrix& hessian) const {
        for (int k = 0; k < 3; ++k) {
            const int i = (k + 1) % 3;
            const int j = (k + 2) % 3;
            const double angle = cotangent(x_.col(i) - x_.col(k), x_.col(j) - x_.col(k));
            const double weight = 0.5 * factor * std::max(0.0, angle);
            const double turned = weight * n_.col(i).dot(n_.col(j));
            hessian(3L * i, 3L * i) += weight;
            hessian(3L * j, 3L * j) += weight;
            hessian(3L * i, 3L * j) -= turned;
            hessian(3L * j, 3L * i) -= turned;
        }
    }

    // Second derivatives of ⟨n_i + n_j, x_j − x_i⟩, times `factor`.
    void add_bending(const Pair& pair, double factor, const Frames& frames, ElementMatrix& hessian) const {
        for (const auto& [k, other, sign] : {std::tuple(pair.i, pair.j, 1.0), std::tuple(pair.j, pair.i, -1.0)}) {
            const Vector3 n = n_.col(other);
            const double u = sign * factor * frames.u.col(k).dot(n);
            const double v = sign * factor * frames.v.col(k).dot(n);
            hessian(3L * k + 1, 3L * other) += u;
            hessian(3L * other, 3L * k + 1) += u;
            hessian(3L * k + 2, 3L * other) += v;
            hessian(3L * other, 3L * k + 2) += v;
            const double shortened = factor * n_.col(k).dot(pair.along);
            hessian(3 * k + 1, 3 * k + 1) -= shortened;
            hessian(3 * k + 2, 3 * k + 2) -= shortened;
        }
    }

    CubicMatrix root_;  // of the mean square, with the weight of the lean
    double root_of_misfit_;
    std::array<bool, stencil_size> present_{};
    Eigen::Matrix<double, 3, 6> x_ = Eigen::Matrix<double, 3, 6>::Zero();
    Eigen::Matrix<double, 3, 6> n_ = Eigen::Matrix<double, 3, 6>::Zero();
    double area_ = 0.0;
    double base_ = 0.0;  // |ab|
    Eigen::Vector2d c_;  // of corner c seen from a
    Vector3 normal_, e1_, e2_;
    std::array<Pair, 6> pairs_;
    int count_ = 0;
    PairMatrix V_ = PairMatrix::Zero();       // cubic → derivative along each pair
    PairMatrix turned_ = PairMatrix::Zero();  // its derivative by the pair's angle
    PairVector derivatives_ = PairVector::Zero();
    CubicMatrix inverse_;  // of the fit's normal equations
    Cubic cubic_;
    PairVector misfit_;
    Residual residual_;
};

}  // namespace

ElementSums element_sums(const Sheet& sheet, const Stencil& stencil, const ElementWeights& weights) {
    return Element(sheet, stencil, weights).sums();
}

ElementTerms element_terms(const Sheet& sheet, const Stencil& stencil, const ElementWeights& weights,
                           const ElementSums& factors) {
    return Element(sheet, stencil, weights).terms(factors);
}

ElementVector element_gradient(const Sheet& sheet, const Stencil& stencil, const ElementWeights& weights,
                               const ElementSums& factors) {
    return Element(sheet, stencil, weights).gradient(factors);
}

ElementVector element_acceleration(const Sheet& sheet, const Sheet& there, const Stencil& stencil,
                                   const ElementWeights& weights, const ElementVector& motions, double share) {
    return Element(sheet, stencil, weights).acceleration(Element(there, stencil, weights), motions, share);
}

LocalCubic local_cubic(const Sheet& sheet, const Stencil& stencil) { return Element(sheet, stencil, {}).cubic(); }

double LocalCubic::along(const Vector3& chord) const {
    const Eigen::Vector2d direction = Eigen::Vector2d(chord.dot(e1), chord.dot(e2)).normalized();
    const double c = direction[0];
    const double s = direction[1];
    return coefficients.dot(Cubic(c * c * c, c * c * s, c * s * s, s * s * s));
}

}  // namespace fairing
