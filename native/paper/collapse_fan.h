// The triangles around a vertex that may be removed, and what they would become (paper §7.4).
#pragma once

#include "base/types.h"

namespace fairing {

class CollapseFan {
public:
    // Starts a fan; its neighbours follow, all round.
    void start(const Vector3& centre);
    void add(const Vector3& neighbour) { points_.push_back(neighbour); }
    // Measures the triangles as they are.
    void close();

    // Priority of moving the centre onto `target`, one of the neighbours: the length of that edge, so that the shortest
    // goes first, weighted by the shape of the worst new triangle. Negative where a triangle would be turned over or
    // distorted, or where it can't be better than the best one asked for since `start`.
    double priority(const Vector3& target);

private:
    // Roundness of the worst new triangle; negative as above.
    [[nodiscard]] double worst_after(const Vector3& target, double length);

    Vector3 centre_;
    double worst_ = 1.0;  // roundness of the present triangles
    double best_ = 0.0;   // priority
    std::vector<Vector3> points_;
    std::vector<double> rim_;          // length of the edge from neighbour k to k + 1
    std::vector<Vector3> normals_;     // unit, of the triangle at that edge
    std::vector<double> from_target_;  // distances of the neighbours from the one that is tried
};

}  // namespace fairing
