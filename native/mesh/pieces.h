// The connected pieces of a cut mesh.
#pragma once

#include "mesh/patch.h"

namespace fairing {

// Pieces are numbered by their lowest triangle. Refers to its arguments.
class Pieces {
public:
    Pieces(const CutMesh& cut, const VertexRoles& roles);

    [[nodiscard]] int size() const { return static_cast<int>(triangles_.size()); }
    [[nodiscard]] bool has_free_vertex(int piece) const { return free_count_[piece] > 0; }
    // Free vertices first, each group in the order of the input, unless that leaves neighbours far apart in memory.
    [[nodiscard]] Patch patch(int piece) const;

private:
    void list_triangles();
    void number_vertices();
    [[nodiscard]] Twins twins_of(int piece) const;

    const CutMesh& cut_;
    const VertexRoles& roles_;
    std::vector<Indices> triangles_;
    Indices place_;                  // index of a triangle in its piece's list
    std::vector<Indices> vertices_;  // cut vertices in the order of the patch
    Indices free_count_;
    Indices local_;  // cut vertex → its number in its piece
};

// Calls visit(patch, positions of its vertices) for all pieces.
template <typename Visit>
void for_each_piece(const CutMesh& cut, const VertexRoles& roles, const Eigen::Ref<const Points>& points,
                    const Visit& visit) {
    const Pieces pieces(cut, roles);
    for (int k = 0; k < pieces.size(); ++k) {
        const Patch patch = pieces.patch(k);
        visit(patch, Points(points(Eigen::all, patch.to_input)));
    }
}

// The patches that have free vertices.
std::vector<Patch> make_patches(const CutMesh& cut, const VertexRoles& roles);

}  // namespace fairing
