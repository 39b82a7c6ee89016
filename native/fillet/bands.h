// Bands beside seams: what of a fillet's border lies on either side of each seam, and how they meet at its ends.
#pragma once

#include "fillet/level_line.h"

namespace fairing {

// A seam from one meeting to the next: from vertices that two seams don't come to.
struct SeamArc {
    Indices half_edges;
    std::vector<double> stations;  // along it at each vertex, from 0
    bool closed;                   // comes back to its begin, which is no meeting
    [[nodiscard]] double length() const { return stations.back(); }
};

enum Side : std::size_t { right = 0, left = 1 };

struct BandSide {
    Indices vertices;              // of the border, in the arc's direction; those of a closed one begin anew at the end
    std::vector<double> stations;  // of their feet along the arc, not falling
};

struct Band {
    SeamArc arc;
    std::array<BandSide, 2> sides;  // empty where the border has none
    double width;                   // the least
};

struct BandEnd {
    int band;
    bool at_last;
    bool operator==(const BandEnd&) const = default;
};

// Between two ends of bands at one vertex, as the border runs: from the last vertex of the one's side to the first of
// the other's, both included.
struct Sector {
    BandEnd from, to;
    Indices chain;
    bool along_walls;  // none between is on the line
};

struct Bands {
    std::vector<Band> bands;
    std::vector<std::vector<Sector>> corners;  // the sectors around a vertex, where they close
};

// `loops`: of the fillet's border, its triangles on the left; `point_of`: of a vertex its point on the line, or `none`.
Bands bands_of(const SeamMesh& mesh, const SeamDistance& distance, const LevelLine& line,
               const std::vector<Indices>& loops, const Indices& point_of);

}  // namespace fairing
