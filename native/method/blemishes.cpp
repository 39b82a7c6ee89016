#include "method/blemishes.h"

#include <algorithm>

#include "base/difference.h"
#include "geometry/flips.h"
#include "geometry/self_intersection.h"
#include "mesh/corners.h"
#include "problem/surface_state.h"

namespace fairing {

namespace {

constexpr double largest_bend = 2.0;  // of the largest |H| on the outline
constexpr double least_girth = 0.75;  // of what it comes from
constexpr double least_width = 0.94;  // of flat sections: the edges of wings were drawn in to .80 to .92 elsewhere
constexpr double most_girth = 4.0 / 3.0;
constexpr double least_bluntness = 0.7;
constexpr double most_blunt = 0.6;   // what is blunter counts as that: pieces of a wall have 2 / π and more, by width
constexpr double least_reach = 0.2;  // of what sticks out, of what it was; less is as good as gone

// The largest value at each vertex and its neighbours.
VectorX largest_around(const Patch& patch, const VectorX& values) {
    VectorX result = values;
    for (int v = 0; v < patch.vertex_count(); ++v) {
        for (const int w : patch.ring(v).vertices) result[v] = std::max(result[v], values[w]);
    }
    return result;
}

VectorX bend_of(const Problem& problem, const Points& points) {
    return measured_surface(problem, points).curvature.mean.cwiseAbs();
}

}  // namespace

BlemishFinder::BlemishFinder(const Problem& problem, const Points& before, const Progress& progress)
    : problem_(problem),
      crossing_before_(crossing_triangles(problem.patch.triangles, before)),
      turned_before_(flipped_by_solution(problem.patch, before)),
      bent_before_(largest_around(problem.patch, bend_of(problem, before))),
      girths_(Girths::of(problem.patch, before, progress)),
      protrusions_(Protrusions::of(problem.patch, progress)) {
    if (!protrusions_) return;
    reaches_before_ = protrusions_->reaches(before);
    blunt_before_ = protrusions_->bluntness(before);
}

Indices Blemishes::all() const {
    Indices result = torn;
    for (const Indices* more : {&bent, &narrow, &wide, &thin}) result.insert(result.end(), more->begin(), more->end());
    return result;
}

Blemishes BlemishFinder::in(const Points& points) const {
    Blemishes found{torn(points), bent(points), {}, {}, thin(points)};
    if (!girths_) return found;
    Indices narrow = girths_->narrow(points, least_girth);
    const Indices slim = girths_->slim(points, least_width);
    narrow.insert(narrow.end(), slim.begin(), slim.end());
    found.narrow = corners_of(problem_.patch, narrow);
    found.wide = corners_of(problem_.patch, girths_->wide(points, most_girth));
    return found;
}

Indices BlemishFinder::torn(const Points& points) const {
    const Patch& patch = problem_.patch;
    Indices triangles = without(crossing_triangles(patch.triangles, points), crossing_before_);
    const Indices turned = without(flipped_by_solution(patch, points), turned_before_);
    triangles.insert(triangles.end(), turned.begin(), turned.end());
    return corners_of(patch, triangles);
}

Indices BlemishFinder::bent(const Points& points) const {
    const int count = problem_.patch.free_count;
    const VectorX bend = bend_of(problem_, points);
    const double most = largest_bend * bend.tail(bend.size() - count).maxCoeff();
    Indices vertices;
    for (int v = 0; v < count; ++v) {
        if (bend[v] > std::max(most, bent_before_[v])) vertices.push_back(v);
    }
    return vertices;
}

Indices BlemishFinder::thin(const Points& points) const {
    if (!protrusions_) return {};
    const VectorX reaches = protrusions_->reaches(points);
    const VectorX blunt = protrusions_->bluntness(points);
    Indices triangles;
    for (int k = 0; k < protrusions_->count(); ++k) {
        if (blunt[k] >= least_bluntness * std::min(blunt_before_[k], most_blunt)) continue;
        if (reaches[k] < least_reach * reaches_before_[k]) continue;
        const Indices& cap = protrusions_->triangles(k);
        triangles.insert(triangles.end(), cap.begin(), cap.end());
    }
    return corners_of(problem_.patch, triangles);
}

}  // namespace fairing
