#include "shape/kinks.h"

#include "base/columns.h"
#include "geometry/dihedral_bands.h"
#include "geometry/flips.h"
#include "geometry/self_intersection.h"
#include "mesh/loops.h"
#include "mesh/twins.h"
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

Indices seen_along(const VectorX& degrees, double limit) {
    Indices seen;
    for (int k = 0; k < static_cast<int>(degrees.size()); ++k) {
        if (degrees[k] > limit) seen.push_back(k);
    }
    return static_cast<double>(seen.size()) > kink_share * static_cast<double>(degrees.size()) ? seen : Indices{};
}

Indices seam_kinks(const Points& points, const Triangles& triangles, const Indices& held, double limit) {
    const Welded welded = weld(points, held);
    if (std::find(welded.doubled.begin(), welded.doubled.end(), 1) == welded.doubled.end()) return {};
    Triangles joined = triangles.unaryExpr([&](int v) { return welded.number[v]; });
    joined = without_collapsed(joined);
    const DihedralBands bands(points, joined);
    DihedralBands::Walk walk = bands.walk();
    EdgeMeans means(points.cols());
    std::vector<char> on_seam(welded.doubled.size(), 0);
    for (int e = 0; e < bands.edges().size(); ++e) {
        const auto [a, b] = bands.edges().ends[e];
        if (!welded.doubled[a] || !welded.doubled[b] || bands.edges().side_count(e) != 2) continue;
        on_seam[a] = on_seam[b] = 1;
        means.add({a, b}, bands.usual(a, b, walk).excess(bands.angle(e)), (points.col(a) - points.col(b)).norm());
    }
    Indices all(on_seam.size());
    std::iota(all.begin(), all.end(), 0);
    Indices seam;
    std::copy_if(all.begin(), all.end(), std::back_inserter(seam), [&](int v) { return on_seam[v] != 0; });
    VectorX degrees(static_cast<Eigen::Index>(seam.size()));
    for (Eigen::Index k = 0; k < degrees.size(); ++k) degrees[k] = means[seam[k]];
    std::vector<char> seen(all.size(), 0);
    for (const int k : seen_along(degrees, limit)) seen[seam[k]] = 1;
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
