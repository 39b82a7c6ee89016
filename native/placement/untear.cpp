#include "placement/untear.h"

#include <algorithm>
#include <array>

#include "geometry/flips.h"
#include "geometry/self_intersection.h"
#include "placement/refill.h"

namespace fairing {

namespace {

void keep_each_once(Indices& numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

Indices corners_of(const Patch& patch, const Indices& triangles) {
    Indices corners;
    for (const int t : triangles) {
        for (const int v : patch.triangles.col(t)) corners.push_back(v);
    }
    keep_each_once(corners);
    return corners;
}

// Those with one of the vertices as a corner.
Indices triangles_at(const Patch& patch, const Indices& vertices) {
    Indices result;
    for (const int v : vertices) {
        for (const int edge : patch.ring(v).spokes) {
            for (const int t : patch.edge_triangles[at(edge)]) {
                if (t != none) result.push_back(t);
            }
        }
    }
    keep_each_once(result);
    return result;
}

double ring_radius(const Patch& patch, const Points& points, int v) {
    const auto ring = patch.ring(v).vertices;
    double sum = 0.0;
    for (const int w : ring) sum += (points.col(w) - points.col(v)).norm();
    return sum / static_cast<double>(ring.size());
}

// The torn ones around one vertex, wherever that moves.
class Around {
public:
    Around(const Patch& patch, int v) : patch_(patch) {
        Indices near = triangles_at(patch, {v});
        turning_ = near = triangles_at(patch, corners_of(patch, near));
        std::erase_if(turning_, [&](int t) { return patch.triangles.col(t).minCoeff() >= patch.free_count; });
        for (int k = 0; k < 2; ++k) near = triangles_at(patch, corners_of(patch, near));
        triangles_ = patch.triangles(Eigen::all, near);
    }

    [[nodiscard]] std::ptrdiff_t torn(const Points& points) const {
        const auto turned =
            std::count_if(turning_.begin(), turning_.end(), [&](int t) { return is_flipped(patch_, points, t); });
        return turned + std::ssize(crossing_triangles(triangles_, points));
    }

private:
    const Patch& patch_;
    Indices turning_;  // may be turned by the vertex, itself or by its neighbours' normals
    Triangles triangles_;
};

// Nearer places come first; of those as near the first of the best. True where the vertex has moved.
bool improve(const Patch& patch, int v, Points& points) {
    constexpr std::array radii{0.2, 0.4, 0.7, 1.0, 1.5};  // of the ring's
    const Around around(patch, v);
    std::ptrdiff_t least = around.torn(points);
    const Vector3 centre = points.col(v);
    const double reach = ring_radius(patch, points, v);
    Vector3 best = centre;
    for (const double radius : radii) {
        for (int k = 0; k < 27 && least > 0; ++k) {  // of a cube's surface
            const Eigen::Vector3i corner(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
            points.col(v) = centre + radius * reach * corner.cast<double>().normalized();
            const std::ptrdiff_t torn = around.torn(points);
            if (torn >= least) continue;
            least = torn;
            best = points.col(v);
        }
    }
    points.col(v) = best;
    return best != centre;
}

// Wider and wider around what is torn, for as long as that leaves less of it.
bool fill_anew(const Patch& patch, Points& points, Indices& torn) {
    constexpr std::array rings{1, 2, 3, 4, 6};
    for (const int reach : rings) {
        Points trial = refilled(patch, points, torn, reach);
        Indices left = torn_triangles(patch, trial);
        if (left.size() >= torn.size()) continue;
        points = std::move(trial);
        torn = std::move(left);
        return true;
    }
    return false;
}

bool try_elsewhere(const Patch& patch, Points& points, Indices& torn) {
    Points trial = points;
    for (const int v : corners_of(patch, torn)) {
        if (patch.is_free(v)) improve(patch, v, trial);
    }
    Indices left = torn_triangles(patch, trial);
    if (left.size() >= torn.size()) return false;
    points = std::move(trial);
    torn = std::move(left);
    return true;
}

}  // namespace

Indices torn_triangles(const Patch& patch, const Points& points) {
    Indices result = flipped_by_solution(patch, points);
    const Indices crossing = crossing_triangles(patch.triangles, points);
    result.insert(result.end(), crossing.begin(), crossing.end());
    keep_each_once(result);
    return result;
}

Points untorn(const Patch& patch, Points points) {
    constexpr std::size_t few = 100;  // to try one by one
    constexpr int most_rounds = 20;
    Indices torn = torn_triangles(patch, points);
    for (int round = 0; round < most_rounds && !torn.empty(); ++round) {
        if (fill_anew(patch, points, torn)) continue;
        if (torn.size() > few || !try_elsewhere(patch, points, torn)) break;
    }
    return points;
}

}  // namespace fairing
