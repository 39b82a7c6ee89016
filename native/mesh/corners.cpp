#include "mesh/corners.h"

#include <algorithm>

namespace fairing {

namespace {

Indices each_once(Indices numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return numbers;
}

}  // namespace

Indices corners_of(const Patch& patch, const Indices& triangles) {
    Indices corners;
    corners.reserve(3 * triangles.size());
    for (const int t : triangles) {
        for (const int v : patch.triangles.col(t)) corners.push_back(v);
    }
    return each_once(std::move(corners));
}

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
