// The same mesh with its vertices, edges and faces in an order that keeps neighbours near in memory.
#pragma once

#include "mesh/surface_mesh.h"

namespace fairing {

// `vertices` and `edges`: the old numbers in their new order, all that are not deleted; those deleted may be among
// them and stay so. Half-edges keep their directions; faces come in the order of their edges. All need a status.
SurfaceMesh renumbered(const SurfaceMesh& mesh, const Indices& vertices, const Indices& edges);

}  // namespace fairing
