// The triangles near a fillet's end, halved until they are small there.
#pragma once

#include <cstdint>
#include <unordered_map>

#include "fillet/seam_distance.h"

namespace fairing {

class HalvedMesh {
public:
    struct Node {
        Vector3 place;
        double value;  // distance from the seam less the width, the least of the triangles around
        double size;   // the width as a share of the widest
        int vertex;    // of the mesh, or `none`,
        int edge;      // of the mesh, that it is on, or `none`
    };
    struct Piece {
        int triangle;  // of the mesh
        std::array<int, 3> nodes;
        std::array<Vector3, 3> weights;  // of the nodes in that triangle
        std::array<int, 3> edges;        // of the mesh, on which the side from node k to k + 1 is; or `none`
    };
    // Longest edges first, so that pieces stay as round as they were, until no edge near the line is longer than
    // `resolution`: where the fillet is widest, in proportion to its width elsewhere.
    HalvedMesh(const SeamMesh& mesh, const SeamDistance& distance, double resolution);

    [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
    [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
    // The piece on the other side of a side, or `none`.
    [[nodiscard]] int across(int piece, int side) const;
    // Nodes nearer to the line than these, in that proportion, are put on it, as outside.
    void snap(double vertices, double others);

private:
    using Key = std::array<int, 3>;  // two nodes, and the triangle on edges of three and more, which may share both
    struct Hash {
        std::size_t operator()(const Key& key) const {
            const auto pair = (static_cast<std::uint64_t>(key[0]) << 32U) | static_cast<std::uint32_t>(key[1]);
            return std::hash<std::uint64_t>()(pair ^ (static_cast<std::uint64_t>(key[2]) << 16U));
        }
    };
    [[nodiscard]] Key key(const Piece& piece, int side) const;
    [[nodiscard]] int longest_side(const Piece& piece) const;
    [[nodiscard]] bool is_cut(const Piece& piece) const;
    void insert(const Piece& piece, int number);
    void halve(int piece);
    void split(const Key& side);

    const SeamMesh& mesh_;
    const SeamDistance& distance_;
    std::vector<Node> nodes_;
    std::vector<Piece> pieces_;
    std::unordered_map<Key, std::array<int, 2>, Hash> beside_;
    Indices sides_;  // of each edge of the mesh: how many triangles it has
};

}  // namespace fairing
