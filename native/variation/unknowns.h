// Which motions of which vertices are sought, and where their couplings stand in a sparse matrix.
#pragma once

#include "geometry/triangle.h"
#include "linear/tree_solve.h"
#include "mesh/patch.h"

namespace fairing {

// Corners a, b, c of a triangle, then the vertices opposite to it across bc, ca, ab; `none` across a border edge.
using Stencil = std::array<int, 6>;

inline constexpr int stencil_size = 6;  // the triangle's corners and those across its edges

// Pairs of stencil places along which the derivative of the normal curvature is known: the three edges, and each corner
// with the vertex across its opposite edge. Edges alone leave one of the four coefficients of a cubic open.
inline constexpr std::array<std::array<int, 2>, 6> stencil_pairs{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 4}, {2, 5}}};

// One for each triangle.
std::vector<Stencil> stencils(const Patch& patch);

// 3 × local vertices each.
struct Sheet {
    Points points;
    Points normals;  // unit
};

// Small motions of a vertex: height h along its normal n, and n turned to the direction of n + a u + b v.
using Motion = Vector3;  // (h, a, b)

inline void move(Sheet& sheet, int vertex, const Motion& motion) {
    const Vector3 n = sheet.normals.col(vertex);
    const Frame frame(n);
    sheet.points.col(vertex) += motion[0] * n;
    sheet.normals.col(vertex) = (n + motion[1] * frame.u + motion[2] * frame.v).normalized();
}

// Vertices that move along their normals, and those whose normals turn.
struct Freedom {
    std::vector<char> rises;
    std::vector<char> turns;
};

// Unknowns are numbered vertex by vertex: height, then the two turns.
class Unknowns {
public:
    Unknowns(const Freedom& freedom, const std::vector<Stencil>& stencils);

    [[nodiscard]] int count() const { return count_; }
    // Unknown of motion k (0 height, 1 and 2 turns) of a vertex; `none` where it is not sought.
    [[nodiscard]] int of(int vertex, int k) const { return index_[3 * vertex + k]; }

    // The lower triangle, all values zero.
    [[nodiscard]] SparseMatrix pattern() const;
    // Where the lower entry of two unknowns stands among the matrix's values; `block` from block_of.
    [[nodiscard]] int slot(int row, int column, int block) const;
    // Place of the block of two vertices of one stencil.
    [[nodiscard]] int block_of(int vertex, int other) const;

private:
    void number(const Freedom& freedom);
    void connect(const std::vector<Stencil>& stencils);

    int count_ = 0;
    int vertex_count_ = 0;
    Indices index_;         // 3 × vertices
    Indices first_;         // unknown of each vertex; one more entry at the end
    Indices begin_;         // of each vertex's later neighbours
    Indices neighbours_;    // ascending, itself first
    Indices rows_before_;   // of each neighbour, within the columns of the vertex
    Indices vertex_of_;     // of each unknown
    Indices column_begin_;  // of each unknown
};

}  // namespace fairing
