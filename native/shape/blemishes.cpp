#include "shape/blemishes.h"

#include <algorithm>

#include "base/difference.h"
#include "geometry/flips.h"
#include "geometry/self_intersection.h"
#include "mesh/corners.h"
#include "problem/surface_state.h"
#include "shape/limits.h"

namespace fairing {

namespace {

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

void append(const Indices& more, Indices& all) { all.insert(all.end(), more.begin(), more.end()); }

}  // namespace

BlemishFinder::BlemishFinder(const Problem& problem, const Points& before)
    : problem_(problem),
      crossing_before_(crossing_triangles(problem.patch.triangles, before)),
      turned_before_(flipped_by_solution(problem.patch, before)),
      bent_before_(largest_around(problem.patch, bend_of(problem, before))),
      sections_(CrossSections::of(problem.patch)) {
    for (int k = 0; sections_ && k < sections_->count(); ++k) {
        const VectorX own = sections_->radii(k, before);
        const VectorX expected = VectorX::LinSpaced(own.size(), own[0], own[own.size() - 1]);
        lesser_.emplace_back(own.cwiseMin(expected));
        larger_.emplace_back(own.cwiseMax(expected));
    }
}

Indices Blemishes::all() const {
    Indices result = torn;
    for (const Indices* more : {&bent, &narrow, &wide}) append(*more, result);
    return result;
}

Blemishes BlemishFinder::in(const Points& points) const {
    Blemishes found{torn(points), bent(points), {}, {}};
    if (sections_) add_uneven(points, found);
    return found;
}

void BlemishFinder::add_uneven(const Points& points, Blemishes& found) const {
    Indices narrow;
    Indices wide;
    for (int k = 0; k < sections_->count(); ++k) {
        const VectorX radii = sections_->radii(k, points);
        for (int section = 0; section < radii.size(); ++section) {
            if (radii[section] < waist * lesser_[k][section]) append(sections_->triangles(k, section), narrow);
            if (radii[section] > balloon * larger_[k][section]) append(sections_->triangles(k, section), wide);
        }
    }
    found.narrow = corners_of(problem_.patch, narrow);
    found.wide = corners_of(problem_.patch, wide);
}

Indices BlemishFinder::torn(const Points& points) const {
    const Patch& patch = problem_.patch;
    Indices triangles = without(crossing_triangles(patch.triangles, points), crossing_before_);
    append(without(flipped_by_solution(patch, points), turned_before_), triangles);
    return corners_of(patch, triangles);
}

Indices BlemishFinder::bent(const Points& points) const {
    const int count = problem_.patch.free_count;
    const VectorX bend = bend_of(problem_, points);
    const double most = sharp_bend * bend.tail(bend.size() - count).maxCoeff();
    Indices vertices;
    for (int v = 0; v < count; ++v) {
        if (bend[v] > std::max(most, bent_before_[v])) vertices.push_back(v);
    }
    return vertices;
}

}  // namespace fairing
