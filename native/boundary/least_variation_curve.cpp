#include "boundary/least_variation_curve.h"

#include <complex>
#include <stdexcept>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "base/errors.h"
#include "base/limits.h"
#include "base/progress.h"

namespace fairing {

namespace {

// The two curvatures in a frame that does not twist (R. L. Bishop 1975), times the length, are polynomials of the share
// of the length: that of degree k of each is a multiple of the Legendre polynomial. In these the functional is a sum of
// squares, and circles are constants.
constexpr int degree = 8;
constexpr int shape_count = 2 * (degree + 1);   // of both curvatures
constexpr int unknown_count = shape_count + 1;  // the last: the length, in chords
constexpr int step_count = 32;                  // of the integration

template <typename Scalar>
using Shape = Eigen::Matrix<Scalar, unknown_count, 1>;
using Square = Eigen::Matrix<double, unknown_count, unknown_count>;
using Condition = Eigen::Matrix<double, 5, 1>;
using Across = Eigen::Matrix<double, 3, 2>;

// Where a curve has come to: its place, and the frame whose first column is its direction.
template <typename Scalar>
struct Pose {
    Vector3Of<Scalar> place;
    Eigen::Matrix<Scalar, 3, 3> frame;
};

// Its motion in its own frame.
template <typename Scalar>
struct Twist {
    Vector3Of<Scalar> turn;
    Vector3Of<Scalar> way;
};

template <typename Scalar>
Vector3Of<Scalar> cross(const Vector3Of<Scalar>& a, const Vector3Of<Scalar>& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Without conjugation, so that a complex step differentiates it.
template <typename Scalar>
Scalar dot(const Vector3Of<Scalar>& a, const Vector3Of<Scalar>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Values of the Legendre polynomials of degree 0 … `degree` at 2 share − 1.
std::array<double, degree + 1> legendre(double share) {
    const double x = 2.0 * share - 1.0;
    std::array<double, degree + 1> result{1.0, x};
    for (int k = 1; k < degree; ++k) result[k + 1] = ((2 * k + 1) * x * result[k] - k * result[k - 1]) / (k + 1);
    return result;
}

template <typename Scalar>
Twist<Scalar> twist_at(const Shape<Scalar>& shape, double share) {
    const auto values = legendre(share);
    Scalar first(0.0);
    Scalar second(0.0);
    for (int k = 0; k <= degree; ++k) {
        first += shape[2 * k] * values[k];
        second += shape[2 * k + 1] * values[k];
    }
    return {{Scalar(0.0), -second, first}, {shape[shape_count], Scalar(0.0), Scalar(0.0)}};
}

// The pose after a constant twist, by the exponential's series: exact to 1e-16 for half a radian.
template <typename Scalar>
Pose<Scalar> moved(const Pose<Scalar>& pose, const Twist<Scalar>& twist) {
    constexpr int terms = 7;  // of the series
    const Scalar square = -dot<Scalar>(twist.turn, twist.turn);
    std::array<Scalar, 3> sums{Scalar(0.0), Scalar(0.0), Scalar(0.0)};  // sin θ/θ, (1 − cos θ)/θ², (θ − sin θ)/θ³
    for (int s = 0; s < 3; ++s) {
        double factorial = s == 2 ? 6.0 : s + 1.0;
        Scalar power(1.0);
        for (int k = 0; k < terms; ++k) {
            sums[s] += power / factorial;
            power *= square;
            factorial *= (2 * k + s + 2.0) * (2 * k + s + 3.0);
        }
    }
    const auto turned = [&](const Vector3Of<Scalar>& v, int s) -> Vector3Of<Scalar> {
        const Vector3Of<Scalar> once = cross<Scalar>(twist.turn, v);
        return v + sums[s] * once + sums[s + 1] * cross<Scalar>(twist.turn, once);
    };
    Eigen::Matrix<Scalar, 3, 3> turn;
    for (int c = 0; c < 3; ++c) turn.col(c) = turned(Vector3::Unit(c).template cast<Scalar>(), 0);
    return {pose.place + pose.frame * turned(twist.way, 1), pose.frame * turn};
}

// One step of the Magnus series of fourth order (Iserles et al. 2000): exact where the curvature is constant.
template <typename Scalar>
Pose<Scalar> integrated(const Pose<Scalar>& pose, const Shape<Scalar>& shape, double begin, double step) {
    const double off = std::numbers::sqrt3 / 6.0 * step;
    const Twist<Scalar> a = twist_at<Scalar>(shape, begin + 0.5 * step - off);
    const Twist<Scalar> b = twist_at<Scalar>(shape, begin + 0.5 * step + off);
    const Scalar half(0.5 * step);
    const Scalar bracket(0.5 * off * step);
    const Vector3Of<Scalar> turn = half * (a.turn + b.turn) + bracket * cross<Scalar>(a.turn, b.turn);
    const Vector3Of<Scalar> way =
        half * (a.way + b.way) + bracket * (cross<Scalar>(a.turn, b.way) - cross<Scalar>(b.turn, a.way));
    return moved<Scalar>(pose, {turn, way});
}

// From (0, 0, 0) in one direction to a place at distance 1.
class Curve {
public:
    // The circle.
    Curve(const Vector3& direction, const Vector3& end) : end_(end) {
        begin_.place = Vector3::Zero();
        const Vector3 bend = end - end.dot(direction) * direction;
        const double half = std::atan2(bend.norm(), end.dot(direction));
        begin_.frame.col(0) = direction;
        begin_.frame.col(1) = half > 1e-12 ? bend.normalized() : direction.unitOrthogonal();
        begin_.frame.col(2) = begin_.frame.col(0).cross(begin_.frame.col(1));
        shape_.setZero();
        shape_[0] = 2.0 * half;
        shape_[shape_count] = half > 1e-4 ? half / std::sin(half) : 1.0 + half * half / 6.0;
    }

    // Ends in this direction with the least variation; false where Newton's method does not lead there.
    bool end_in(const Vector3& direction) {
        const Across across = orthogonal(direction);
        constexpr double small_step = 1e-12;  // rounding of a curve of length one
        const Shape<double> before = shape_;
        Condition multipliers = Condition::Zero();
        for (int k = 0; k < most_iterations; ++k) {
            checkpoint();
            const double size = newton_step(across, multipliers);
            if (!(size < 1.0)) break;
            if (size < small_step) return pose(1.0).frame.col(0).dot(direction) > 0.0;
        }
        shape_ = before;
        return false;
    }

    [[nodiscard]] Vector3 at(double share) const { return pose(std::clamp(share, 0.0, 1.0)).place; }
    [[nodiscard]] Vector3 last_direction() const { return pose(1.0).frame.col(0); }

private:
    static Across orthogonal(const Vector3& direction) {
        Across result;
        result.col(0) = direction.unitOrthogonal();
        result.col(1) = direction.cross(result.col(0));
        return result;
    }

    template <typename Scalar>
    [[nodiscard]] Pose<Scalar> end_of(const Shape<Scalar>& shape) const {
        Pose<Scalar> result{begin_.place.template cast<Scalar>(), begin_.frame.template cast<Scalar>()};
        for (int k = 0; k < step_count; ++k)
            result = integrated<Scalar>(result, shape, double(k) / step_count, 1.0 / step_count);
        return result;
    }

    [[nodiscard]] Pose<double> pose(double share) const {
        Pose<double> result = begin_;
        const int whole = std::min(static_cast<int>(share * step_count), step_count - 1);
        for (int k = 0; k < whole; ++k)
            result = integrated<double>(result, shape_, double(k) / step_count, 1.0 / step_count);
        const double begin = double(whole) / step_count;
        return integrated<double>(result, shape_, begin, share - begin);
    }

    // What should vanish at the end.
    template <typename Scalar>
    [[nodiscard]] Eigen::Matrix<Scalar, 5, 1> conditions(const Shape<Scalar>& shape, const Across& across) const {
        const Pose<Scalar> end = end_of<Scalar>(shape);
        Eigen::Matrix<Scalar, 5, 1> result;
        result << end.place - end_.cast<Scalar>(), across.transpose().cast<Scalar>() * end.frame.col(0);
        return result;
    }

    // By complex steps.
    [[nodiscard]] Eigen::Matrix<double, 5, unknown_count> slopes_of_conditions(const Across& across) const {
        using Complex = std::complex<double>;
        constexpr double step = 1e-30;  // complex, so that nothing cancels
        Eigen::Matrix<double, 5, unknown_count> result;
        for (int k = 0; k < unknown_count; ++k) {
            Shape<Complex> there = shape_.cast<Complex>();
            there[k] += Complex(0.0, step);
            result.col(k) = conditions<Complex>(there, across).imag() / step;
        }
        return result;
    }

    // Second derivatives of the conditions, weighted, by differences: Newton's method corrects their errors.
    [[nodiscard]] Square bend(const Across& across, const Condition& weights) const {
        constexpr double step = 1e-4;  // about the fourth root of rounding: best for second differences
        const auto value = [&](int i, int k) {
            Shape<double> there = shape_;
            if (i >= 0) there[i] += step;
            if (k >= 0) there[k] += step;
            return weights.dot(conditions<double>(there, across));
        };
        const double here = value(none, none);
        Shape<double> once;
        for (int i = 0; i < unknown_count; ++i) once[i] = value(i, none);
        Square result;
        for (int i = 0; i < unknown_count; ++i) {
            for (int k = 0; k <= i; ++k)
                result(i, k) = result(k, i) = (value(i, k) - once[i] - once[k] + here) / (step * step);
        }
        return result;
    }

    // Half the squared derivative of each polynomial of a curvature with each other: P_i′ P_k′ over the share.
    static Square energy() {
        Square result;
        result.setZero();
        for (int i = 1; i <= degree; ++i) {
            for (int k = i; k <= degree; k += 2) {
                for (int c = 0; c < 2; ++c)
                    result(2 * i + c, 2 * k + c) = result(2 * k + c, 2 * i + c) = 2.0 * i * (i + 1.0);
            }
        }
        return result;
    }

    // Towards the stationary point of the functional under the conditions. Returns the largest change.
    double newton_step(const Across& across, Condition& multipliers) {
        constexpr int size = unknown_count + 5;  // with five multipliers
        const auto slopes = slopes_of_conditions(across);
        Eigen::Matrix<double, size, size> matrix = Eigen::Matrix<double, size, size>::Zero();
        matrix.topLeftCorner<unknown_count, unknown_count>() = energy();
        if (!multipliers.isZero(0.0)) matrix.topLeftCorner<unknown_count, unknown_count>() += bend(across, multipliers);
        matrix.bottomLeftCorner<5, unknown_count>() = slopes;
        matrix.topRightCorner<unknown_count, 5>() = slopes.transpose();
        Eigen::Matrix<double, size, 1> right;
        right << -(energy() * shape_), -conditions<double>(shape_, across);
        const Eigen::Matrix<double, size, 1> move = matrix.partialPivLu().solve(right);
        shape_ += move.head<unknown_count>();
        multipliers = move.tail<5>();
        return move.head<unknown_count>().lpNorm<Eigen::Infinity>();
    }

    Pose<double> begin_;
    Vector3 end_;
    Shape<double> shape_;
};

// Turns the end of a circle step by step to where it is to go.
void turn_end(Curve& curve, const Vector3& direction) {
    constexpr double least_part = 1.0 / 64.0;  // of the turn
    const Eigen::Quaterniond whole = Eigen::Quaterniond::FromTwoVectors(curve.last_direction(), direction);
    const Vector3 first = curve.last_direction();
    double done = 0.0;
    double part = 1.0;
    while (done < 1.0) {
        const double next = std::min(1.0, done + part);
        if (curve.end_in(Eigen::Quaterniond::Identity().slerp(next, whole) * first)) {
            done = next;
            continue;
        }
        part *= 0.5;
        if (part < least_part) throw SolverError("no curve of least variation joins these ends: they turn too far");
    }
}

}  // namespace

Points least_variation_curve(const CurveEnd& begin, const CurveEnd& end, const VectorX& shares) {
    const Vector3 chord = end.place - begin.place;
    const double size = chord.norm();
    if (!(size > 0.0)) throw std::invalid_argument("a curve needs two different ends");
    const bool free_end = end.direction.isZero(0.0);
    if (begin.direction.isZero(0.0)) {
        if (free_end) return (chord * shares.transpose()).colwise() + begin.place;
        const CurveEnd from{end.place, -end.direction};
        return least_variation_curve(from, {begin.place, Vector3::Zero()}, 1.0 - shares.array());
    }
    Curve curve(begin.direction.normalized(), chord / size);
    if (!free_end) turn_end(curve, end.direction.normalized());
    Points result(3, shares.size());
    for (Eigen::Index k = 0; k < shares.size(); ++k) result.col(k) = begin.place + size * curve.at(shares[k]);
    return result;
}

}  // namespace fairing
