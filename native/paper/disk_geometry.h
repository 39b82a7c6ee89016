// 1-disks and what surrounds them, as the paper's construction sees them (§4, §6).
#pragma once

#include "geometry/virtual_points.h"

namespace fairing {

// Where virtual points (§6.2) complete the fit, besides valence 3 and 4 and the fixed vertices.
enum class VirtualPoints {
    sparse,     // nowhere else
    coarse,     // at every vertex of the coarse levels
    everywhere  // at every vertex of every level
};

// The 1-disk D(q_i) of a vertex, however the connectivity is stored. `ring.rim[k]` is the column of `arcs` below that
// belongs to the edge from neighbour k to k + 1; spokes are not read.
struct Disk {
    int centre = none;
    RingView ring;
    bool completed = false;  // a virtual point between every two consecutive neighbours joins the fit
};

// What disks are measured on: positions (3 × vertices) and, for each rim edge, the vector from the middle of its chord
// to its virtual point. Kept apart from the chord, it stays good enough while vertices move one after the other.
struct DiskField {
    const Points& points;
    const Points& arcs;
};

// Averages the cross products around the disk (§6). Zero when they cancel.
Vector3 disk_normal(const Disk& disk, const Points& points);

// The column of `arcs` for a chord.
Vector3 arc_over(const NormalChord& chord);

}  // namespace fairing
