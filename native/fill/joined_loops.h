// Several boundary loops joined by one triangulation without inner vertices.
#pragma once

#include "base/types.h"

namespace fairing {

// Triangles over the vertices of the loops (columns of `points`), with the loops as their border; the surface lies on
// the left of each loop. One loop: the triangulation of least area. Several: a sphere with as many holes (two loops: a
// tube). Its triangles are those that cover each direction once, seen from between the loops, as far as they can. With
// normals of the vertices (3 × their count), whatever the loops: triangles that lean away from those at their corners
// cost up to twenty times as much, so that they go around a limb that the least area would close. Preconditions: three
// vertices or more in a loop, none of them twice.
Triangles joined_loops(const Points& points, const std::vector<Indices>& loops, const Points* normals = nullptr);

// Triangles over faces of 3 corners or more, `sizes` of them one after the other in `corners`: of each face size − 2,
// in the order of the faces, as near to its plane as can be, however concave it is.
Triangles triangulated_faces(const Points& points, const Indices& corners, const Indices& sizes);

}  // namespace fairing
