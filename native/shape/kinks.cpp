#include "shape/kinks.h"

#include <map>

#include "base/columns.h"
#include "geometry/dihedral_bands.h"
#include "geometry/flips.h"
#include "geometry/self_intersection.h"
#include "mesh/loops.h"
#include "mesh/twins.h"
#include "mesh/union_find.h"
#include "problem/surface_state.h"
#include "shape/limits.h"

namespace fairing {

namespace {

// The vertices that share their place with others become one, the lowest of them.
struct Welded {
    Indices number;             // of each vertex
    std::vector<char> doubled;  // whether others are in the same place, for those that stay
};

Welded weld(const Points& points, Indices held) {
    Welded welded{Indices(static_cast<std::size_t>(points.cols())), {}};
    welded.doubled.resize(welded.number.size(), 0);
    std::iota(welded.number.begin(), welded.number.end(), 0);
    const auto before = [&](int a, int b) {
        for (int axis = 0; axis < 3; ++axis) {
            if (points(axis, a) != points(axis, b)) return points(axis, a) < points(axis, b);
        }
        return a < b;
    };
    std::sort(held.begin(), held.end(), before);
    for (std::size_t k = 1; k < held.size(); ++k) {
        if (points.col(held[k]) != points.col(held[k - 1])) continue;
        const int first = welded.number[held[k - 1]];
        welded.number[held[k]] = first;
        welded.doubled[first] = 1;
    }
    return welded;
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

void append(const Indices& more, Indices& all) { all.insert(all.end(), more.begin(), more.end()); }

}  // namespace

Indices seen_along(const std::vector<std::array<int, 2>>& edges, const Indices& vertices, const VectorX& degrees,
                   double limit) {
    std::map<int, int> place;
    for (std::size_t k = 0; k < vertices.size(); ++k) {
        if (degrees[static_cast<Eigen::Index>(k)] > limit) place[vertices[k]] = static_cast<int>(k);
    }
    UnionFind runs(static_cast<int>(vertices.size()));
    for (const auto& [a, b] : edges) {
        const auto first = place.find(a);
        const auto second = place.find(b);
        if (first != place.end() && second != place.end()) runs.join(first->second, second->second);
    }
    std::map<int, double> sums;
    for (const auto& [vertex, k] : place) sums[runs.root(k)] += degrees[k];
    Indices seen;
    for (const auto& [vertex, k] : place) {
        if (sums[runs.root(k)] >= kink_length * limit) seen.push_back(k);
    }
    std::sort(seen.begin(), seen.end());
    return seen;
}

Indices seam_kinks(const Points& points, const Triangles& triangles, const Indices& held, double limit) {
    const Welded welded = weld(points, held);
    if (std::find(welded.doubled.begin(), welded.doubled.end(), 1) == welded.doubled.end()) return {};
    Triangles joined = triangles.unaryExpr([&](int v) { return welded.number[v]; });
    joined = without_collapsed(joined);
    const DihedralBands bands(points, joined);
    DihedralBands::Walk walk = bands.walk();
    std::vector<std::array<int, 2>> seam;
    EdgeMeans means(points.cols());
    for (int e = 0; e < bands.edges().size(); ++e) {
        const auto [a, b] = bands.edges().ends[e];
        if (!welded.doubled[a] || !welded.doubled[b] || bands.edges().side_count(e) != 2) continue;
        seam.push_back({a, b});
        means.add({a, b}, bands.usual(a, b, walk).excess(bands.angle(e)), (points.col(a) - points.col(b)).norm());
    }
    Indices all(static_cast<std::size_t>(points.cols()));
    std::iota(all.begin(), all.end(), 0);
    VectorX degrees(points.cols());
    for (int v = 0; v < degrees.size(); ++v) degrees[v] = means[v];
    std::vector<char> seen(all.size(), 0);
    for (const int v : seen_along(seam, all, degrees, limit)) seen[v] = 1;
    std::erase_if(all, [&](int v) { return !seen[welded.number[v]]; });
    return all;
}

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
