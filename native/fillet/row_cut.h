// A mesh cut along the border of a fillet's quads.
#pragma once

#include "fillet/cut_mesh.h"

namespace fairing {

// Takes points out of the line of a cut mesh: the pieces outside close up to a point beside each.
class ClosedPieces {
public:
    // `vertices`: of the mesh and the cut. Keeps references to both.
    ClosedPieces(const Points& vertices, SplitMesh& cut);
    // Points that follow each other on the line, between two others. False, and nothing changes, where a piece would
    // turn over or leave its plane.
    bool drop(const Indices& points);
    void finish();

private:
    using Piece = Eigen::Vector3i;
    void add(const Piece& piece, int parent);
    void remove(int t);
    [[nodiscard]] Indices around(const std::vector<int>& star, const Indices& group) const;
    [[nodiscard]] Vector3 at(int v) const { return vertices_.col(v); }

    const Points& vertices_;
    SplitMesh& cut_;
    std::vector<Indices> at_;  // of each vertex: the pieces outside
    std::vector<Piece> corners_;
    std::vector<char> gone_;
    std::vector<char> dropped_;  // of each vertex
};

}  // namespace fairing
