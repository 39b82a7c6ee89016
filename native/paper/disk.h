// One-rings as the paper's construction sees them, however the connectivity is stored.
#pragma once

#include <span>

#include "mesh/patch.h"

namespace fairing {

// The 1-disk D(q_i) of a vertex (paper §4), counter-clockwise, and what lies beyond its rim.
struct Disk {
    int centre = none;
    std::span<const int> neighbours;
    // apexes[k]: third vertex of the other triangle at the rim edge from neighbour k to k + 1; `none` where there is no
    // such triangle. As many entries as neighbours; the last one of an open disk is unused.
    std::span<const int> apexes;
    bool closed = true;

    [[nodiscard]] std::size_t valence() const { return neighbours.size(); }
    [[nodiscard]] std::size_t rim_size() const { return closed ? valence() : valence() - 1; }
};

// The disks of all vertices of a patch.
class DiskTable {
public:
    explicit DiskTable(const Patch& patch);
    [[nodiscard]] Disk operator[](int vertex) const;

private:
    const Patch& patch_;
    Indices begin_{0};
    Indices apexes_;
};

}  // namespace fairing
