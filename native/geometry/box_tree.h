// A tree of bounding boxes, which finds the pairs of triangles that may cross.
#pragma once

#include "base/types.h"

namespace fairing {

class SettledNodes;

// Four children to each node, the triangles halved in turn by the place of their centres.
class BoxTree {
public:
    BoxTree(const Triangles& triangles, const Points& points);

    // Receives one triangle and up to four others; returns true where one of them is done: all that is asked is known.
    using Visit = std::function<bool(int, std::span<const int>)>;
    using IsSettled = std::function<bool(int)>;
    // Visits each pair whose boxes overlap once; boxes that only touch don't count, nor do triangles that are not
    // finite. Pairs of two triangles that are done may be skipped (n coincident triangles have n² / 2 pairs). Several
    // threads, any order.
    void for_overlaps(const Visit& visit, const IsSettled& is_settled) const;

private:
    using Four = Eigen::Array4d;
    // Four boxes, coordinate by coordinate.
    struct Boxes {
        std::array<Four, 3> least;
        std::array<Four, 3> most;
    };
    // Two nodes of a level, or one twice.
    struct Pair {
        int first;
        int second;
    };
    struct Walk {
        const Visit& visit;
        const IsSettled& is_settled;
        SettledNodes& nodes;
    };

    void add_triangles(const Triangles& triangles, const Points& points);
    void add_level();
    template <typename Take>
    void compare(int level, const Pair& pair, const Take& take) const;
    template <typename Take>
    void split(int level, const Pair& pair, const Take& take) const;
    void descend(int level, const Pair& pair, const Walk& walk) const;
    void visit_triangles(const Pair& pair, const Walk& walk) const;
    [[nodiscard]] bool is_settled(int leaf, const IsSettled& is_settled) const;

    Indices order_;  // of the triangles
    // From the leaves up. Child k of node i is node 4 i + k of the level below, its box the k-th of the node's.
    std::vector<std::vector<Boxes>> levels_;
};

}  // namespace fairing
