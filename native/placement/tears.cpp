#include "placement/tears.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "geometry/flips.h"
#include "geometry/self_intersection.h"
#include "mesh/corners.h"

namespace fairing {

namespace {

Indices united(const Indices& first, const Indices& second) {
    Indices all;
    std::set_union(first.begin(), first.end(), second.begin(), second.end(), std::back_inserter(all));
    return all;
}

// Of the triangles that were turned over those out of reach, and what is now turned over within it: a triangle is
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

}  // namespace fairing
