#include "mesh/surface_mesh.h"

#include "base/columns.h"

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

Triangles triangles_of(const SurfaceMesh& mesh, const Indices& number) {
    std::vector<Eigen::Vector3i> triangles;
    for (const SurfaceMesh::FaceHandle f : mesh.faces()) {
        Eigen::Vector3i& corners = triangles.emplace_back();
        int k = 0;
        for (const SurfaceMesh::VertexHandle v : mesh.fv_ccw_range(f)) corners[k++] = number[v.idx()];
    }
    return as_columns(triangles);
}

}  // namespace fairing
