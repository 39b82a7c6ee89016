// Where a fillet ends: the line on which the distance from a seam is its width.
#pragma once

#include "fillet/seam_distance.h"
#include "fillet/side_normals.h"

namespace fairing {

struct LinePoint {
    Vector3 place;
    int vertex;       // of the mesh that it is, or `none`;
    int edge;         // the number of the edge that it is on, as SeamMesh has it, or `none`:
    double along;     // then the distance from that edge's smaller vertex, as a share of 1
    int triangle;     // that it is in or beside,
    Vector3 weights;  // and where there
    [[nodiscard]] bool bound() const { return vertex != none || edge != none; }
};

// Within one triangle from point to point, the fillet on its left.
struct LineSegment {
    int from, to;
    int triangle;
};

struct LevelLine {
    std::vector<LinePoint> points;
    std::vector<LineSegment> segments;
};

// Found on triangles halved near the line until their edges are at most `resolution` long; each of its points is on the
// line to roundoff. Vertices nearer to the line than `snap` are on it. These and all spacings below are lengths where
// the fillet is widest, elsewhere in proportion to its width. Asks whether to stop.
LevelLine level_line(const SeamMesh& mesh, const SeamDistance& distance, double resolution, double snap);

// The same line with points about `spacing` apart where its side does not bend along it; elsewhere those that its shape
// needs, since chords of a bent side leave it. `sides` knows the triangles that the line passes.
LevelLine resampled(const SeamMesh& mesh, const SeamDistance& distance, const LevelLine& line, double spacing,
                    const SideNormals& sides);

// Where the line comes to a wall from both sides, its two points there become one if they are less than .3 spacings
// apart.
void join_at_walls(const SeamMesh& mesh, const SeamDistance& distance, double spacing, LevelLine& line);

// Adds points that part each seam into edges about `spacing` long, two at least where both ends are at walls: a new
// mesh needs a vertex to begin with.
void part_seams(const SeamMesh& mesh, const SeamDistance& distance, double spacing, LevelLine& line);
// The same for walls where the fillet ends and its side does not bend along them. `sides` knows their triangles.
void part_walls(const SeamMesh& mesh, const SeamDistance& distance, const SideNormals& sides, double spacing,
                LevelLine& line);

}  // namespace fairing
