// A half-edge mesh whose connectivity changes: OpenMesh with double-precision Eigen points. Only the proxy's mesh and
// the paper's hierarchy need one; Patch has arrays of its own.
#pragma once

// clang-format off
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>  // must follow the mesh header
// clang-format on

#include "mesh/patch.h"

namespace fairing {

struct SurfaceMeshTraits : OpenMesh::DefaultTraits {
    using Point = Eigen::Vector3d;
    using Normal = Eigen::Vector3d;
    VertexAttributes(OpenMesh::Attributes::None);
    HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
    FaceAttributes(OpenMesh::Attributes::None);
    EdgeAttributes(OpenMesh::Attributes::None);
};

using SurfaceMesh = OpenMesh::TriMesh_ArrayKernelT<SurfaceMeshTraits>;

// The connectivity of a patch, without positions; vertex, edge and face indices agree.
SurfaceMesh surface_mesh(const Patch& patch);

// The faces not deleted, in their order. `number`: vertex → its number in the result.
Triangles triangles_of(const SurfaceMesh& mesh, const Indices& number);

}  // namespace fairing
