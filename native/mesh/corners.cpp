#include "mesh/corners.h"

#include <algorithm>

namespace fairing {

namespace {

Indices each_once(Indices numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return numbers;
}

// What some triangles' columns of a table name.
Indices named_by(const Indices& triangles, const Triangles& table) {
    Indices named;
    named.reserve(3 * triangles.size());
    for (const int t : triangles) {
        for (const int number : table.col(t)) named.push_back(number);
    }
    return each_once(std::move(named));
}

}  // namespace

Indices corners_of(const Patch& patch, const Indices& triangles) { return named_by(triangles, patch.triangles); }

Indices edges_of(const Patch& patch, const Indices& triangles) { return named_by(triangles, patch.triangle_edges); }

Indices triangles_at(const Patch& patch, const Indices& vertices) {
    Indices triangles;
    for (const int v : vertices) {
        for (const int edge : patch.ring(v).spokes) {
            for (const int t : patch.edge_triangles[edge]) {
                if (t != none) triangles.push_back(t);
            }
        }
    }
    return each_once(std::move(triangles));
}

bool has_free_corner(const Patch& patch, int triangle) {
    return patch.triangles.col(triangle).minCoeff() < patch.free_count;
}

Indices with_free_corner(const Patch& patch, Indices triangles) {
    std::erase_if(triangles, [&](int t) { return !has_free_corner(patch, t); });
    return triangles;
}

}  // namespace fairing
