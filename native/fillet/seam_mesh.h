// The triangles around seams, as half-edges that know where walls and borders end the surface.
#pragma once

#include <Eigen/Core>

#include "base/types.h"
#include "mesh/edges.h"
#include "mesh/union_find.h"

namespace fairing {

using Vector2 = Eigen::Vector2d;
using VertexPair = std::array<int, 2>;

// Weights of a place in the plane of a triangle.
Vector3 barycentric(const Points& points, const Triangles& triangles, int triangle, const Vector3& place);

inline double cross2(const Vector2& a, const Vector2& b) { return a[0] * b[1] - a[1] * b[0]; }

// Half-edge 3 t + k runs from corner k to corner k + 1 of triangle t. Its frame has the origin at its tail, x along it
// and y into the triangle.
struct SeamMesh {
    // `walls`: edges that distances do not cross. So are borders, edges of three triangles and more, and those between
    // triangles wound against each other. `seams`: directed pairs; those that are no edges between two triangles, or
    // walls, are left out. The arguments must outlive the mesh.
    SeamMesh(const Points& points, const Triangles& triangles, const std::vector<VertexPair>& seams,
             const std::vector<VertexPair>& walls);

    const Points& points;
    const Triangles& triangles;
    Indices edge;            // of each half-edge: a number that both sides share, walls too
    Indices twin;            // the half-edge on the other side; `none` at walls and borders
    Indices seam;            // of each half-edge: the seam that it belongs to, or `none`
    std::vector<char> left;  // of each half-edge on a seam: whether it runs as that does, its triangle on the left
    Indices sheet;           // of each corner: its vertex, numbered anew where walls part the corners around
    int sheet_count = 0;
    std::vector<double> length;   // of each half-edge
    std::vector<Vector2> apex;    // the third corner in each half-edge's frame
    std::vector<double> opening;  // the triangle's angle at each half-edge's tail, radians

    // Turns the seams: pairs in the order in which they were given.
    void redirect(const std::vector<VertexPair>& seams);

    [[nodiscard]] int half_edge_count() const { return static_cast<int>(edge.size()); }
    [[nodiscard]] int tail(int h) const { return triangles(h % 3, h / 3); }
    [[nodiscard]] int head(int h) const { return triangles((h + 1) % 3, h / 3); }
    [[nodiscard]] static int next(int h) { return h - h % 3 + (h + 1) % 3; }
    [[nodiscard]] static int previous(int h) { return h - h % 3 + (h + 2) % 3; }
    // The next half-edge with the same tail, counter-clockwise or clockwise; `none` beyond a wall.
    [[nodiscard]] int turned(int h) const { return twin[previous(h)]; }
    [[nodiscard]] int turned_back(int h) const { return twin[h] == none ? none : next(twin[h]); }
    // The triangles between seams, walls and borders.
    [[nodiscard]] UnionFind parts() const;
    // In the frame of half-edge h: the place with these barycentric weights in its triangle.
    [[nodiscard]] Vector2 in_frame(int h, const Vector3& weights) const;
    [[nodiscard]] Vector3 weights_at(int h, const Vector2& in_frame) const;  // for h the first of its triangle
    [[nodiscard]] Vector3 place(int triangle, const Vector3& weights) const;

private:
    void pair_up(const EdgeTable& table, const std::vector<VertexPair>& walls);
    void mark(const EdgeTable& table, const std::vector<VertexPair>& seams);
    void measure();
    void number_sheets();
};

}  // namespace fairing
