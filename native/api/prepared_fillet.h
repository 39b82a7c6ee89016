// What all calls about a fillet begin with.
#pragma once

#include "api/fillet.h"
#include "fillet/side_normals.h"

namespace fairing {

// A mesh without what stops a cut at its seams: edges of no length, whose ends go apart, and caps.
struct PreparedFillet {
    explicit PreparedFillet(const FilletInput& given);
    PreparedFillet(const PreparedFillet&) = delete;
    PreparedFillet& operator=(const PreparedFillet&) = delete;

    FilletInput input;
    Indices plane;  // of each triangle: one given in whose plane it is
    SeamMesh mesh;
    SeamDistance distance;
    SideNormals sides;
    double least_width;
};

// A place on one of the triangles given.
struct GivenPlace {
    int triangle;
    Vector3 weights;
};
GivenPlace given_place(const FilletInput& given, const PreparedFillet& made, int triangle, const Vector3& place);

// Where the fillet is narrowest.
double finest_spacing(const FilletInput& input);
// Where it is cut.
LevelLine fillet_line(PreparedFillet& made);
// Finds what of a cut is not its mesh.
void finish_cut(const FilletInput& given, PreparedFillet& made, FilletCut& cut);

}  // namespace fairing
