// Levels of a patch from fine to coarse by half-edge collapses (paper §7.4).
#pragma once

#include "mesh/patch.h"

namespace fairing {

// `removed` moves onto `kept`; `left` and `right` are the vertices opposite to the edge: what a vertex split needs.
struct Collapse {
    int removed;
    int kept;
    int left;
    int right;
};

struct Hierarchy {
    std::vector<Collapse> collapses;     // in the order in which they were made, fine to coarse
    std::vector<Patch> patches;          // coarse to fine, without the finest, which is the patch itself;
                                         // their to_input counts the patch's own vertices
    std::vector<std::size_t> collapsed;  // how many collapses each of them has seen; 0 for the finest, at the end

    [[nodiscard]] int level_count() const { return static_cast<int>(collapsed.size()); }
    [[nodiscard]] bool is_finest(int level) const { return level + 1 == level_count(); }
};

// Numbers of free vertices of the levels, coarse to fine, growing exponentially. `levels`: as many, or 0 for about a
// factor of four each. The coarsest has no fewer than there are fixed ones, which stay on every level.
Indices level_sizes(int free_count, int fixed_count, int levels);

// Collapses free vertices, shortest edges first, so that the smallest edge is as long as possible; vetoes triangles
// whose inner circle is small against their longest edge, folds, and edges between fixed vertices. Topology is kept.
// `positions`: M0, 3 × local vertices. Vetoes may stop the collapses before the levels are as many or as small as
// asked.
Hierarchy build_hierarchy(const Patch& patch, const Points& positions, int levels);

}  // namespace fairing
