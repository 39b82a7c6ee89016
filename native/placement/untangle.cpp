#include "placement/untangle.h"

#include <algorithm>
#include <limits>

#include <Eigen/LU>

#include "base/progress.h"
#include "geometry/frame.h"
#include "placement/folds.h"

namespace fairing {

namespace {

using Vector2 = Eigen::Vector2d;

// Points p with ⟨normal, p⟩ ≥ offset lie on the inner side of a line.
struct HalfPlane {
    Vector2 normal;  // unit
    double offset;
};

double clearance(const std::vector<HalfPlane>& sides, const Vector2& p) {
    double least = std::numeric_limits<double>::infinity();
    for (const HalfPlane& side : sides) least = std::min(least, side.normal.dot(p) - side.offset);
    return least;
}

// The point of greatest clearance: a linear program in (x, y, clearance), whose optimum lies where three sides bind.
Vector2 deepest_point(const std::vector<HalfPlane>& sides, const Vector2& start) {
    Vector2 best = start;
    double most = clearance(sides, start);
    for (std::size_t i = 0; i < sides.size(); ++i) {
        for (std::size_t j = i + 1; j < sides.size(); ++j) {
            for (std::size_t k = j + 1; k < sides.size(); ++k) {
                Eigen::Matrix3d rows;
                rows << sides[i].normal.transpose(), -1.0, sides[j].normal.transpose(), -1.0,
                    sides[k].normal.transpose(), -1.0;
                const Vector3 x = rows.inverse() * Vector3(sides[i].offset, sides[j].offset, sides[k].offset);
                if (!(x[2] > most) || !x.allFinite()) continue;
                const double reached = clearance(sides, x.head<2>());
                if (reached <= most) continue;
                most = reached;
                best = x.head<2>();
            }
        }
    }
    return best;
}

class Untangling {
public:
    Untangling(const Problem& problem, const TargetSurface& target, Placement& placement)
        : problem_(problem), patch_(problem.patch), target_(target), placement_(placement) {}

    Indices run() {
        constexpr int most_sweeps = 20;
        constexpr int plain_sweeps = 3;  // then the vertices around take part, too
        Indices folded = folded_triangles(problem_, target_, placement_);
        for (int sweep = 0; sweep < most_sweeps && !folded.empty(); ++sweep) {
            bool any = false;
            for (const int v : vertices_of(folded, sweep >= plain_sweeps)) {
                checkpoint();
                if (improve(v)) any = true;
            }
            folded = folded_triangles(problem_, target_, placement_);
            if (!any && sweep >= plain_sweeps) break;
        }
        return folded;
    }

private:
    [[nodiscard]] Indices vertices_of(const Indices& triangles, bool around) const {
        Indices result;
        const auto add = [&](int v) {
            if (patch_.is_free(v)) result.push_back(v);
        };
        for (const int t : triangles) {
            for (const int v : patch_.triangles.col(t)) {
                add(v);
                if (!around) continue;
                for (const int w : patch_.ring(v).vertices) add(w);
            }
        }
        std::sort(result.begin(), result.end());
        result.erase(std::unique(result.begin(), result.end()), result.end());
        return result;
    }

    bool improve(int v) {
        const SurfacePoint old = placement_.where[at(v)];
        const Frame frame(target_.normal(old));
        const Vector3 centre = placement_.points.col(v);
        const std::vector<HalfPlane> sides = sides_of_ring(v, frame, centre);
        const Vector2 goal = deepest_point(sides, Vector2::Zero());
        if (goal.isZero()) return false;
        const int before = folded_around(v);
        const Vector3 wanted = centre + goal.x() * frame.u + goal.y() * frame.v;
        put(placement_, v, target_, target_.project(wanted, old.triangle));
        const int after = folded_around(v);
        if (after < before || (after == before && before > 0)) return true;
        put(placement_, v, target_, old);
        return false;
    }

    // The lines of the ring's edges in the tangent plane, with the vertex at the origin.
    [[nodiscard]] std::vector<HalfPlane> sides_of_ring(int v, const Frame& frame, const Vector3& centre) const {
        const auto flat = [&](int w) {
            const Vector3 d = placement_.points.col(w) - centre;
            return Vector2(d.dot(frame.u), d.dot(frame.v));
        };
        std::vector<HalfPlane> sides;
        const auto ring = patch_.ring(v).vertices;
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const Vector2 a = flat(ring[k]);
            const Vector2 along = flat(ring[(k + 1) % ring.size()]) - a;
            const double length = along.norm();
            if (!(length > 0.0)) continue;
            const Vector2 inner = Vector2(-along.y(), along.x()) / length;
            sides.push_back({inner, inner.dot(a)});
        }
        return sides;
    }

    [[nodiscard]] int folded_around(int v) const {
        int count = 0;
        for (const int edge : patch_.ring(v).rim) {
            for (const int t : patch_.edge_triangles[at(edge)]) {
                if (t == none || !has_corner(t, v)) continue;
                count += is_folded(problem_, target_, placement_, t) ? 1 : 0;
            }
        }
        return count;
    }

    [[nodiscard]] bool has_corner(int t, int v) const { return (patch_.triangles.col(t).array() == v).any(); }

    const Problem& problem_;
    const Patch& patch_;
    const TargetSurface& target_;
    Placement& placement_;
};

}  // namespace

Indices untangle(const Problem& problem, const TargetSurface& target, Placement& placement) {
    return Untangling(problem, target, placement).run();
}

}  // namespace fairing
