#include "method/blemishes.h"

#include <algorithm>

#include "base/difference.h"
#include "geometry/flips.h"
#include "geometry/self_intersection.h"
#include "problem/surface_state.h"

namespace fairing {

namespace {

constexpr double largest_bend = 2.0;  // of the largest |H| on the outline
constexpr double least_girth = 0.75;  // of what it comes from
constexpr double most_girth = 4.0 / 3.0;

Indices corners_of(const Patch& patch, const Indices& triangles) {
    Indices corners;
    for (const int t : triangles) {
        for (const int v : patch.triangles.col(t)) corners.push_back(v);
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    return corners;
}

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
      girths_(Girths::of(problem.patch, before, progress)) {}

Blemishes BlemishFinder::in(const Points& points) const {
    Blemishes found{torn(points), bent(points), {}, {}};
    if (!girths_) return found;
    found.narrow = corners_of(problem_.patch, girths_->narrow(points, least_girth));
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

}  // namespace fairing
