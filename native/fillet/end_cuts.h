// Ends of seams on edges of a face: the fillet goes on through that face.
#pragma once

#include "fillet/cut_mesh.h"
#include "fillet/side_normals.h"

namespace fairing {

// The border of the fillet there, and the surface's unit normals.
struct EndSections {
    Indices vertices;
    std::vector<Vector3> normals;
    std::vector<Vector3> before;  // where these places were, along the edges
};

// Where a seam ends on an edge of a plane face, the cross-section in that face's plane, tangent to both sides, takes
// the place of the edges from line to line: the face loses what lies beyond it, or gains what lies before it. Other
// ends, and those for whose section the face has no room, stay as they are.
EndSections cut_ends(const SeamMesh& mesh, SideNormals& sides, SplitMesh& cut);

}  // namespace fairing
