#include "shape/kinks.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "geometry/dihedral_bands.h"
#include "mesh/collapsed.h"
#include "mesh/union_find.h"
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

}  // namespace fairing
