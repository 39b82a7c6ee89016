#include "placement/tears.h"

#include "base/parallel.h"
#include "geometry/flips.h"
#include "geometry/neighbourhood.h"
#include "geometry/self_intersection.h"
#include "geometry/triangle.h"
#include "mesh/loops.h"
#include "placement/relax.h"

namespace fairing {

namespace {

Indices united(const Indices& first, const Indices& second) {
    Indices all;
    std::set_union(first.begin(), first.end(), second.begin(), second.end(), std::back_inserter(all));
    return all;
}

// The triangles turned over before that are out of reach, and what is now turned over within it: a triangle is
// compared with the normals at its corners, and these change with the triangles around them.
Indices turned_after(const Patch& patch, const Points& points, const Indices& turned, const Indices& moved) {
    const Indices reach = triangles_at(patch, corners_of(patch, triangles_at(patch, moved)));
    Indices kept;
    std::set_difference(turned.begin(), turned.end(), reach.begin(), reach.end(), std::back_inserter(kept));
    Indices now;
    for (const int t : reach) {
        if (has_free_corner(patch, t) && is_flipped(patch, points, t)) now.push_back(t);
    }
    return united(kept, now);
}

Indices numbers(const std::vector<char>& mask) {
    Indices result;
    for (std::size_t t = 0; t < mask.size(); ++t) {
        if (mask[t]) result.push_back(static_cast<int>(t));
    }
    return result;
}

// The free ones that lie elsewhere now.
Indices moved_between(const Patch& patch, const Points& before, const Points& now) {
    Indices moved;
    for (int v = 0; v < patch.free_count; ++v) {
        if (before.col(v) != now.col(v)) moved.push_back(v);
    }
    return moved;
}

// The torn ones around one vertex, wherever that moves.
class Around {
public:
    Around(const Patch& patch, int v) : patch_(patch) {
        Indices near = triangles_at(patch, {v});
        near = triangles_at(patch, corners_of(patch, near));
        turning_ = with_free_corner(patch, near);
        for (int k = 0; k < 2; ++k) near = triangles_at(patch, corners_of(patch, near));
        triangles_ = patch.triangles(Eigen::all, near);
    }

    // `enough`: from there on it doesn't matter.
    [[nodiscard]] std::ptrdiff_t torn(const Points& points, std::ptrdiff_t enough) const {
        const auto turned =
            std::count_if(turning_.begin(), turning_.end(), [&](int t) { return is_flipped(patch_, points, t); });
        return turned >= enough ? turned : turned + std::ssize(crossing_triangles(triangles_, points));
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
    std::ptrdiff_t least = around.torn(points, std::numeric_limits<std::ptrdiff_t>::max());
    const Vector3 centre = points.col(v);
    const double reach = mean_spoke(patch, points, v);
    Vector3 best = centre;
    for (const double radius : radii) {
        for (int k = 0; k < 27 && least > 0; ++k) {  // of a cube's surface
            const Eigen::Vector3i corner(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
            points.col(v) = centre + radius * reach * corner.cast<double>().normalized();
            const std::ptrdiff_t torn = around.torn(points, least);
            if (torn >= least) continue;
            least = torn;
            best = points.col(v);
        }
    }
    points.col(v) = best;
    return best != centre;
}

// Takes a surface that has less torn triangles.
bool take(const Patch& patch, Points trial, Points& points, Tears& tears) {
    Tears left = tears.after(trial, moved_between(patch, points, trial));
    if (left.count() >= tears.count()) return false;
    points = std::move(trial);
    tears = std::move(left);
    return true;
}

// Wider and wider around what is torn, for as long as that leaves less of it.
bool fill_anew(const Patch& patch, Points& points, Tears& tears) {
    constexpr std::array rings{1, 2, 3, 4, 6};  // around the tear
    return std::any_of(rings.begin(), rings.end(), [&](int reach) {
        return take(patch, refilled(patch, points, tears.triangles(), reach), points, tears);
    });
}

bool try_elsewhere(const Patch& patch, Points& points, Tears& tears) {
    Points trial = points;
    for (const int v : corners_of(patch, tears.triangles())) {
        if (patch.is_free(v)) improve(patch, v, trial);
    }
    return take(patch, std::move(trial), points, tears);
}

}  // namespace

Indices torn_triangles(const Patch& patch, const Points& points) { return Tears(patch, points).triangles(); }

Tears::Tears(const Patch& patch, const Points& points)
    : Tears(patch, flipped_by_solution(patch, points), crossing_triangles(patch.triangles, points)) {}

Tears::Tears(const Patch& patch, Indices turned, Indices crossing)
    : patch_(&patch), turned_(std::move(turned)), crossing_(std::move(crossing)), torn_(united(turned_, crossing_)) {}

Tears Tears::after(const Points& points, const Indices& moved) const {
    // A pair that crosses now has a triangle that moved, or crossed before.
    const Indices changed = united(triangles_at(*patch_, moved), crossing_);
    return {*patch_, turned_after(*patch_, points, turned_, moved), crossings_with(patch_->triangles, points, changed)};
}

bool is_folded(const Problem& problem, const TargetSurface& target, const Placement& placement, int t) {
    const auto corners = problem.patch.triangles.col(t);
    Vector3 around = Vector3::Zero();
    for (const int v : corners) {
        if (problem.patch.is_free(v)) around += target.face_normal(placement.where[v].triangle);
    }
    return area_vector(placement.points, corners).dot(around) < 0.0;
}

std::vector<char> folded_mask(const Problem& problem, const TargetSurface& target, const Placement& placement) {
    std::vector<char> folded(problem.patch.triangle_count(), 0);
    for_ranges(problem.patch.triangle_count(), coarse_grain, [&](int begin, int end) {
        for (int t = begin; t < end; ++t) folded[t] = is_folded(problem, target, placement, t) ? 1 : 0;
    });
    return folded;
}

Indices folded_triangles(const Problem& problem, const TargetSurface& target, const Placement& placement) {
    std::vector<char> folded = folded_mask(problem, target, placement);
    for (const int t : flipped_by_solution(problem.patch, placement.points)) folded[t] = 1;
    return numbers(folded);
}

Indices folds_of_placement(const Problem& problem, const TargetSurface& target, const Placement& placement) {
    std::vector<char> folded = folded_mask(problem, target, placement);
    for (const int t : flipped_by_solution(problem.patch, placement.points)) {
        const bool at_boundary = problem.patch.triangles.col(t).maxCoeff() >= problem.patch.free_count;
        if (!at_boundary) folded[t] = 1;
    }
    return numbers(folded);
}

Points untorn(const Patch& patch, Points points) {
    constexpr std::size_t few = 100;  // to try one by one
    Tears tears(patch, points);
    while (tears.count() > 0) {
        if (fill_anew(patch, points, tears)) continue;
        if (tears.count() > few || !try_elsewhere(patch, points, tears)) break;
    }
    return points;
}

}  // namespace fairing
