// A fillet's cross-section at the end of a seam.
#pragma once

#include "fillet/cut_mesh.h"

namespace fairing {

// What takes the place of a chain of edges: for each of its vertices another place, but for both ends.
struct EndSection {
    [[nodiscard]] Indices numbers() const;  // of its places

    Indices chain;                         // the fillet on its left
    std::vector<Vector3> places, normals;  // of the surface, unit
    Vector3 plane;                         // unit normal of the face on the chain's right
    int first_new = none;
    Indices vertices;                     // those in the mesh, with those where the face's edges cross the section,
    std::vector<Vector3> vertex_normals;  // the normals there, and where they were along the chain; none where the face
    std::vector<Vector3> before;          // has no room
};

// What becomes of a face.
struct FaceChange {
    struct PathPoint {
        double at;  // along the section, in its pieces
        int vertex;
        bool operator<(const PathPoint& other) const { return at < other.at; }
    };
    std::vector<std::vector<PathPoint>> paths;  // of each section
    std::vector<Vector3> added;                 // where edges are crossed
    Indices gone;                               // triangles given, of which nothing stays but these
    std::vector<std::array<int, 3>> pieces;
    Indices parents;
};

}  // namespace fairing
