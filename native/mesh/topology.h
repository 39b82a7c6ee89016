// From a triangle list and its fixed vertices to consistently wound pieces that end in their fixed curves.
#pragma once

#include "base/errors.h"
#include "mesh/twins.h"

namespace fairing {

// Flags of the caller's vertices.
struct VertexRoles {
    std::vector<char> given;       // fixed by the caller
    std::vector<char> fixed;       // keeps its position: given, or on the mesh border
    std::vector<char> border;      // on an edge with a single triangle
    std::vector<char> pin;         // position only: none of its neighbours is fixed, or its slope is free
    std::vector<char> used;        // in some triangle
    std::vector<char> free_slope;  // pins that the caller named so
    std::vector<char> smooth;      // of these: the surface runs through, curves of them are not cut
    std::vector<char> faired;      // of these: on an open border that becomes fair itself
};

// The caller's choices, per vertex; both kinds of free slopes may be empty.
struct GivenRoles {
    std::vector<char> fixed;
    std::vector<char> crease;  // the slope is free, on each side of a curve
    std::vector<char> smooth;  // the slope is free, the same on both sides
    bool fair_border = false;  // border vertices that are not fixed by the caller become fair
};

// The mesh cut open along curves of fixed vertices. A fixed vertex has one copy for each side of the curves through it.
struct CutMesh {
    Triangles triangles;        // of cut vertices, consistently wound within a piece
    Indices input_vertex;       // cut vertex → input vertex
    Indices input_triangle;     // triangle → input triangle
    Indices piece;              // triangle → piece, numbered by the lowest triangle
    std::vector<char> flipped;  // triangle: stored the other way round than the caller's
    Twins twins;                // of the triangles; empty: not known
    int piece_count = 0;
};

// Removes triangles that name a vertex twice; `kept` are the input indices of the others.
Triangles drop_collapsed_triangles(const Triangles& triangles, Indices& kept, Diagnostics& warnings);

VertexRoles classify_vertices(const EdgeTable& edges, const GivenRoles& given);

// The edges at which the mesh is cut open. Both ends of such an edge are fixed, and a free vertex is opposite to it
// or more than two triangles meet there. Three kinds of edges between fixed vertices are left whole: the chord that
// only cuts a corner off the mesh border, a lone edge inside, which has nothing to open, and edges of smooth curves.
// Throws NONMANIFOLD_EDGE where more than two triangles meet at an edge whose ends the caller has not both fixed.
std::vector<char> find_cut_edges(const Triangles& triangles, const EdgeTable& edges, const VertexRoles& roles);

// Cuts, orients (in each piece and across its curves the majority of the moving triangles along the boundary wins, with
// a warning), numbers pieces. Pieces without free vertices that can't be joined (single-sided, or pockets of two
// triangles on the same three vertices) are taken apart. Throws NONMANIFOLD_VERTEX (several fans at a free vertex), and
// where something moves NONMANIFOLD_EDGE (a pocket) and NOT_ORIENTABLE. `edges`: of `triangles`.
CutMesh cut_mesh(const Triangles& triangles, const EdgeTable& edges, const Indices& input_triangle,
                 const VertexRoles& roles, Diagnostics& warnings);

}  // namespace fairing
