#include "mesh/surface_mesh.h"

namespace fairing {

SurfaceMesh surface_mesh(const Patch& patch) {
    SurfaceMesh mesh;
    const auto vertices = static_cast<std::size_t>(patch.vertex_count());
    mesh.reserve(vertices, patch.edge_count(), patch.triangle_count());
    for (std::size_t v = 0; v < vertices; ++v) mesh.add_vertex(SurfaceMesh::Point::Zero());
    for (const auto corners : patch.triangles.colwise()) {
        const auto corner = [&](int k) { return mesh.vertex_handle(static_cast<unsigned>(corners[k])); };
        mesh.add_face(corner(0), corner(1), corner(2));
    }
    return mesh;
}

}  // namespace fairing
