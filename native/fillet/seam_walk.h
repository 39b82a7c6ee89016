// Ways around the seams, and the line where a fillet ends in the order in which these reach it.
#pragma once

#include <exception>

#include "fillet/level_line.h"

namespace fairing {

// Thrown where no rows of quads fit a fillet.
struct NoRows : std::exception {};

// A seam from one meeting to the next: from vertices that two seams don't come to.
struct SeamArc {
    Indices half_edges;
    std::vector<double> ways;  // along it at each vertex, from 0
    bool closed;               // comes back to its begin, which is no meeting
    [[nodiscard]] double length() const { return ways.back(); }
};

// Along each side of each seam once, the surface on the left; around a vertex from a seam to the next one clockwise.
struct SeamWalk {
    Indices half_edges;        // the last is followed by the first
    std::vector<double> ways;  // at the tail of each, and at the end
    std::vector<char> walled;  // of the corner at each tail: whether walls or borders come to it
    Indices points;            // of the line, by where they are reached from
    Indices segments;          // of the line, from each of these to the next one; `none` where it leads along walls
    std::vector<double> at;    // the way at which each is reached
};

class SeamWalks {
public:
    // Keeps references to the arguments.
    SeamWalks(const SeamMesh& mesh, const SeamDistance& distance, const LevelLine& line);

    struct At {
        int walk, index;
    };
    [[nodiscard]] const std::vector<SeamArc>& arcs() const { return arcs_; }
    [[nodiscard]] const std::vector<SeamWalk>& walks() const { return walks_; }
    [[nodiscard]] const At& at(int half_edge) const { return at_[half_edge]; }
    // The half-edges on seams that begin at a vertex.
    [[nodiscard]] const Indices& out(int vertex) const { return out_[vertex]; }
    [[nodiscard]] std::size_t degree(int vertex) const { return out_[vertex].size(); }
    [[nodiscard]] bool is_meeting(int vertex) const { return out_[vertex].size() != 2; }

private:
    void make_arcs();
    void add_arc(int first);
    void walk_from(int first);
    [[nodiscard]] int around(int half_edge, bool& walled);
    [[nodiscard]] double way_of(int point, int& walk) const;
    void add_line();
    void add_chain(const Indices& chain, const Indices& segments, bool closed);
    static void insert(const SeamWalk& part, SeamWalk& walk);

    const SeamMesh& mesh_;
    const SeamDistance& distance_;
    const LevelLine& line_;
    Indices partner_;           // the half-edge on the other side of its edge, over walls, too
    std::vector<Indices> out_;  // of each vertex: the half-edges on seams that begin there
    Indices sector_;            // of a half-edge with which a sector begins: the seam to which that corner leads
    std::vector<At> at_;        // of each half-edge on a seam
    std::vector<SeamArc> arcs_;
    std::vector<SeamWalk> walks_;
};

}  // namespace fairing
