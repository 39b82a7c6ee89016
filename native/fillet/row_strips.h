// Strips beside seams, from line to line, and the columns of quads across them.
#pragma once

#include "fillet/seam_walk.h"

namespace fairing {

// A point of the line, or a place within one of its segments.
struct Spot {
    Vector3 place;
    int point;    // or `none`:
    int segment;  // within that one
};

// Some of the line.
struct LinePart {
    std::vector<Spot> spots;
    Indices segments;          // from one spot to the next; `none` over walls
    std::vector<double> ways;  // along it

    void measure();
    void reverse();
    [[nodiscard]] Spot at(double way) const;
    [[nodiscard]] double length() const { return ways.back(); }
};

enum Side : std::size_t { right = 0, left = 1 };

struct Column {
    double way;                // along the arc,
    std::array<double, 2> at;  // and along the line on both sides
};

struct Strip {
    SeamArc arc;
    std::array<LinePart, 2> sides;  // in the arc's direction
    std::vector<Column> columns;
    [[nodiscard]] Spot spot(const Column& column, Side side) const { return sides[side].at(column.at[side]); }
};

// The tail of a walk's half-edge where seams meet, or end.
struct RowCorner {
    int walk, index;
    bool walled;                    // the line ends at walls there
    LinePart around;                // a long way around it, as the walk runs; empty where both sides meet in one spot
    std::array<LinePart, 2> turns;  // likewise long ways around a walled one, to the walls and from them on
};

struct RowStrips {
    std::vector<Strip> strips;  // of each arc
    std::vector<RowCorner> corners;
};

struct RowSizes {
    double width;    // the least
    double spacing;  // of columns: nearer ones come together
};

// `must`: of each point of the line, whether the mesh outside needs a vertex there. Throws NoRows.
RowStrips row_strips(const SeamMesh& mesh, const SeamWalks& walks, const LevelLine& line, const std::vector<char>& must,
                     const RowSizes& sizes);

}  // namespace fairing
