#include "cgal_fair.h"

#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Polygon_mesh_processing/fair.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/UmfPackSupport>

#include <stdexcept>
#include <vector>

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = Mesh::Vertex_index;
using Matrix = CGAL::Eigen_sparse_matrix<double>::EigenType;
using UmfPack = CGAL::Eigen_solver_traits<Eigen::UmfPackLU<Matrix>>;

Mesh make_mesh(const Points& vertices, const Triangles& triangles) {
    Mesh mesh;
    mesh.reserve(vertices.rows(), vertices.rows() + triangles.rows(), triangles.rows());
    for (const auto& row : vertices.rowwise()) {
        mesh.add_vertex({row[0], row[1], row[2]});
    }
    for (const auto& row : triangles.rowwise()) {
        if (mesh.add_face(Vertex(row[0]), Vertex(row[1]), Vertex(row[2])) == Mesh::null_face()) {
            throw std::runtime_error("not a manifold");
        }
    }
    return mesh;
}

bool fair(Mesh& mesh, const std::vector<Vertex>& free, CgalSolver solver) {
    namespace parameters = CGAL::parameters;
    namespace processing = CGAL::Polygon_mesh_processing;
    if (solver == CgalSolver::umfpack) {
        return processing::fair(mesh, free, parameters::fairing_continuity(1).sparse_linear_solver(UmfPack()));
    }
    return processing::fair(mesh, free, parameters::fairing_continuity(1));
}

}  // namespace

Points cgal_fair(const Points& vertices, const Triangles& triangles, const Indices& free, CgalSolver solver) {
    Mesh mesh = make_mesh(vertices, triangles);
    std::vector<Vertex> moving;
    moving.reserve(free.size());
    for (const int index : free) {
        moving.emplace_back(index);
    }
    if (!fair(mesh, moving, solver)) {
        throw std::runtime_error("CGAL's fair failed");
    }
    Points result(vertices.rows(), 3);
    for (const Vertex vertex : mesh.vertices()) {
        const auto& point = mesh.point(vertex);
        result.row(vertex.idx()) << point.x(), point.y(), point.z();
    }
    return result;
}
