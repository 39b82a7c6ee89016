// Which half-edge collapses OpenMesh's decimater may try at all.
#pragma once

// clang-format off
#include "mesh/surface_mesh.h"
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
// clang-format on

namespace fairing {

using DecimationInfo = OpenMesh::Decimater::CollapseInfoT<SurfaceMesh>;

// Whether the half-edge collapse removes a free vertex (one that is not locked) and keeps the topology: the ends of the
// edge have no common neighbours but the two vertices opposite to it.
bool keeps_topology(const DecimationInfo& info);

}  // namespace fairing

// The framework's own test asks the library several times for each neighbour: half of the whole time. Only vertices
// with triangles all round are removed here, for which the link condition is enough.
template <>
inline bool OpenMesh::Decimater::BaseDecimaterT<fairing::SurfaceMesh>::is_collapse_legal(const CollapseInfo& info) {
    return fairing::keeps_topology(info);
}

// Observers live in a library of their own, which nothing else here needs; no observer is ever set.
template <>
inline bool OpenMesh::Decimater::BaseDecimaterT<fairing::SurfaceMesh>::notify_observer(size_t) {
    return true;
}
