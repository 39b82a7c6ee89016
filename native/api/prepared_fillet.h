// What all calls about a fillet begin with.
#pragma once

#include "api/fillet.h"
#include "fillet/side_normals.h"

namespace fairing {

// The input with what would stop the cut removed: zero-length seam edges (their ends are moved apart) and caps at
// seams.
struct PreparedFillet {
    explicit PreparedFillet(const FilletInput& given);
    PreparedFillet(const PreparedFillet&) = delete;
    PreparedFillet& operator=(const PreparedFillet&) = delete;

    FilletInput input;
    Indices plane;  // of each triangle: the given triangle in whose plane it lies
    SeamMesh mesh;
    double largest_width;
    SeamDistance distance;
    SideNormals sides;
};

// A place on one of the triangles given.
struct GivenPlace {
    int triangle;
    Vector3 weights;
};
GivenPlace given_place(const FilletInput& given, const PreparedFillet& made, int triangle, const Vector3& place);

// The spacing of new edges where the fillet is narrowest.
double finest_spacing(const FilletInput& input);
// The lines along which the mesh is cut: where the fillet ends.
LevelLine fillet_line(PreparedFillet& made);
// Fills in all of a cut but its mesh: boundary, spacings, weights.
void finish_cut(const FilletInput& given, PreparedFillet& made, FilletCut& cut);

}  // namespace fairing
