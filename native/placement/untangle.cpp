#include "placement/untangle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "base/progress.h"
#include "geometry/frame.h"
#include "placement/folds.h"

namespace fairing {

namespace {

using Vector2 = Eigen::Vector2d;

// Triangle between a vertex at the origin and a side of its ring; `up`: unit normal of the surface there.
struct Corner {
    Vector3 a;
    Vector3 b;
    Vector3 up;
};

// The triangles around a vertex as it moves in its tangent plane.
struct LocalEnergy {
    Frame frame;
    std::vector<Corner> corners;
    double area;  // the mean one
    double epsilon;

    [[nodiscard]] double operator()(double x, double y) const {
        const Vector3 p = x * frame.u + y * frame.v;
        double sum = 0.0;
        for (const Corner& corner : corners) {
            const Vector3 a = corner.a - p;
            const Vector3 b = corner.b - p;
            const double delta = 0.5 * a.cross(b).dot(corner.up) / area;
            const double squares = a.squaredNorm() + b.squaredNorm() + (b - a).squaredNorm();
            sum += (squares / (4.0 * std::numbers::sqrt3 * area) + 0.25 * (delta * delta + 1.0)) / barrier(delta);
        }
        return sum;
    }

    [[nodiscard]] double barrier(double delta) const {
        return 0.5 * (delta + std::sqrt(epsilon * epsilon + delta * delta));
    }
};

// One damped Newton step from the origin; derivatives by central differences, which are exact enough for a step.
Vector2 lower(const LocalEnergy& f) {
    const double h = 1e-4 * std::sqrt(f.area);
    const double f0 = f(0, 0);
    const double xp = f(h, 0);
    const double xm = f(-h, 0);
    const double yp = f(0, h);
    const double ym = f(0, -h);
    const Vector2 gradient((xp - xm) / (2 * h), (yp - ym) / (2 * h));
    Eigen::Matrix2d hessian;
    const double mixed = (f(h, h) - f(h, -h) - f(-h, h) + f(-h, -h)) / (4 * h * h);
    hessian << (xp - 2 * f0 + xm) / (h * h), mixed, mixed, (yp - 2 * f0 + ym) / (h * h);
    const bool convex = hessian.determinant() > 0.0 && hessian.trace() > 0.0;
    Vector2 step = convex ? Vector2(-hessian.llt().solve(gradient))
                          : Vector2(-gradient / std::max(std::abs(hessian.trace()), 1e-12));
    const double longest = 2.0 * std::sqrt(f.area);
    if (!step.allFinite()) return Vector2::Zero();
    if (step.norm() > longest) step *= longest / step.norm();
    constexpr int most_halvings = 6;
    for (int k = 0; k < most_halvings; ++k, step *= 0.5) {
        if (f(step.x(), step.y()) < f0) return step;
    }
    return Vector2::Zero();
}

class Untangling {
public:
    Untangling(const Problem& problem, const TargetSurface& target, Placement& placement)
        : problem_(problem), patch_(problem.patch), target_(target), placement_(placement) {}

    void run() {
        constexpr int fewest_rings = 3;
        for (const int rings : {fewest_rings, 6, 12}) {
            const Indices folded = folded_triangles(problem_, target_, placement_);
            if (folded.empty()) return;
            // A sheet that lies turned over as a whole keeps its folds from the first sweeps on.
            if (!spread(region(folded, rings)) && rings == fewest_rings) return;
        }
    }

private:
    struct Region {
        Indices vertices;   // free, ascending
        Indices triangles;  // all at these
    };

    [[nodiscard]] Region region(const Indices& folded, int rings) const {
        std::vector<char> inside(at(patch_.vertex_count()), 0);
        Indices front;
        const auto add = [&](int v) {
            if (inside[at(v)] || !patch_.is_free(v)) return;
            inside[at(v)] = 1;
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
            if (inside[at(v)]) result.vertices.push_back(v);
        }
        for (int t = 0; t < patch_.triangle_count(); ++t) {
            const auto corners = patch_.triangles.col(t);
            if (std::any_of(corners.begin(), corners.end(), [&](int v) { return inside[at(v)] != 0; }))
                result.triangles.push_back(t);
        }
        return result;
    }

    // False where many folds hardly fall in number within the first window of sweeps.
    bool spread(const Region& where) {
        constexpr int most_sweeps = 60;
        constexpr int settling_sweeps = 3;  // once nothing is folded
        constexpr std::size_t window = 10;
        constexpr double falls_at_first = 0.6;  // in a window
        constexpr double falls = 0.93;
        std::vector<double> folded{count_folded(where)};
        int settled = 0;
        for (int sweep = 0; sweep < most_sweeps && settled < settling_sweeps; ++sweep) {
            sweep_once(where);
            folded.push_back(count_folded(where));
            settled = folded.back() > 0 ? 0 : settled + 1;
            if (folded.size() <= window || folded.back() <= few_folds) continue;
            const double share = folded.back() / folded[folded.size() - 1 - window];
            if (folded.size() == window + 1 && share > falls_at_first) return false;
            if (share > falls) return true;
        }
        return true;
    }

    void sweep_once(const Region& where) {
        const double area = mean_area(where);
        const double epsilon = smoothing(where, area);
        for (const int v : where.vertices) {
            checkpoint(v);
            move(v, area, epsilon);
        }
    }

    [[nodiscard]] double count_folded(const Region& where) const {
        const auto folded = [&](int t) { return is_folded(problem_, target_, placement_, t); };
        return static_cast<double>(std::count_if(where.triangles.begin(), where.triangles.end(), folded));
    }

    [[nodiscard]] double mean_area(const Region& where) const {
        double sum = 0.0;
        for (const int t : where.triangles) sum += 0.5 * area_vector(patch_, placement_.points, t).norm();
        return std::max(sum / static_cast<double>(where.triangles.size()), std::numeric_limits<double>::min());
    }

    [[nodiscard]] double smoothing(const Region& where, double area) const {
        constexpr double least = 1e-3;
        constexpr double share = 0.2;
        double most_negative = 0.0;
        for (const int t : where.triangles) {
            if (!is_folded(problem_, target_, placement_, t)) continue;
            most_negative = std::max(most_negative, 0.5 * area_vector(patch_, placement_.points, t).norm() / area);
        }
        return std::hypot(least, share * most_negative);
    }

    void move(int v, double area, double epsilon) {
        const SurfacePoint old = placement_.where[at(v)];
        const Vector3 centre = placement_.points.col(v);
        LocalEnergy energy{Frame(target_.normal(old)), {}, area, epsilon};
        const auto ring = patch_.ring(v).vertices;
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const int a = ring[k];
            const int b = ring[(k + 1) % ring.size()];
            const Vector3 up = upwards(v) + upwards(a) + upwards(b);
            energy.corners.push_back(
                {placement_.points.col(a) - centre, placement_.points.col(b) - centre, up.normalized()});
        }
        const Vector2 step = lower(energy);
        if (step.isZero()) return;
        const Vector3 wanted = centre + step.x() * energy.frame.u + step.y() * energy.frame.v;
        put(placement_, v, target_, target_.project(wanted, old.triangle));
    }

    // As is_folded measures it.
    [[nodiscard]] Vector3 upwards(int v) const {
        return patch_.is_free(v) ? target_.face_normal(placement_.where[at(v)].triangle) : Vector3::Zero();
    }

    const Problem& problem_;
    const Patch& patch_;
    const TargetSurface& target_;
    Placement& placement_;
};

}  // namespace

void untangle(const Problem& problem, const TargetSurface& target, Placement& placement) {
    Untangling(problem, target, placement).run();
}

}  // namespace fairing
