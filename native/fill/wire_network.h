// Wires that hang together: arcs, the nodes where these meet, and how a surface through them lies at each node.
#pragma once

#include <map>

#include "base/errors.h"
#include "base/types.h"
#include "geometry/hard_edges.h"

namespace fairing {

// At a node: the darts that leave it, counter-clockwise about the normal of the surface, and their angles.
struct WireNode {
    Indices darts;
    std::vector<double> angles;
    Vector3 normal;
};

// Dart 2 k runs along arc k, 2 k + 1 back.
struct WireNetwork {
    std::vector<Indices> arcs;      // the vertices of each, from node to node
    std::map<int, WireNode> nodes;  // all normals on one side of the surface

    [[nodiscard]] Indices path(int dart) const;
    [[nodiscard]] const WireNode& from(int dart) const;  // the node that it leaves
};

inline int opposite(int dart) { return dart % 2 == 0 ? dart + 1 : dart - 1; }

struct Wires {
    std::vector<WireNetwork> networks;
    std::vector<Indices> loops;  // lone ones, without nodes
};

// Throws WIRES_END, and UNCLEAR_CELLS where it can't be told how wires lie at a node. `edges`: ascending.
Wires parted_wires(const VertexPairs& edges, const View<Points>& points);

// Unit normals at the edges of the path: that at its beginning, carried along without turning about them.
Points carried(const Vector3& normal, const View<Points>& points, const Indices& path);

// The unit normal of the plane nearest to the columns' tips, seen from their middle.
Vector3 nearest_plane(const Points& columns);

// MeshError at these vertices; a figure named like the case tells which one it is.
[[noreturn]] void refuse_wires(Code code, const std::string& text, const Indices& where, const char* which = "");

}  // namespace fairing
