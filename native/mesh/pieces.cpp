#include "mesh/pieces.h"

#include "base/columns.h"
#include "base/progress.h"
#include "mesh/memory_order.h"

namespace fairing {

Pieces::Pieces(const CutMesh& cut, const VertexRoles& roles) : cut_(cut), roles_(roles) {
    list_triangles();
    number_vertices();
}

void Pieces::list_triangles() {
    triangles_.resize(cut_.piece_count);
    place_.reserve(cut_.piece.size());
    for (int t = 0; t < static_cast<int>(cut_.piece.size()); ++t) {
        checkpoint(t);
        Indices& triangles = triangles_[cut_.piece[t]];
        place_.push_back(static_cast<int>(triangles.size()));
        triangles.push_back(t);
    }
}

// A cut vertex belongs to one piece: all triangles around it are joined.
void Pieces::number_vertices() {
    Indices piece_of(cut_.input_vertex.size(), none);
    for (int t = 0; t < static_cast<int>(cut_.piece.size()); ++t) {
        checkpoint(t);
        for (int v : cut_.triangles.col(t)) piece_of[v] = cut_.piece[t];
    }
    // By their input vertices.
    const Indices sorted = sorted_by(cut_.input_vertex, static_cast<int>(roles_.fixed.size()));
    vertices_.resize(triangles_.size());
    free_count_.assign(triangles_.size(), 0);
    local_.assign(cut_.input_vertex.size(), none);
    for (const bool fixed : {false, true}) {
        for (int v : sorted) {
            const int piece = piece_of[v];
            if (piece == none || (roles_.fixed[cut_.input_vertex[v]] != 0) != fixed) continue;
            local_[v] = static_cast<int>(vertices_[piece].size());
            vertices_[piece].push_back(v);
            if (!fixed) ++free_count_[piece];
        }
        checkpoint();
    }
}

// Twins lie in one piece.
Twins Pieces::twins_of(int piece) const {
    if (cut_.twins.empty()) return {};
    const Indices& triangles = triangles_[piece];
    if (triangles.size() == cut_.piece.size()) return cut_.twins;
    Twins twins;
    twins.reserve(3 * triangles.size());
    for (const int t : triangles) {
        for (int k = 0; k < 3; ++k) {
            const int twin = cut_.twins[3 * t + k];
            twins.push_back(twin == none ? none : 3 * place_[twin / 3] + twin % 3);
        }
    }
    return twins;
}

Patch Pieces::patch(int piece) const {
    PatchMembers members;
    members.free_count = free_count_[piece];
    members.to_input.reserve(vertices_[piece].size());
    members.pin.reserve(vertices_[piece].size());
    for (int v : vertices_[piece]) {
        const int input = cut_.input_vertex[v];
        members.to_input.push_back(input);
        members.pin.push_back(roles_.pin[input]);
    }
    const Indices& triangles = triangles_[piece];
    Twins twins = twins_of(piece);
    members.input_triangle.reserve(triangles.size());
    members.triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
    for (int k = 0; k < static_cast<int>(triangles.size()); ++k) {
        checkpoint(k);
        const int t = triangles[k];
        members.input_triangle.push_back(cut_.input_triangle[t]);
        for (int c = 0; c < 3; ++c) members.triangles(c, k) = local_[cut_.triangles(c, t)];
    }
    bring_neighbours_together(members, twins);
    return Patch(std::move(members), std::move(twins));
}

std::vector<Patch> make_patches(const CutMesh& cut, const VertexRoles& roles) {
    const Pieces pieces(cut, roles);
    std::vector<Patch> patches;
    for (int k = 0; k < pieces.size(); ++k) {
        if (pieces.has_free_vertex(k)) patches.push_back(pieces.patch(k));
    }
    return patches;
}

}  // namespace fairing
