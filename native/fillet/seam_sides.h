// Which side of a seam is which.
#pragma once

#include "fillet/seam_mesh.h"

namespace fairing {

// The same seams, directed so that the larger of the two parts beside each lies on its left: parts hang together across
// edges that are neither seams nor walls, and have an area. Seams within one part, or between parts of one size, run on
// from each other, the first as given.
std::vector<VertexPair> directed(const SeamMesh& mesh, const std::vector<VertexPair>& seams);

}  // namespace fairing
