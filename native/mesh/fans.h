// Fans: the corners of triangles that hang together around a vertex, across the edges that are not cut.
#pragma once

#include <unordered_map>

#include "base/types.h"
#include "mesh/twins.h"

namespace fairing {

// One cut vertex for each fan. Corner 3 t + k is corner k of triangle t.
struct Fans {
    Indices of_corner;
    Indices input_vertex;
};

// Joins the two corners at either end of twins, which may run the same way; so a fan is a chain or closed.
Fans join_corners(const Triangles& triangles, const Twins& twins);

// Triangles that share all three fans with another one: a pocket, which no half-edge mesh can hold.
Indices doubled_triangles(const Triangles& triangles, const EdgeTable& edges, const Fans& fans);

// The triangles of a list around some of its vertices, at the cost of these alone.
class Stars {
public:
    // Keeps a reference to the triangles.
    Stars(const Triangles& triangles, int vertex_count);

    [[nodiscard]] std::span<const int> at(int vertex) const;
    // Within so many rings of the vertices, ascending.
    [[nodiscard]] Indices around(const Indices& vertices, int rings) const;

private:
    const Triangles& triangles_;
    Indices begin_;
    Indices triangle_;
};

// Some triangles of a mesh with their vertices numbered anew: those named first, whatever their numbers in the mesh.
struct LocalMesh {
    Points points;
    Triangles triangles;
    Indices to_mesh;

    // `first`: they need no triangle. Precondition: `points` has them all.
    LocalMesh(const Eigen::Ref<const Points>& mesh_points, const Triangles& mesh_triangles, const Indices& chosen,
              const Indices& first);

    [[nodiscard]] int local(int vertex) const;  // of a vertex of the mesh; `none`: it is not here
    [[nodiscard]] Indices local(Indices vertices) const;
    [[nodiscard]] std::vector<std::array<int, 2>> local(const std::vector<std::array<int, 2>>& pairs) const;

private:
    std::unordered_map<int, int> numbers_;
};

}  // namespace fairing
