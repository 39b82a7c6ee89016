// Which sizes take which ways.
#pragma once

#include "problem/problem.h"

namespace fairing {

// From so many free vertices it pays to begin on coarser levels, and a large patch is resolved best by its own mesh.
inline constexpr int smallest_nested = 1500;
// Free vertices of a coarsest level: solved from its outline alone it tells the surface over any outline that has one.
inline constexpr int coarsest_size = 600;
// Large moves wrinkle a fine mesh, and a coarse proxy makes them for less (measured on hemispheres: 1.2 times slower at
// 20k, 1.4 times faster at 40k; at 100k only the proxy gets there).
inline constexpr int largest_direct = 25000;

inline bool is_large(const Problem& problem) {
    return problem.options.nested && problem.patch.free_count > smallest_nested;
}

// Between two outlines: several surfaces may fit there, and a coarser mesh may lead from one to another.
inline bool is_tube(const Problem& problem) { return problem.patch.loop_count() == 2; }

}  // namespace fairing
