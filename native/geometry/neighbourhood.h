// The vertices around one in a triangle list, by rings and by distance.
#pragma once

#include "base/types.h"
#include "mesh/patch.h"

namespace fairing {

// Adjacency of any triangle list, flat. A neighbour across an edge with two triangles is listed twice.
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

    // The result is small on a regular mesh; at fans it is cut at 60.
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

// Unit vertex normals (3 × points): the triangles' cross products summed and normalised; zero without triangles.
Points averaged_normals(const Points& points, const Triangles& triangles);

// Mean length of a patch's edges.
double mean_edge(const Patch& patch, const Points& points);

// The same over the edges at one vertex.
double mean_spoke(const Patch& patch, const Points& points, int vertex);

}  // namespace fairing
