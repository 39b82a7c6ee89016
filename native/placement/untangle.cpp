#include "placement/untangle.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "base/limits.h"
#include "base/progress.h"
#include "geometry/triangle.h"
#include "linear/limits.h"
#include "placement/tears.h"

namespace fairing {

namespace {

using Vector2 = Eigen::Vector2d;

// A triangle between a vertex and a side of its ring as the vertex moves in its tangent plane, to `step` from the
// origin. δ = delta + slope · step; the sum of the squared sides = squares − 2 sides · step + 2 |step|².
struct Corner {
    double delta;
    Vector2 slope;
    double squares;
    Vector2 sides;
};

// With derivatives by the step.
struct Value {
    double value = 0.0;
    Vector2 gradient = Vector2::Zero();
    Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
};

// The triangles around a vertex.
class LocalEnergy {
public:
    // `area`: the mean one.
    LocalEnergy(Frame frame, double area, double epsilon)
        : frame_(std::move(frame)),
          area_(area),
          epsilon_squared_(epsilon * epsilon),
          shape_(1.0 / (4.0 * std::numbers::sqrt3 * area)) {}

    // a, b: from the vertex to the ends of a side; `up`: unit normal of the surface there.
    void add(const Vector3& a, const Vector3& b, const Vector3& up) {
        const double scale = 0.5 / area_;
        corners_.push_back({scale * a.cross(b).dot(up), scale * in_plane((a - b).cross(up)),
                            a.squaredNorm() + b.squaredNorm() + (b - a).squaredNorm(), in_plane(a + b)});
    }

    [[nodiscard]] Vector3 in_space(const Vector2& step) const { return step.x() * frame_.u + step.y() * frame_.v; }
    [[nodiscard]] double edge() const { return std::sqrt(area_); }

    [[nodiscard]] double operator()(const Vector2& step) const {
        double sum = 0.0;
        for (const Corner& corner : corners_) {
            const double delta = corner.delta + corner.slope.dot(step);
            const double squares = corner.squares + 2.0 * step.dot(step - corner.sides);
            sum += (shape_ * squares + 0.25 * (delta * delta + 1.0)) / barrier(delta, root(delta));
        }
        return sum;
    }

    [[nodiscard]] Value at_origin() const {
        Value sum;
        for (const Corner& corner : corners_) add_derivatives(corner, sum);
        return sum;
    }

private:
    [[nodiscard]] Vector2 in_plane(const Vector3& d) const { return {d.dot(frame_.u), d.dot(frame_.v)}; }
    [[nodiscard]] double root(double delta) const { return std::sqrt(epsilon_squared_ + delta * delta); }
    // Without the difference of equal numbers far below zero.
    [[nodiscard]] double barrier(double delta, double r) const {
        return delta > 0.0 ? 0.5 * (delta + r) : 0.5 * epsilon_squared_ / (r - delta);
    }

    // Derivative of N/χ.
    void add_derivatives(const Corner& corner, Value& sum) const {
        const double delta = corner.delta;
        const double r = root(delta);
        const double chi = barrier(delta, r);
        const double first = 1.0 / r;                                      // χ'/χ
        const double second = 0.5 * epsilon_squared_ / (r * r * r * chi);  // χ''/χ
        const double f = (shape_ * corner.squares + 0.25 * (delta * delta + 1.0)) / chi;
        const Vector2 n = (-2.0 * shape_ * corner.sides + 0.5 * delta * corner.slope) / chi;  // ∇N/χ
        const Vector2 c = first * corner.slope;                                               // ∇χ/χ
        sum.value += f;
        sum.gradient += n - f * c;
        sum.hessian += 4.0 * shape_ / chi * Eigen::Matrix2d::Identity() - n * c.transpose() - c * n.transpose() +
                       (0.5 / chi - f * second) * corner.slope * corner.slope.transpose() + 2.0 * f * c * c.transpose();
    }

    Frame frame_;
    double area_;
    double epsilon_squared_;
    double shape_;
    std::vector<Corner> corners_;
};

// One damped Newton step from the origin.
Vector2 lower(const LocalEnergy& f) {
    const auto [f0, gradient, hessian] = f.at_origin();
    const bool convex = hessian.determinant() > 0.0 && hessian.trace() > 0.0;
    Vector2 step = convex ? Vector2(-hessian.llt().solve(gradient))
                          : Vector2(-gradient / std::max(std::abs(hessian.trace()), 1e-12));
    const double longest = 2.0 * f.edge();
    if (!step.allFinite()) return Vector2::Zero();
    if (step.norm() > longest) step *= longest / step.norm();
    for (int k = 0; k < most_halvings; ++k, step *= 0.5) {
        if (f(step) < f0) return step;
    }
    return Vector2::Zero();
}

class Untangling {
public:
    Untangling(const Problem& problem, const TargetSurface& target, Placement& placement)
        : problem_(problem),
          patch_(problem.patch),
          target_(target),
          placement_(placement),
          awake_(patch_.vertex_count(), 1) {}

    void run() {
        for (const int rings : {3, 6, 12}) {
            const Indices folded = folded_triangles(problem_, target_, placement_);
            if (folded.empty()) return;
            spread(region(folded, rings));
        }
    }

private:
    struct Region {
        Indices vertices;   // free, ascending
        Indices triangles;  // all at these
    };

    [[nodiscard]] Region region(const Indices& folded, int rings) const {
        std::vector<char> inside(patch_.vertex_count(), 0);
        Indices front;
        const auto add = [&](int v) {
            if (inside[v] || !patch_.is_free(v)) return;
            inside[v] = 1;
            front.push_back(v);
        };
        for (const int t : folded) {
            for (const int v : patch_.triangles.col(t)) add(v);
        }
        for (int k = 0; k < rings; ++k) {
            Indices last = std::move(front);
            front.clear();
            for (const int v : last) {
                for (const int w : patch_.ring(v).vertices) add(w);
            }
        }
        Region result;
        for (int v = 0; v < patch_.free_count; ++v) {
            if (inside[v]) result.vertices.push_back(v);
        }
        for (int t = 0; t < patch_.triangle_count(); ++t) {
            const auto corners = patch_.triangles.col(t);
            if (std::any_of(corners.begin(), corners.end(), [&](int v) { return inside[v] != 0; }))
                result.triangles.push_back(t);
        }
        return result;
    }

    // Until nothing has been folded for some sweeps, or as much as a window of sweeps before.
    void spread(const Region& where) {
        constexpr int quiet_sweeps = 3;     // without a fold
        constexpr std::size_t window = 15;  // sweeps
        std::vector<double> folded{count_folded(where)};
        int quiet = 0;
        for (int sweep = 0; sweep < most_iterations && quiet < quiet_sweeps; ++sweep) {
            sweep_once(where);
            folded.push_back(count_folded(where));
            quiet = folded.back() > 0 ? 0 : quiet + 1;
            if (quiet == 0 && folded.size() > window && folded.back() >= folded[folded.size() - 1 - window]) return;
        }
    }

    // Most vertices come to rest after some sweeps.
    void sweep_once(const Region& where) {
        constexpr double still = 0.02;  // of an edge
        const double area = mean_area(where);
        const double epsilon = smoothing(where, area);
        wake_folded(where);
        for (const int v : where.vertices) {
            checkpoint(v);
            if (!awake_[v]) continue;
            awake_[v] = 0;
            if (move(v, area, epsilon) > still) wake_around(v);
        }
    }

    void wake_folded(const Region& where) {
        for (const int t : where.triangles) {
            if (!is_folded(problem_, target_, placement_, t)) continue;
            for (const int v : patch_.triangles.col(t)) wake_around(v);
        }
    }

    void wake_around(int v) {
        awake_[v] = 1;
        for (const int w : patch_.ring(v).vertices) awake_[w] = 1;
    }

    [[nodiscard]] double count_folded(const Region& where) const {
        const auto folded = [&](int t) { return is_folded(problem_, target_, placement_, t); };
        return static_cast<double>(std::count_if(where.triangles.begin(), where.triangles.end(), folded));
    }

    [[nodiscard]] double mean_area(const Region& where) const {
        double sum = 0.0;
        for (const int t : where.triangles) sum += 0.5 * area_vector(placement_.points, patch_.triangles.col(t)).norm();
        return std::max(sum / static_cast<double>(where.triangles.size()), std::numeric_limits<double>::min());
    }

    [[nodiscard]] double smoothing(const Region& where, double area) const {
        constexpr double least = 1e-3;  // of the mean area: a barrier has a width
        constexpr double share = 0.2;   // of the largest folded area, across which the barrier has to see
        double most_negative = 0.0;
        for (const int t : where.triangles) {
            if (!is_folded(problem_, target_, placement_, t)) continue;
            most_negative =
                std::max(most_negative, 0.5 * area_vector(placement_.points, patch_.triangles.col(t)).norm() / area);
        }
        return std::hypot(least, share * most_negative);
    }

    // How far, in edges.
    double move(int v, double area, double epsilon) {
        const SurfacePoint old = placement_.where[v];
        const Vector3 centre = placement_.points.col(v);
        LocalEnergy energy(Frame(target_.normal(old)), area, epsilon);
        const auto ring = patch_.ring(v).vertices;
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const int a = ring[k];
            const int b = ring[(k + 1) % ring.size()];
            const Vector3 up = upwards(v) + upwards(a) + upwards(b);
            energy.add(placement_.points.col(a) - centre, placement_.points.col(b) - centre, up.normalized());
        }
        const Vector2 step = lower(energy);
        if (step.isZero()) return 0.0;
        const Vector3 wanted = centre + energy.in_space(step);
        put(placement_, v, target_, target_.project(wanted, old.triangle));
        return step.norm() / energy.edge();
    }

    // As is_folded measures it.
    [[nodiscard]] Vector3 upwards(int v) const {
        return patch_.is_free(v) ? target_.face_normal(placement_.where[v].triangle) : Vector3::Zero();
    }

    const Problem& problem_;
    const Patch& patch_;
    const TargetSurface& target_;
    Placement& placement_;
    std::vector<char> awake_;  // local vertices: moved lately, or a neighbour has
};

}  // namespace

void untangle(const Problem& problem, const TargetSurface& target, Placement& placement) {
    Untangling(problem, target, placement).run();
}

}  // namespace fairing
