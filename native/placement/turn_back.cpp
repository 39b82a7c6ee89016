#include "placement/turn_back.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "geometry/averages.h"
#include "geometry/flips.h"
#include "geometry/frame.h"
#include "mesh/corners.h"
#include "placement/folds.h"

namespace fairing {

namespace {

class TurningBack {
public:
    TurningBack(const Problem& problem, const TargetSurface& target, Placement& placement)
        : problem_(problem), patch_(problem.patch), target_(target), placement_(placement) {}

    bool run() {
        for (bool gained = false;; gained = true) {  // ends: less is folded each time
            const Indices folded = folded_triangles(problem_, target_, placement_);
            if (folded.empty() || folded.size() > few_folds) return gained;
            const Indices corners = corners_of(folded);
            if (!try_all(corners) && !try_all(beside(corners))) return gained;
        }
    }

private:
    // Free ones.
    [[nodiscard]] Indices corners_of(const Indices& triangles) const {
        Indices result;
        for (const int t : triangles) {
            for (const int v : patch_.triangles.col(t)) add(v, result);
        }
        return result;
    }

    [[nodiscard]] Indices beside(const Indices& vertices) const {
        Indices result;
        for (const int v : vertices) {
            for (const int w : patch_.ring(v).vertices) add(w, result);
        }
        return result;
    }

    void add(int v, Indices& list) const {
        if (patch_.is_free(v) && std::find(list.begin(), list.end(), v) == list.end()) list.push_back(v);
    }

    // True where one of them has moved.
    bool try_all(const Indices& vertices) {
        bool gained = false;
        for (const int v : vertices) gained = improve(v) || gained;
        return gained;
    }

    // Nearer places come first; of those as near the first of the best.
    bool improve(int v) {
        constexpr std::array<double, 6> radii{0.1, 0.2, 0.3, 0.5, 0.7, 1.0};  // of the ring's
        constexpr int directions = 16;                                        // of each radius
        const Indices around = triangles_around(v);
        std::ptrdiff_t least = count_turned(around);
        const SurfacePoint old = placement_.where[v];
        const Vector3 centre = placement_.points.col(v);
        const Frame frame(target_.normal(old));
        const double reach = mean_spoke(patch_, placement_.points, v);
        std::optional<SurfacePoint> best;
        for (const double radius : radii) {
            for (int k = 0; k < directions && least > 0; ++k) {
                const double angle = 2.0 * std::numbers::pi * k / directions;
                const Vector3 step = radius * reach * (std::cos(angle) * frame.u + std::sin(angle) * frame.v);
                const SurfacePoint place = target_.project(centre + step, old.triangle);
                put(placement_, v, target_, place);
                const std::ptrdiff_t turned = count_turned(around);
                if (turned >= least) continue;
                least = turned;
                best = place;
            }
        }
        placement_.where[v] = best.value_or(old);
        placement_.points.col(v) = best ? target_.position(*best) : centre;
        return best.has_value();
    }

    // Those that a vertex may turn, itself or by its neighbours' normals.
    [[nodiscard]] Indices triangles_around(int v) const {
        const auto ring = patch_.ring(v).vertices;
        Indices near(ring.begin(), ring.end());
        near.push_back(v);
        return with_free_corner(patch_, triangles_at(patch_, near));
    }

    // As folded_triangles has it.
    [[nodiscard]] std::ptrdiff_t count_turned(const Indices& triangles) const {
        return std::count_if(triangles.begin(), triangles.end(), [&](int t) {
            return is_folded(problem_, target_, placement_, t) || is_flipped(patch_, placement_.points, t);
        });
    }

    const Problem& problem_;
    const Patch& patch_;
    const TargetSurface& target_;
    Placement& placement_;
};

}  // namespace

bool turn_back(const Problem& problem, const TargetSurface& target, Placement& placement) {
    return TurningBack(problem, target, placement).run();
}

}  // namespace fairing
