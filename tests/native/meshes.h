// Small meshes for the unit tests.
#pragma once

#include <functional>

#include "geometry/face_geometry.h"
#include "mesh/patch.h"

namespace fairing::test {

struct Mesh {
    Points points;
    Triangles triangles;
};

// (n + 1)² vertices over the unit square, split along alternating diagonals; inner ones moved by `jitter` of the
// spacing.
Mesh grid(int n, double jitter, const std::function<Vector3(double, double)>& surface, bool alternate = true);

// The square itself.
Vector3 flat(double u, double v);
// Part of the unit sphere around (0, 0, 1), normals outward.
Vector3 sphere(double u, double v);

// The only patch of a mesh whose border is fixed, and the vertices marked in `given`, if any.
struct Single {
    VertexRoles roles;
    CutMesh cut;
    std::vector<Patch> patches;
    Points points;  // local
    [[nodiscard]] const Patch& patch() const { return patches.front(); }
};
Single single_patch(const Mesh& mesh, std::vector<char> given = {});

// Moves so many free vertices, apart from each other, through an edge of the boundary and half as far beyond.
void push_beyond_boundary(const Patch& patch, int count, Points& points);

Stiffness stiffness_of(const Single& single);
// S, all vertices.
Eigen::MatrixXd dense(const Patch& patch, const Stiffness& stiffness);

}  // namespace fairing::test
