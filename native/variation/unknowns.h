// Which motions of which vertices are sought, and where their couplings stand in a sparse matrix.
#pragma once

#include "linear/tree_solve.h"
#include "variation/sheet.h"
#include "variation/stencil.h"

namespace fairing {

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
    // Of motion k (0 height, 1 and 2 turns) of a vertex; `none` where it is not sought.
    [[nodiscard]] int of(int vertex, int k) const { return index_[3 * vertex + k]; }

    // The lower triangle, all values zero.
    [[nodiscard]] SparseMatrix pattern() const;
    // Where the lower entry of two unknowns stands among the matrix's values; `block` from block_of.
    [[nodiscard]] int slot(int row, int column, int block) const;
    // Of two vertices of one stencil.
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
