#include "method/blemishes.h"

#include <algorithm>

#include "base/difference.h"
#include "geometry/flips.h"
#include "geometry/self_intersection.h"
#include "problem/surface_state.h"

namespace fairing {

namespace {

constexpr double largest_bend = 2.0;  // of the largest |H| on the outline
constexpr double least_girth = 0.5;   // of what it comes from

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
      sections_(CrossSections::of(problem.patch, progress)) {
    if (!sections_) return;
    girth_before_.resize(sections_->outline_count());
    for (int k = 0; k < sections_->outline_count(); ++k)
        girth_before_[k] = std::min(sections_->lengths(k, before).minCoeff(), sections_->outline_length(k, before));
}

Blemishes BlemishFinder::in(const Points& points) const { return {torn(points), bent(points), narrow(points)}; }

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

Indices BlemishFinder::narrow(const Points& points) const {
    Indices triangles;
    for (int k = 0; sections_ && k < sections_->outline_count(); ++k) {
        const VectorX lengths = sections_->lengths(k, points);
        for (int line = 0; line < lengths.size(); ++line) {
            if (lengths[line] >= least_girth * girth_before_[k]) continue;
            const Indices crossed = sections_->triangles(k, line);
            triangles.insert(triangles.end(), crossed.begin(), crossed.end());
        }
    }
    return corners_of(problem_.patch, triangles);
}

}  // namespace fairing
