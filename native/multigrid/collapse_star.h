// The star of a vertex, from which a half-edge collapse is judged.
#pragma once

#include <numeric>

#include "base/types.h"

namespace fairing {

// Sides of triangle t: 3t + k runs from corner k to corner k + 1.
inline int next_side(int s) { return s % 3 == 2 ? s - 2 : s + 1; }
inline int previous_side(int s) { return s % 3 == 0 ? s + 2 : s - 1; }

// The neighbours of a vertex counter-clockwise, with the sides that lead there; the last of an open star has none.
struct Star {
    int centre = none;
    bool closed = true;
    Indices vertices;
    Indices sides;
    std::vector<double> weights;
    std::vector<double> prices;  // scratch: what collapses onto each neighbour cost
    std::vector<double> passed;  // scratch: new weights to the vertex kept
    Indices around;              // scratch: neighbours of the vertex kept

    [[nodiscard]] std::size_t size() const { return vertices.size(); }
    [[nodiscard]] double weight() const { return std::accumulate(weights.begin(), weights.end(), 0.0); }
    // Whether neighbours k and k + 1 (cyclic) span a triangle with the centre.
    [[nodiscard]] bool has_triangle(std::size_t k) const { return closed || k + 1 < size(); }
    [[nodiscard]] std::size_t after(std::size_t k) const { return k + 1 == size() ? 0 : k + 1; }
    [[nodiscard]] std::size_t before(std::size_t k) const { return k == 0 ? size() - 1 : k - 1; }
};

}  // namespace fairing
