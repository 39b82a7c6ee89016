// The vertices around one in a triangle list, by rings and by distance.
#pragma once

#include "base/types.h"
#include "mesh/patch.h"

namespace fairing {

// Adjacency of any triangle list, flat. A neighbour across a two-sided edge stands there twice.
struct VertexAdjacency {
    Indices begin;
    Indices neighbours;

    VertexAdjacency(const Triangles& triangles, int vertex_count);
};

// A walk from a vertex along edges that stays within a ball, so that it does not cross gaps. Keeps references.
class BallWalk {
public:
    BallWalk(const VertexAdjacency& adjacency, const Points& points);
    // The vertices that it reaches, the centre first. Valid until the next call.
    const Indices& gather(int centre, double radius);

private:
    const VertexAdjacency& adjacency_;
    const Points& points_;
    Indices seen_;
    Indices reached_;
    int stamp_ = none;
};

// Rings are gathered up to `rings`, and on (to `most_rings`) until there are more points than `points`.
struct Reach {
    int rings;
    std::size_t points;
};

class Neighbourhood {
public:
    static constexpr int most_rings = 5;  // however few points they have

    // Keeps references.
    Neighbourhood(const VertexAdjacency& adjacency, const Points& points, Reach reach);

    void gather(int vertex);

    // Few where a mesh is regular: 60 at fans.
    [[nodiscard]] std::span<const Vector3> rings(int count) const;
    // `count` ≤ reach.points.
    [[nodiscard]] std::span<const Vector3> nearest(std::size_t count) const;

private:
    struct Distant {
        double squared;
        Vector3 point;
    };

    void visit_neighbours(int vertex);
    void sort_by_distance(const Vector3& centre);

    const VertexAdjacency& adjacency_;
    const Points& points_;
    Reach reach_;
    Indices mark_;
    int stamp_ = none;
    std::vector<std::size_t> size_of_rings_;  // of the first k rings together
    std::vector<Vector3> by_ring_;
    std::vector<Vector3> by_distance_;
    Indices visited_;                 // scratch
    std::vector<Distant> distances_;  // likewise
};

// At each vertex the sum of the triangles' cross products, of unit length (3 × points; zero where there is none).
Points averaged_normals(const Points& points, const Triangles& triangles);

// Mean length of a patch's edges.
double mean_edge(const Patch& patch, const Points& points);

// Of those at one vertex.
double mean_spoke(const Patch& patch, const Points& points, int vertex);

}  // namespace fairing
